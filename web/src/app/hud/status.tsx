// The status line: what the generator is doing, or what happens in the scene.
import { summary, worstOf, type TrafficEvent } from '../../model/events';
import { KIND_NAMES } from '../../model/kinds';
import { touched } from '../../model/scene';
import { placedBy } from '../../actions/place';
import type { Context } from '../../actions/context';
import type { Status as GeneratorStatus } from '../../edit/answers';
import { outOfReach } from '../../edit/goal-verdict';
import { useApp } from '../parts/app-context';

interface Line {
  /** Colour of the dot; empty for all well. */
  readonly dot: '' | 'busy' | 'near' | 'collision';
  readonly text: string;
}

export function Status() {
  const c = useApp();
  const { editor } = c;
  const s = editor.status.value;
  // At an event the line says what happens in the scene, not what the generator did last.
  if (editor.selectedEvent.value && (s.kind === 'settled' || s.kind === 'ready')) return row(sceneLine(c));
  if (editor.layouts.isOpen.value) return row(mapLine(c));
  const kind = placedBy(c);
  if (editor.filling.wish.value) return row({ dot: '', text: 'Preview: nothing added yet' });
  if (kind) return row({ dot: '', text: `Placing: ${KIND_NAMES[kind].toLowerCase()}` });
  if (s.kind === 'refining') return refining(s);
  const some = editor.selected.value.length;
  if (some > 1 && (s.kind === 'settled' || s.kind === 'ready'))
    return row({ dot: 'busy', text: `${some} of ${editor.scene.value!.agents.size} selected` });
  return row(lineFor(c, s));
}

/** What the map that is being made holds. */
function mapLine({ editor }: Context): Line {
  const made = editor.layouts.made.value;
  if (!made) return { dot: 'busy', text: 'Drawing …' };
  const { lanes, crosswalks } = made.scene.map;
  const driven = [...lanes.values()].filter((l) => l.kind === 'road').length;
  const bad = made.checks.some((k) => !k.passed);
  const words = `${driven} lanes · ${crosswalks.length} crosswalks · worked out in ${Math.round(made.ms)} ms`;
  return { dot: bad ? 'near' : '', text: words };
}

/** Not a component of its own, nor is the other one: a drag goes from one to the other and back in every frame. */
const row = ({ dot, text }: Line) => (
  <div class="row">
    <span class={`dot ${dot}`} />
    {text}
  </div>
);

type RefiningStatus = Extract<GeneratorStatus, { kind: 'refining' }>;

function refining({ step, steps, ms, part }: RefiningStatus) {
  const after = `${ms.toFixed(0)} ms`;
  const words = part
    ? `Refining ${part} · ${after}`
    : step
      ? `Refining, step ${step} of ${steps} · ${after}`
      : ms
        ? `First guess · ${after}`
        : 'Working out futures …';
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
      return { dot: 'busy', text: 'Loading the scene …' };
    case 'slow': {
      const keep = editor.dragging.value ? ' You can keep dragging.' : '';
      return { dot: 'busy', text: `This takes longer than usual (${(s.ms / 1000).toFixed(1)} s).${keep}` };
    }
    case 'refused':
      return { dot: 'collision', text: s.words };
    case 'away': {
      const n = editor.away.value?.waiting ?? 0;
      return { dot: 'near', text: `Generator away${n ? ` · ${n} change${n > 1 ? 's' : ''} waiting` : ''}` };
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
  if (bad && !bad.outranked) return { dot: 'near', text: 'Showing futures to the nearest reachable point' };
  if (!editor.selection.value) return sceneLine(c);
  const n = editor.futures.value?.modes.length ?? 6;
  const parts = [
    `${n === 6 ? 'Six' : n} futures`,
    ms ? `${ms.toFixed(0)} ms` : '',
    adapted ? `${adapted} other${adapted > 1 ? 's' : ''} adapted` : '',
  ];
  // Beside a collision nothing is green.
  return { dot: dotOf(editor.events.value), text: parts.filter(Boolean).join(' · ') };
}

function dotOf(events: readonly TrafficEvent[]): Line['dot'] {
  const worst = worstOf(events);
  return worst === 'collision' ? 'collision' : worst && worst !== 'short' ? 'near' : '';
}

/** What happens in the scene. */
function sceneLine({ editor }: Context): Line {
  const events = editor.events.value;
  if (worstOf(events)) return { dot: dotOf(events), text: summary(events) };
  const scene = editor.scene.value;
  if (!scene) return { dot: '', text: 'Ready' };
  const { size } = scene.agents;
  if (!size) return { dot: '', text: `Map ready · ${scene.map.lanes.size} lanes` };
  if (!editor.layers.value.log) return { dot: '', text: `Ready · ${size} road users` };
  const edited = [...scene.agents.values()].filter(touched).length;
  return { dot: '', text: `Log shown dashed · ${edited} of ${size} road users edited` };
}
