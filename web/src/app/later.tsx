// The parts of the page that come later: what few need, or nobody in the first moment, does not make everybody wait.
// All of them are fetched when somebody begins and the page has nothing else to do, so that none is waited for when it
// is wanted.
import type { ComponentProps, ComponentType } from 'preact';
import { useEffect } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import { NOT_LOADED } from './incomplete';
import { TEXTS } from '../texts/page';

/** In the order in which they are likely to be wanted. */
const PARTS = {
  hint: () => import('./hud/coach').then((m) => m.Coach),
  'speed points': () => import('./timeline/speed-points').then((m) => m.SpeedPoints),
  agent: () => import('./inspector/agent-panel').then((m) => m.AgentPanel),
  handles: () => import('./inspector/agent-panel').then((m) => m.Sliders),
  palette: () => import('./dialogs/palette').then((m) => m.Palette),
  'context menu': () => import('./context-menu').then((m) => m.ContextMenu),
  events: () => import('./inspector/events-panel').then((m) => m.EventsPanel),
  several: () => import('./inspector/several-panel').then((m) => m.SeveralPanel),
  place: () => import('./hud/place-panel').then((m) => m.PlacePanel),
  points: () => import('./timeline/point-fields').then((m) => m.PointFields),
  scenes: () => import('./scenes/drawer').then((m) => m.Drawer),
  fill: () => import('./hud/fill-panel').then((m) => m.default),
  history: () => import('./history/panel').then((m) => m.HistoryPanel),
  'empty scene': () => import('./hud/empty-scene').then((m) => m.EmptyScene),
  empty: () => import('./scenes/empty').then((m) => m.Empty),
  variants: () => import('./variants/strip').then((m) => m.default),
  cases: () => import('./cases/panel').then((m) => m.default),
  compare: () => import('./variants/compare-panel').then((m) => m.default),
  'compare view': () => import('./variants/compare-view').then((m) => m.default),
  templates: () => import('./layouts/templates').then((m) => m.default),
  layout: () => import('./layouts/panel').then((m) => m.default),
  'round cards': () => import('./rounds/strip').then((m) => m.default),
  rounds: () => import('./rounds/panel').then((m) => m.default),
  import: () => import('./dialogs/import-files').then((m) => m.ImportFiles),
  'import report': () => import('./dialogs/import-report').then((m) => m.ImportReport),
  export: () => import('./outward/export').then((m) => m.default),
  share: () => import('./outward/share').then((m) => m.default),
  'save-as': () => import('./dialogs/save-as').then((m) => m.SaveAs),
  shortcuts: () => import('./dialogs/shortcuts').then((m) => m.Shortcuts),
} as const;

type Parts = typeof PARTS;
type Name = keyof Parts;
type PropsOf<N extends Name> = ComponentProps<Awaited<ReturnType<Parts[N]>>>;

const here = new Map<Name, ComponentType>();

async function fetchPart(name: Name): Promise<void> {
  if (!here.has(name)) here.set(name, (await PARTS[name]()) as ComponentType);
}

/** A part that did not come is asked for again after so long: the server may be back. */
const AGAIN_MS = 3000;
/** The page is not busy for so long at most before the rest of it comes, whatever else goes on. */
const REST_MS = 4000;

/**
 * Fetches all parts, one after the other, once somebody has done something and the page has nothing else to do: who
 * only looks waits for none of them and pays for none.
 */
export function fetchRest(): void {
  const all = async (): Promise<void> => {
    // One that does not come is asked for again when it is wanted, and missed then.
    for (const name of Object.keys(PARTS) as Name[]) await fetchPart(name).catch(() => null);
  };
  const begun = new AbortController();
  const begin = (): void => {
    begun.abort();
    if (typeof requestIdleCallback === 'undefined') setTimeout(all, REST_MS);
    else requestIdleCallback(() => void all(), { timeout: REST_MS });
  };
  for (const done of ['pointerup', 'keyup', 'drop'] as const)
    addEventListener(done, begin, { capture: true, signal: begun.signal });
}

/** A part by its name; it is there at once where it was fetched before. */
export function Later<N extends Name>({ part, ...props }: { part: N } & PropsOf<N>) {
  const tries = useSignal(1);
  const state = useSignal<'waiting' | 'there' | 'missing'>(here.has(part) ? 'there' : 'waiting');
  const tried = tries.value;
  useEffect(() => {
    let wanted = true;
    let again: ReturnType<typeof setTimeout> | undefined;
    const say = (to: 'there' | 'missing') => () => {
      if (!wanted) return;
      state.value = to;
      if (to === 'missing') again = setTimeout(() => tries.value++, AGAIN_MS);
    };
    // Also one that has come since it was drawn: nobody else would draw it anew.
    void fetchPart(part).then(say('there'), say('missing'));
    return () => {
      wanted = false;
      clearTimeout(again);
    };
  }, [part, state, tried]);
  if (state.value === 'missing')
    return (
      <NotLoaded
        again={() => {
          state.value = 'waiting';
          tries.value++;
        }}
      />
    );
  const Part = here.get(part) as ComponentType<object> | undefined;
  return Part ? <Part {...props} /> : null;
}

function NotLoaded({ again }: { again: () => void }) {
  return (
    <div class="notloaded card" role="alert">
      <p>{NOT_LOADED}</p>
      <div class="row">
        <button type="button" class="btn line" onClick={again}>
          {TEXTS.tryAgain}
        </button>
        <button type="button" class="btn" onClick={() => location.reload()}>
          {TEXTS.loadThePageAnew}
        </button>
      </div>
    </div>
  );
}
