// The first paint: the top bar with the program's name.

/** A mount point for components, without a box in the layout. */
export function place(...within: HTMLElement[]): HTMLElement {
  return element('swap', 'div', ...within);
}

/** The bar; `topbar.tsx` renders its content over this. */
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
