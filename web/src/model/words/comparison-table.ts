// The table of two compared variants, for their panel.
import { meetsGoal } from '../physics/playback';
import { counted } from '../physics/events';
import type { Scene } from '../document/scene';
import { metres, num, seconds } from '../base/units';
import type { ComparedVariant, Diverging } from './comparison';
import { summary } from './event-words';
import { deedOf, type Deed } from './variant-names';
import { TEXTS } from '../../texts/scene/comparison';

type ComparedSide = Pick<ComparedVariant, 'events' | 'scene' | 'set'>;

export interface ComparisonRow {
  readonly what: string;
  readonly left: string;
  readonly right: string;
  readonly differs: boolean;
}

const MOST_ROWS = 5;

const row = (what: string, left: string, right: string): ComparisonRow => ({
  what,
  left,
  right,
  differs: left !== right,
});

/** The events, the road users that differ most, and the figures of both, where they have them. */
export function comparisonRows(
  left: ComparedSide,
  right: ComparedSide,
  diverging: readonly Diverging[],
): ComparisonRow[] {
  const gap = ({ set }: ComparedSide): string => (set.score?.pet == null ? '–' : seconds(set.score.pet));
  const events = (s: ComparedSide): string => (counted(s.events).length ? summary(s.events) : TEXTS.none);
  const closing = ({ set }: ComparedSide): string => (set.score?.minTtc == null ? '–' : seconds(set.score.minTtc));
  return [
    row(TEXTS.events, events(left), events(right)),
    ...diverging.slice(0, MOST_ROWS).map((p) => deeds(left.scene, p)),
    row(TEXTS.minPet, gap(left), gap(right)),
    row(TEXTS.minTtc, closing(left), closing(right)),
    ...goals(left, right),
  ];
}

function deeds(scene: Scene, { agent, left, right }: Diverging): ComparisonRow {
  const [a, b] = [deedOf(scene, left), deedOf(scene, right)];
  const [p, q] = [deedWords(a), deedWords(b)];
  return p === q ? row(agent.name, TEXTS.goes(metres(a.way, 0)), TEXTS.goes(metres(b.way, 0))) : row(agent.name, p, q);
}

const TURNS = { left: TEXTS.turnsLeft, right: TEXTS.turnsRight } as const;

function deedWords(d: Deed): string {
  if (d.waits >= 1) return d.stands ? TEXTS.stoppedS(num(d.waits, 1)) : TEXTS.waitsS(num(d.waits, 1));
  return d.turn === 'straight' ? TEXTS.goes(metres(d.way, 0)) : TURNS[d.turn];
}

function goals(left: ComparedSide, right: ComparedSide): ComparisonRow[] {
  const words = (s: ComparedSide, id: string): string => {
    const a = s.scene.agents.get(id);
    const met = a ? meetsGoal(s.set, a) : null;
    return met === null ? TEXTS.unknown : met ? TEXTS.reached : TEXTS.missed;
  };
  return [...left.scene.agents.values()]
    .filter((a) => a.goal.pos)
    .slice(0, 2)
    .map((a) => row(TEXTS.goalOf(a.name), words(left, a.id), words(right, a.id)));
}
