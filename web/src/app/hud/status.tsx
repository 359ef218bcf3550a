// The status line: the generator's state, or the events of the scene.
import type { Lane } from '../../model/document/lanemap';
import { num } from '../../model/base/units';
import { counted, worstOf } from '../../model/physics/events';
import { summary, type TrafficEvent } from '../../model/words/event-words';
import { KIND_WORDS } from '../../model/base/kinds';
import { isPlaced, touched } from '../../model/document/scene';
import { placedBy } from '../../actions/place';
import { goToEvent } from '../../actions/time';
import type { Context } from '../../actions/context';
import type { Status as GeneratorStatus } from '../../edit/session/answers';
import { outOfReach } from '../../edit/moves/goal-verdict';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/desk/hud';

interface StatusLine {
  /** Colour of the dot; empty without problems. */
  readonly dot: '' | 'busy' | 'near' | 'collision';
  readonly text: string;
  /** Time of the computation, shown on the pointer. */
  readonly ms?: number;
  /** Action of a press on it. */
  readonly go?: () => void;
}

export function Status() {
  const c = useApp();
  return c.editor.reading.throttle.read(() => statusLine(c));
}

function statusLine(c: Context) {
  const { editor, layouts, filling } = c;
  const s = editor.answers.status.value;
  // At an event the line describes the scene, not the generator.
  if (editor.selectedEvent.value && (s.kind === 'settled' || s.kind === 'ready')) return row(sceneLine(c));
  if (layouts.isOpen.value) return row(mapLine(c));
  const work = workLine(c);
  if (work && !editor.drag.active.value) return row(work);
  const kind = placedBy(c);
  if (filling.wish.value) return row({ dot: '', text: TEXTS.previewNothing });
  if (kind) return row({ dot: '', text: TEXTS.placing(KIND_WORDS[kind]) });
  if (s.kind === 'refining') return refining(s);
  const some = editor.selected.value.length;
  if (some > 1 && (s.kind === 'settled' || s.kind === 'ready'))
    return row({ dot: 'busy', text: TEXTS.ofSelected(some, editor.scene.value!.agents.size) });
  return row(lineFor(c, s));
}

/** Progress of a search, or of making variants. */
function workLine({ searching, variants }: Context): StatusLine | null {
  const making = variants.making.value;
  if (making) return { dot: 'busy', text: TEXTS.makingVariants(making.made.length, making.of) };
  const open = searching.open.value;
  if (open?.state.value !== 'running') return null;
  const { tried, of } = open.progress.value;
  return { dot: 'busy', text: TEXTS.searching(tried, of, open.found.value.length) };
}

/** Lanes for motor vehicles, which the word "lanes" means here. */
const driven = (lanes: ReadonlyMap<string, Lane>): number =>
  [...lanes.values()].filter((l) => l.kind === 'road').length;

/** Contents of the map being made. */
function mapLine({ layouts }: Context): StatusLine {
  const made = layouts.made.value;
  if (!made) return { dot: 'busy', text: TEXTS.drawing };
  const { lanes, crosswalks } = made.scene.map;
  const bad = made.checks.some((k) => !k.passed);
  const words = TEXTS.lanesCrosswalks(driven(lanes), crosswalks.length);
  return { dot: bad ? 'near' : '', text: words, ms: made.ms };
}

const took = (ms?: number): string | undefined => (ms ? TEXTS.took(ms.toFixed(0)) : undefined);

/** Neither row is a component: a drag alternates between them in every frame. */
function row({ dot, text, ms, go }: StatusLine) {
  const words = (
    <>
      <span class={`dot ${dot}`} />
      {text}
    </>
  );
  if (!go)
    return (
      <div class="row" title={took(ms)}>
        {words}
      </div>
    );
  return (
    <button type="button" class="row" title={TEXTS.goToTheFirst} onClick={go}>
      {words}
    </button>
  );
}

type RefiningStatus = Extract<GeneratorStatus, { kind: 'refining' }>;

function refining({ step, steps, ms, part }: RefiningStatus) {
  const words = part
    ? TEXTS.refining(part)
    : step
      ? TEXTS.refiningStep(step, steps)
      : ms
        ? TEXTS.firstGuess
        : TEXTS.computingFutures;
  return (
    <div class="row" title={took(ms)}>
      <span class="steps">
        {Array.from({ length: steps }, (_, i) => (
          <i key={i} class={i < step ? 'd' : ''} />
        ))}
      </span>
      {words}
    </div>
  );
}

function lineFor(c: Context, s: Exclude<GeneratorStatus, RefiningStatus>): StatusLine {
  const { editor } = c;
  switch (s.kind) {
    case 'loading':
      return { dot: 'busy', text: TEXTS.loadingTheScene };
    case 'slow': {
      const keep = editor.drag.active.value ? TEXTS.youCanKeepDragging : '';
      return { dot: 'busy', text: TEXTS.thisTakesLonger(num(s.ms / 1000, 1), keep) };
    }
    case 'refused':
      return { dot: 'collision', text: s.words };
    case 'away': {
      const n = editor.answers.away.value?.waiting ?? 0;
      return { dot: 'near', text: n ? TEXTS.generatorOfflineWaiting(n) : TEXTS.generatorOffline };
    }
    case 'settled':
      return settledLine(c, s.ms, s.adapted);
    case 'ready':
      return sceneLine(c);
  }
}

function settledLine(c: Context, ms: number, adapted: number | null): StatusLine {
  const { editor } = c;
  const a = editor.agent.value;
  const bad = a && isPlaced(a.goal) ? outOfReach(editor, a) : null;
  if (bad && !bad.outranked) return { dot: 'near', text: TEXTS.showingFutures };
  if (!editor.selection.value) return sceneLine(c);
  const n = editor.reading.futures.value?.modes.length ?? 6;
  const parts = [TEXTS.futures(n === 6 ? TEXTS.six : n), adapted ? TEXTS.othersReact(adapted) : ''];
  // Beside a collision the dot is not green.
  return { dot: dotOf(editor.reading.events.value), text: parts.filter(Boolean).join(' · '), ms };
}

function dotOf(events: readonly TrafficEvent[]): StatusLine['dot'] {
  const worst = worstOf(events);
  return worst === 'collision' ? 'collision' : worst && worst !== 'short' ? 'near' : '';
}

/** Events of the scene; a press goes to the first of the worst kind. */
function sceneLine(c: Context): StatusLine {
  const { editor } = c;
  const events = editor.reading.events.value;
  const worst = worstOf(events);
  if (worst) {
    const go = () =>
      goToEvent(
        c,
        counted(events).find((e) => e.kind === worst)!,
      );
    return { dot: dotOf(events), text: summary(events), go };
  }
  const scene = editor.scene.value;
  if (!scene) return { dot: '', text: TEXTS.ready };
  const { size } = scene.agents;
  if (!size) return { dot: '', text: TEXTS.mapReadyLanes(driven(scene.map.lanes)) };
  if (!editor.view.layers.value.log) return { dot: '', text: TEXTS.readyRoadUsers(size) };
  const edited = [...scene.agents.values()].filter(touched).length;
  return { dot: '', text: TEXTS.logShownDashed(edited, size) };
}
