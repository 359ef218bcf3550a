// The status line: what the generator is doing, or what happens in the scene.
import type { Lane } from '../../model/document/lanemap';
import { num } from '../../model/base/units';
import { counted, worstOf } from '../../model/physics/events';
import { summary, type TrafficEvent } from '../../model/words/event-words';
import { KIND_WORDS } from '../../model/base/kinds';
import { touched } from '../../model/document/scene';
import { placedBy } from '../../actions/place';
import { goToEvent } from '../../actions/time';
import type { Context } from '../../actions/context';
import type { Status as GeneratorStatus } from '../../edit/answers';
import { outOfReach } from '../../edit/goal-verdict';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/desk/hud';

interface Line {
  /** Colour of the dot; empty for all well. */
  readonly dot: '' | 'busy' | 'near' | 'collision';
  readonly text: string;
  /** Where a press on it leads. */
  readonly go?: () => void;
}

export function Status() {
  const c = useApp();
  return c.editor.calm.read(() => statusLine(c));
}

function statusLine(c: Context) {
  const { editor } = c;
  const s = editor.status.value;
  // At an event the line says what happens in the scene, not what the generator did last.
  if (editor.selectedEvent.value && (s.kind === 'settled' || s.kind === 'ready')) return row(sceneLine(c));
  if (editor.layouts.isOpen.value) return row(mapLine(c));
  const work = workLine(c);
  if (work && !editor.dragging.value) return row(work);
  const kind = placedBy(c);
  if (editor.filling.wish.value) return row({ dot: '', text: TEXTS.previewNothing });
  if (kind) return row({ dot: '', text: TEXTS.placing(KIND_WORDS[kind]) });
  if (s.kind === 'refining') return refining(s);
  const some = editor.selected.value.length;
  if (some > 1 && (s.kind === 'settled' || s.kind === 'ready'))
    return row({ dot: 'busy', text: TEXTS.ofSelected(some, editor.scene.value!.agents.size) });
  return row(lineFor(c, s));
}

/** How far a search is that goes on, or the making of variants. */
function workLine({ searching, variants }: Context): Line | null {
  const making = variants.making.value;
  if (making) return { dot: 'busy', text: TEXTS.makingVariants(making.made.length, making.of) };
  const open = searching.open.value;
  if (open?.state.value !== 'running') return null;
  const { tried, of } = open.progress.value;
  return { dot: 'busy', text: TEXTS.searching(tried, of, open.found.value.length) };
}

/** Lanes for motor vehicles, which are what one calls lanes. */
const driven = (lanes: ReadonlyMap<string, Lane>): number =>
  [...lanes.values()].filter((l) => l.kind === 'road').length;

/** What the map that is being made holds. */
function mapLine({ editor }: Context): Line {
  const made = editor.layouts.made.value;
  if (!made) return { dot: 'busy', text: TEXTS.drawing };
  const { lanes, crosswalks } = made.scene.map;
  const bad = made.checks.some((k) => !k.passed);
  const words = TEXTS.lanesCrosswalks(driven(lanes), crosswalks.length, Math.max(1, Math.round(made.ms)));
  return { dot: bad ? 'near' : '', text: words };
}

/** Not a component of its own, nor is the other one: a drag goes from one to the other and back in every frame. */
function row({ dot, text, go }: Line) {
  const words = (
    <>
      <span class={`dot ${dot}`} />
      {text}
    </>
  );
  if (!go) return <div class="row">{words}</div>;
  return (
    <button type="button" class="row" title={TEXTS.goToTheFirst} onClick={go}>
      {words}
    </button>
  );
}

type RefiningStatus = Extract<GeneratorStatus, { kind: 'refining' }>;

function refining({ step, steps, ms, part }: RefiningStatus) {
  const after = TEXTS.ms(ms.toFixed(0));
  const words = part
    ? TEXTS.refining(part, after)
    : step
      ? TEXTS.refiningStep(step, steps, after)
      : ms
        ? TEXTS.firstGuess(after)
        : TEXTS.workingOutFutures;
  return (
    <div class="row">
      <span class="steps">
        {Array.from({ length: steps }, (_, i) => (
          <i key={i} class={i < step ? 'd' : ''} />
        ))}
      </span>
      {words}
    </div>
  );
}

function lineFor(c: Context, s: Exclude<GeneratorStatus, RefiningStatus>): Line {
  const { editor } = c;
  switch (s.kind) {
    case 'loading':
      return { dot: 'busy', text: TEXTS.loadingTheScene };
    case 'slow': {
      const keep = editor.dragging.value ? TEXTS.youCanKeepDragging : '';
      return { dot: 'busy', text: TEXTS.thisTakesLonger(num(s.ms / 1000, 1), keep) };
    }
    case 'refused':
      return { dot: 'collision', text: s.words };
    case 'away': {
      const n = editor.away.value?.waiting ?? 0;
      return { dot: 'near', text: n ? TEXTS.generatorAway(n) : TEXTS.generatorAwayOnly };
    }
    case 'settled':
      return settledLine(c, s.ms, s.adapted);
    case 'ready':
      return sceneLine(c);
  }
}

function settledLine(c: Context, ms: number, adapted: number | null): Line {
  const { editor } = c;
  const a = editor.agent.value;
  const bad = a?.goal.pos ? outOfReach(editor, a) : null;
  if (bad && !bad.outranked) return { dot: 'near', text: TEXTS.showingFutures };
  if (!editor.selection.value) return sceneLine(c);
  const n = editor.futures.value?.modes.length ?? 6;
  const parts = [
    TEXTS.futures(n === 6 ? TEXTS.six : n),
    ms ? TEXTS.ms(ms.toFixed(0)) : '',
    adapted ? TEXTS.othersAdapted(adapted) : '',
  ];
  // Beside a collision nothing is green.
  return { dot: dotOf(editor.events.value), text: parts.filter(Boolean).join(' · ') };
}

function dotOf(events: readonly TrafficEvent[]): Line['dot'] {
  const worst = worstOf(events);
  return worst === 'collision' ? 'collision' : worst && worst !== 'short' ? 'near' : '';
}

/** What happens in the scene; a press leads to the first of what is worst. */
function sceneLine(c: Context): Line {
  const { editor } = c;
  const events = editor.events.value;
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
  if (!editor.layers.value.log) return { dot: '', text: TEXTS.readyRoadUsers(size) };
  const edited = [...scene.agents.values()].filter(touched).length;
  return { dot: '', text: TEXTS.logShownDashed(edited, size) };
}
