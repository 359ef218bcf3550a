// The page as a screen reader gets it: the accessibility tree, and spoken messages.

/** All named or focusable elements: `{ role, name, value, focusable }`. */
export async function tree(e) {
  const { nodes } = await e.cdp.send('Accessibility.getFullAXTree');
  return nodes
    .filter((n) => !n.ignored)
    .map((n) => ({
      id: n.nodeId,
      role: n.role?.value ?? '',
      name: n.name?.value ?? '',
      value: n.value?.value ?? '',
      focusable: n.properties?.some((p) => p.name === 'focusable' && p.value.value) ?? false,
      properties: Object.fromEntries((n.properties ?? []).map((p) => [p.name, p.value.value])),
      element: n.backendDOMNodeId,
    }));
}

/** Presses an element with a role and a name, like a screen reader. */
export async function press(e, role, name) {
  const is = (n) => n.role === role && (name instanceof RegExp ? name.test(n.name) : n.name === name);
  let found;
  // The tree follows the page a little later.
  for (let i = 0; i < 20 && !found; i++) {
    found = (await tree(e)).find(is);
    if (!found) await e.frames(3);
  }
  if (!found) throw new Error(`no ${role} ${name}`);
  const { object } = await e.cdp.send('DOM.resolveNode', { backendNodeId: found.element });
  await e.cdp.send('Runtime.callFunctionOn', {
    objectId: object.objectId,
    functionDeclaration: 'function () { this.focus(); this.click(); }',
  });
  return found;
}

/** Spoken messages from now on. */
export async function ear(e) {
  const polite = await e.listen('[role="status"][aria-live="polite"]');
  const urgent = await e.listen('[role="alert"][aria-live="assertive"]');
  return {
    said: async () => [...(await polite()), ...(await urgent())],
    /** Waits for a spoken message with these words. */
    hears: (words) =>
      e.until(
        ([source]) =>
          [...document.querySelectorAll('[aria-live]')].some((el) => new RegExp(source).test(el.textContent)),
        [words.source],
      ),
  };
}
