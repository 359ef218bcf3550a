// What a change led to, in sentences for the toast and for screen readers.
import { counted } from '../model/physics/events';
import type { Change } from '../model/words/change-words';
import type { TrafficEvent } from '../model/words/event-words';
import { goalTimeOf, nameIn, type Scene } from '../model/document/scene';
import { num, seconds } from '../model/base/units';
import { headline } from '../model/words/verdict-words';
import type { Step } from './document/step';
import type { Editor } from './editor';
import { TEXTS } from '../texts/editing/generation';

/** `Goal of Car 4 moved. 2 others changed.` That nobody had to change is not said beside a collision. */
export function outcome(
  step: Step,
  scene: Scene,
  changes: readonly Change[],
  events: readonly TrafficEvent[] = [],
): string {
  const n = changes.length;
  const hits = counted(events).filter((e) => e.kind === 'collision');
  const own = hits.find((e) => e.a.id === step.agent || e.b?.id === step.agent);
  const other = own?.a.id === step.agent ? own?.b : own?.a;
  const hit = own && other ? TEXTS.itHitsAt(other.name, seconds(own.time)) : '';
  if (step.several && n > 0) return TEXTS.othersChanged(n, step.name);
  if (!step.agent || scene.others !== 'react') return `${step.name}.${hit}`;
  const alone = scene.agents.size < 2;
  if (n === 0) return `${step.name}.${hit || (hits.length || alone ? '' : TEXTS.nobodyElseHad)}`;
  return TEXTS.othersChangedAndHit(n, step.name, hit);
}

/** The same with who changed first and how. */
export function spokenOutcome(
  step: Step,
  scene: Scene,
  changes: readonly Change[],
  events: readonly TrafficEvent[] = [],
): string {
  const first = changes[0];
  return `${outcome(step, scene, changes, events)}${first ? ` ${first.name} ${first.words}.` : ''}`;
}

/** `Reached in A, C, D.`: the verdict on whom the step was about, while it is selected; empty where nobody has one. */
export function spokenVerdict(editor: Editor, step: Step): string {
  const a = editor.agent.peek();
  const f = editor.futures.peek();
  const scene = editor.scene.peek();
  if (!a || !f || !scene || a.id !== step.agent) return '';
  const said = headline(f, editor.chosen.peek(), goalTimeOf(a), { type: a.type, nameOf: nameIn(scene) });
  return said ? `${said.title}.` : '';
}

export function spokenCollision(events: readonly TrafficEvent[]): string | null {
  const hit = counted(events).find((e) => e.kind === 'collision');
  return hit?.b ? TEXTS.collisionAnd(hit.a.name, hit.b.name, num(hit.time, 1)) : null;
}
