// The search for a case: somebody is tried with other numbers until what is looked for happens.
import { hasScene, inGroup } from './action';
import type { Context } from './context';

/** Id of the case that is looked at; null where none is. */
const shown = (c: Context): number | null => c.searching.open.value?.shown.value ?? null;

const isOpen = (c: Context): boolean => c.searching.open.value !== null;

export const cases = inGroup('Variants', [
  {
    id: 'find-case',
    label: 'Find a case',
    keys: ['Alt+F'],
    icon: 'search',
    help: 'Tries speeds, goal times and seeds of a road user until a near miss, hard braking or the like happens',
    when: (c) => {
      const can = hasScene(c);
      return can !== true || isOpen(c) || c.editor.selected.value.length ? can : 'Select one or two road users first.';
    },
    checked: isOpen,
    run: (c) => {
      const open = c.searching.open.value;
      if (open) return open.close();
      c.variants.endCompare();
      c.rounds.close();
      c.ui.showEvents(false);
      void c.searching.begin();
    },
  },
  {
    id: 'case-search',
    label: 'Search',
    icon: 'search',
    help: 'Goes on until it is found or stopped; you can keep editing',
    when: (c) => {
      const open = c.searching.open.value;
      return open ? (open.obstacle.value ?? true) : 'Say first what is looked for.';
    },
    run: (c) => void c.searching.open.value?.run(),
  },
  {
    id: 'case-stop',
    label: 'Pause',
    icon: 'pause',
    help: 'The search waits; what was found stays, and it can go on later',
    when: (c) => (c.searching.open.value?.state.value === 'running' ? true : 'Nothing is looked for.'),
    run: (c) => c.searching.open.value?.stop(),
  },
  {
    id: 'star-case',
    label: 'Star the case',
    keys: ['S'],
    icon: 'star',
    help: 'The star stays with it when it is kept as a variant',
    onOffer: (c) => shown(c) !== null,
    when: (c) => (shown(c) === null ? 'Look at a case first.' : true),
    run: (c) => c.searching.open.value?.toggleStar(shown(c)!),
  },
  {
    id: 'cases-keep',
    label: 'Keep all as variants',
    icon: 'variants',
    help: 'Ends the search; each case that was found becomes a variant',
    when: (c) => (c.searching.open.value?.found.value.length ? true : 'No case was found yet.'),
    run: (c) => {
      const open = c.searching.open.value;
      const kept = open?.takes();
      open?.close();
      if (kept) c.variants.keepTakes(kept.takes, kept.subject, 'case', kept.starred);
    },
  },
]);
