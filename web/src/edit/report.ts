// What a change led to, in sentences for the toast and for screen readers.
import type { Change } from '../model/changes';
import type { TrafficEvent } from '../model/events';
import type { Scene } from '../model/scene';
import type { Step } from './editor';

/** `Goal of Car 4 moved. 2 others changed.` */
export function outcome(step: Step, scene: Scene, changes: readonly Change[]): string {
  const n = changes.length;
  if (!step.agent || scene.others !== 'react') return `${step.name}.`;
  if (n === 0) return `${step.name}. Nobody else had to change.`;
  return `${step.name}. ${n} other${n === 1 ? '' : 's'} changed.`;
}

/** The same with who changed first and how. */
export function spokenOutcome(step: Step, scene: Scene, changes: readonly Change[]): string {
  const first = changes[0];
  return `${outcome(step, scene, changes)}${first ? ` ${first.name} ${first.words}.` : ''}`;
}

export function spokenCollision(events: readonly TrafficEvent[]): string | null {
  const hit = events.find((e) => e.kind === 'collision');
  return hit ? `Collision, ${hit.a.name} and ${hit.b.name}, ${hit.time.toFixed(1)} seconds.` : null;
}
