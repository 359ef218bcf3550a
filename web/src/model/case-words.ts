// A case in words: what is looked for, what a found one is, and what came nearest.
import { KINDS, type Moment, type Sought, type What } from './cases';
import { startPose, type Agent, type Scene } from './scene';
import { num, seconds, speedLabel, type SpeedUnit } from './units';

export const KIND_WORDS: Readonly<Record<What, string>> = {
  near: 'Near miss',
  collision: 'Collision',
  first: 'Who comes first',
  braking: 'Hard braking, no collision',
  goal: 'Goal reached, little gap',
};

/** What the search is called. */
export const TITLES: Readonly<Record<What, string>> = {
  near: 'Find a near miss',
  collision: 'Find a collision',
  first: 'Find who comes first',
  braking: 'Find hard braking',
  goal: 'Find a tight arrival',
};

/** As in `find a near miss between …`. */
const SENTENCES: Readonly<Record<What, (a: string, b: string | null) => string>> = {
  near: (a, b) => `a near miss between ${a} and ${b ?? 'somebody'}`,
  collision: (a, b) => `a collision of ${a} with ${b ?? 'somebody'}`,
  first: (a, b) => `${a} just before ${b ?? 'somebody'}`,
  braking: (a) => `hard braking of ${a} without a collision`,
  goal: (a, b) => `${a} at its goal with little gap to ${b ?? 'others'}`,
};

export const sentenceOf = (what: What, a: string, b: string | null): string => SENTENCES[what](a, b);

/** `0.3 m at 3.6 s` */
export function momentWords({ what }: Sought, m: Moment): string {
  const at = `at ${seconds(m.time)}`;
  if (what === 'collision') return m.found ? `collision ${at}` : `${num(m.value, 1)} m ${at}`;
  if (what === 'first') return m.value >= 0 ? `${num(m.value, 1)} s ahead ${at}` : `${num(-m.value, 1)} s behind ${at}`;
  return `${num(m.value, 1)} ${KINDS[what].unit} ${at}`;
}

/** How it happens: where the other one is, and what the one who is tried begins with. */
export function howWords(a: Agent, scene: Scene, m: Moment, unit: SpeedUnit): string[] {
  const start = startPose(a);
  const other = m.other === null ? null : scene.agents.get(m.other)?.name;
  return [
    start ? `starts at ${speedLabel(start.speed, unit)}` : '',
    a.goal.pos ? `at its goal at ${seconds(a.goal.time)}` : '',
    other && m.side ? `${other} ${m.side}` : '',
  ].filter(Boolean);
}

/** `No near miss in 300 tries. Closest was 1.4 m at 3.9 s.` */
export function nothingWords(s: Sought, tries: number, closest: Moment | null): string {
  const none = `Not found in ${tries} tries.`;
  return closest ? `${none} Nearest to it was ${momentWords(s, closest)}.` : none;
}
