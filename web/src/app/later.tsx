// Parts of the page that load later, since few users need them, or none at the start. All are fetched after the first
// input while the page is idle, so that none has to be waited for.
import type { ComponentProps, ComponentType } from 'preact';
import { useEffect } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import { NOT_LOADED } from './incomplete';
import { TEXTS } from '../texts/desk/page';

/** Counts the attempts, so that each has a different address. */
let attempts = 0;

/** Browsers may cache a failed module by address; the next attempt uses another one. */
function loadAnew<M>(error: unknown): Promise<M> {
  const address = /https?:\S+\.js/.exec(String(error))?.[0];
  if (!address) throw error;
  return import(/* @vite-ignore */ `${address}?attempt=${++attempts}`) as Promise<M>;
}

/** Fetches a module and takes one part of it. */
const of =
  <M, P>(load: () => Promise<M>, pick: (module: M) => P) =>
  async (): Promise<P> =>
    pick(await load().catch(loadAnew<M>));

/** In order of likely use. */
const PARTS = {
  hint: of(
    () => import('./hud/coach'),
    (m) => m.Coach,
  ),
  'speed points': of(
    () => import('./timeline/speed-points'),
    (m) => m.SpeedPoints,
  ),
  agent: of(
    () => import('./inspector/agent-panel'),
    (m) => m.AgentPanel,
  ),
  menu: of(
    () => import('./opened-menu'),
    (m) => m.default,
  ),
  'generate options': of(
    () => import('./parts/asking'),
    (m) => m.GenerateOptions,
  ),
  handles: of(
    () => import('./inspector/agent-panel'),
    (m) => m.Sliders,
  ),
  compass: of(
    () => import('./hud/compass'),
    (m) => m.Compass,
  ),
  palette: of(
    () => import('./dialogs/palette'),
    (m) => m.Palette,
  ),
  'context menu': of(
    () => import('./context-menu'),
    (m) => m.ContextMenu,
  ),
  events: of(
    () => import('./inspector/events-panel'),
    (m) => m.EventsPanel,
  ),
  several: of(
    () => import('./inspector/several-panel'),
    (m) => m.SeveralPanel,
  ),
  place: of(
    () => import('./hud/place-panel'),
    (m) => m.PlacePanel,
  ),
  thumb: of(
    () => import('./hud/thumb'),
    (m) => m.Thumb,
  ),
  drive: of(
    () => import('./hud/drive-bar'),
    (m) => m.DriveBar,
  ),
  follow: of(
    () => import('./hud/follow-bar'),
    (m) => m.FollowBar,
  ),
  phases: of(
    () => import('./timeline/phase-strip'),
    (m) => m.PhaseStrip,
  ),
  'map item': of(
    () => import('./inspector/map-item-panel'),
    (m) => m.default,
  ),
  points: of(
    () => import('./timeline/point-fields'),
    (m) => m.PointFields,
  ),
  scenes: of(
    () => import('./scenes/drawer'),
    (m) => m.Drawer,
  ),
  fill: of(
    () => import('./hud/fill-panel'),
    (m) => m.default,
  ),
  history: of(
    () => import('./history/panel'),
    (m) => m.HistoryPanel,
  ),
  'way back': of(
    () => import('./hud/way-back'),
    (m) => m.WayBack,
  ),
  'empty scene': of(
    () => import('./hud/empty-scene'),
    (m) => m.EmptyScene,
  ),
  empty: of(
    () => import('./scenes/empty'),
    (m) => m.Empty,
  ),
  variants: of(
    () => import('./variants/strip'),
    (m) => m.default,
  ),
  cases: of(
    () => import('./cases/panel'),
    (m) => m.default,
  ),
  compare: of(
    () => import('./variants/compare-panel'),
    (m) => m.default,
  ),
  'compare view': of(
    () => import('./variants/compare-view'),
    (m) => m.default,
  ),
  templates: of(
    () => import('./layouts/templates'),
    (m) => m.default,
  ),
  layout: of(
    () => import('./layouts/panel'),
    (m) => m.default,
  ),
  'round cards': of(
    () => import('./rounds/strip'),
    (m) => m.default,
  ),
  rounds: of(
    () => import('./rounds/panel'),
    (m) => m.default,
  ),
  import: of(
    () => import('./dialogs/import-files'),
    (m) => m.ImportFiles,
  ),
  'import report': of(
    () => import('./dialogs/import-report'),
    (m) => m.ImportReport,
  ),
  export: of(
    () => import('./outward/export'),
    (m) => m.default,
  ),
  share: of(
    () => import('./outward/share'),
    (m) => m.default,
  ),
  'save-as': of(
    () => import('./dialogs/save-as'),
    (m) => m.SaveAs,
  ),
  shortcuts: of(
    () => import('./dialogs/shortcuts'),
    (m) => m.Shortcuts,
  ),
} as const;

type LateParts = typeof PARTS;
type Name = keyof LateParts;
type PropsOf<N extends Name> = ComponentProps<Awaited<ReturnType<LateParts[N]>>>;

const here = new Map<Name, ComponentType>();

async function fetchPart(name: Name): Promise<void> {
  if (!here.has(name)) here.set(name, (await PARTS[name]()) as ComponentType);
}

/** A part that failed to load is retried after this: the server may be back. */
const AGAIN_MS = 3000;
/** Longest wait for an idle page before the rest is fetched. */
const REST_MS = 4000;

/**
 * Fetches all parts in turn after the first input, once the page is idle: a user who only watches neither waits for
 * them nor downloads them.
 */
export function fetchRest(): void {
  const all = async (): Promise<void> => {
    // A failed one is fetched again when it is needed, and reported then.
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

/** A part by name; rendered at once if fetched before. */
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
    // This place may have shown another part before: its arrival would render nothing again.
    if (state.peek() === 'there' && !here.has(part)) state.value = 'waiting';
    // Also for a part that arrived after rendering, which nothing else would render again.
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
          {TEXTS.reloadThePage}
        </button>
      </div>
    </div>
  );
}
