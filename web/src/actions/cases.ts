// The search for a case: one road user is varied until the target event occurs.
import { hasScene, inGroup } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

/** Id of the shown case; null for none. */
const shown = (c: Context): number | null => c.searching.open.value?.shown.value ?? null;

const isOpen = (c: Context): boolean => c.searching.open.value !== null;

export const cases = inGroup('variants', [
  {
    id: 'find-case',
    label: TEXTS.findACase,
    keys: ['Alt+F'],
    icon: 'search',
    help: 'triesSpeeds',
    when: (c) => {
      const can = hasScene(c);
      return can !== true || isOpen(c) || c.editor.selected.value.length ? can : TEXTS.selectOneOrTwo;
    },
    checked: isOpen,
    run: (c) => {
      const open = c.searching.open.value;
      if (open) return open.close();
      c.variants.comparing.end();
      c.rounds.close();
      c.ui.showEvents(false);
      void c.searching.begin();
    },
  },
  {
    id: 'case-search',
    label: TEXTS.search,
    icon: 'search',
    help: 'runsUntilEnough',
    when: (c) => {
      const open = c.searching.open.value;
      return open ? (open.obstacle.value ?? true) : TEXTS.sayFirstWhat;
    },
    run: (c) => void c.searching.open.value?.run(),
  },
  {
    id: 'case-stop',
    label: TEXTS.pause,
    icon: 'pause',
    help: 'pausesTheSearch',
    when: (c) => (c.searching.open.value?.state.value === 'running' ? true : TEXTS.noSearchIsRunning),
    run: (c) => c.searching.open.value?.stop(),
  },
  {
    id: 'star-case',
    label: TEXTS.starTheCase,
    keys: ['S'],
    icon: 'star',
    help: 'starStays',
    onOffer: (c) => shown(c) !== null,
    when: (c) => (shown(c) === null ? TEXTS.selectACaseFirst : true),
    run: (c) => c.searching.open.value?.toggleStar(shown(c)!),
  },
  {
    id: 'cases-keep',
    label: TEXTS.keepAllAsVariants,
    icon: 'variants',
    help: 'endsTheSearch',
    when: (c) => (c.searching.open.value?.found.value.length ? true : TEXTS.noCaseWasFound),
    run: (c) => {
      const open = c.searching.open.value;
      const kept = open?.takes();
      open?.close();
      if (kept) c.variants.keepTakes(kept.takes, kept.subject, 'case', kept.starred);
    },
  },
]);
