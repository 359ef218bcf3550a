// What is seen before there is anything to work with: the bar on top, with the name of the program.

/** A place for components that takes no part in the layout. */
export function place(...within: HTMLElement[]): HTMLElement {
  return element('swap', 'div', ...within);
}

/** The bar; what belongs into it is drawn over this (`topbar.tsx`). */
export function outlineOfBar(small: boolean): HTMLElement {
  const name = document.createElement('span');
  name.textContent = 'DragTraffic';
  return element('top', 'header', ...(small ? [] : [element('logo', 'div')]), element('title', 'div', name));
}

function element(name: string, tag: 'div' | 'header', ...within: HTMLElement[]): HTMLElement {
  const made = document.createElement(tag);
  made.className = name;
  made.append(...within);
  return made;
}
