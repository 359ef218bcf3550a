// The outcome of a change, in sentences for the toast and for screen readers.
import { counted } from '../../model/physics/events';
import type { Change } from '../../model/words/change-words';
import type { TrafficEvent } from '../../model/words/event-words';
import { goalTimeOf, nameIn, type Scene } from '../../model/document/scene';
import { num, seconds } from '../../model/base/units';
import { headline } from '../../model/words/verdict-words';
import type { Step } from '../document/step';
import type { Editor } from '../session/editor';
import { changedBy } from './request-for-change';
import { TEXTS } from '../../texts/editing/generation';

/** `Goal of Car 4 moved. 2 others changed.` "No other agent is affected" is omitted beside a collision. */
export function outcome(
  step: Step,
  scene: Scene,
  changes: readonly Change[],
  events: readonly TrafficEvent[] = [],
): string {
  const n = changes.length;
  const hits = counted(events).filter((e) => e.kind === 'collision');
  const isChanged = (id?: string): boolean => id !== undefined && [...changedBy(step)].includes(id);
  const own = hits.find((e) => isChanged(e.a.id) || isChanged(e.b?.id));
  const other = isChanged(own?.a.id) ? own?.b : own?.a;
  const hit = own && other ? TEXTS.collisionWith(other.name, seconds(own.time)) : '';
  const answers = step.agent && scene.others === 'react';
  if (n > 0 && (step.several || answers)) return TEXTS.othersChangedAndHit(n, step.name, hit);
  const isSilent = !answers || hits.length > 0 || scene.agents.size < 2;
  return `${step.name}.${isSilent ? hit : TEXTS.noOtherAffected}`;
}

/** The same, with the first affected road user and its reaction. */
export function spokenOutcome(
  step: Step,
  scene: Scene,
  changes: readonly Change[],
  events: readonly TrafficEvent[] = [],
): string {
  const first = changes[0];
  return `${outcome(step, scene, changes, events)}${first ? ` ${first.name} ${first.words}.` : ''}`;
}

/** `Reached in A, C, D.`: the verdict on the road user of the step, while it is selected; empty where there is none. */
export function spokenVerdict(editor: Editor, step: Step): string {
  const a = editor.agent.peek();
  const f = editor.reading.futures.peek();
  const scene = editor.scene.peek();
  if (!a || !f || !scene || a.id !== step.agent) return '';
  const said = headline(f, editor.reading.chosen.peek(), goalTimeOf(a), { type: a.type, nameOf: nameIn(scene) });
  return said ? `${said.title}.` : '';
}

export function spokenCollision(events: readonly TrafficEvent[]): string | null {
  const hit = counted(events).find((e) => e.kind === 'collision');
  return hit?.b ? TEXTS.collisionAnd(hit.a.name, hit.b.name, num(hit.time, 1)) : null;
}
