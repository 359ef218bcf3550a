// What a file cannot hold of a scene, in plain words and with the numbers of that scene.
import type { Scene } from '../../model/scene';

export interface Loss {
  /** `Goals` */
  readonly what: string;
  /** `2 that you set become finished motion` */
  readonly how: string;
}

const count = (scene: Scene, is: (a: Scene['agents'] extends ReadonlyMap<string, infer A> ? A : never) => boolean) =>
  [...scene.agents.values()].filter(is).length;
const many = (n: number, one: string, more = `${one}s`): string => `${n} ${n === 1 ? one : more}`;

const FINER = [
  ['truck', 'truck'],
  ['bus', 'bus', 'buses'],
  ['motorcycle', 'motorcycle'],
] as const;

/** Trucks, buses and motorcycles of the scene. */
function finer(scene: Scene): string {
  const all = FINER.flatMap(([kind, one, more]) => {
    const n = count(scene, (a) => a.kind === kind);
    return n ? many(n, one, more) : [];
  });
  return all.length ? `${all.join(', ')}: they become plain vehicles` : 'kinds are vehicle, pedestrian and cyclist';
}

function goals(scene: Scene): string {
  const n = count(scene, (a) => a.goal.pos !== null);
  return n
    ? `${many(n, 'flag')} that you set: finished motion, no flag to drag`
    : 'starts that you set: finished motion';
}

function notes(scene: Scene): string {
  const n = count(scene, (a) => a.note !== '');
  return n ? `${many(n, 'note')}, names and tags stay behind` : 'names and tags stay behind';
}

type Words = readonly [what: string, how: string | ((scene: Scene) => string)];

/** The server's codes of losses, the worst first. */
const WORDS: Record<string, Words> = {
  'no-road-users': ['Road users', (s) => `all ${s.agents.size}: the road goes out alone`],
  'no-map': ['Road', (s) => `${many(s.map.lanes.size, 'lane')}, kerbs, crosswalks`],
  'no-signals': [
    'Traffic lights',
    (s) => (s.signals.length ? `lights of ${many(s.signals.length, 'lane')}` : 'there are none'),
  ],
  'no-conditions': ['Goals', goals],
  'no-modes': ['Other futures', 'the chosen ones alone go out'],
  'no-generated': ['What was worked out', 'all motion counts as recorded'],
  'single-ego': ['Other goals', 'one road user alone has a task'],
  'late-road-users': ['Late road users', 'strict readers refuse who comes after the first moment'],
  'no-unseen': ['Unseen road users', 'whom nobody saw in the recording'],
  'no-subtype': ['Finer kinds', finer],
  'no-sizes': ['Sizes', 'readers take usual ones'],
  'no-velocity': ['Speeds', 'readers find them from places and times'],
  'no-timing': ['Time', 'which moment is now, and how long the scene is'],
  'no-validity-gaps': ['Gaps', 'moments at which nobody saw a road user'],
  'no-judgements': ['Verdicts', 'chances, faults, and who reacts to whom'],
  'no-trips': ['Some trips', 'road users off the lanes drive in the recording alone'],
  'no-rollouts': ['Some rollouts', 'the challenge asks for 32: draw as many variants first'],
  'no-lane-graph': ['Links of lanes', 'which follow each other, and lie side by side'],
  'no-lane-width': ['Widths of lanes', 'readers take usual ones'],
  'no-lane-type': ['Some kinds of lanes', 'they become the nearest that there is'],
  'no-speed-limits': ['Speed limits', 'they are not in the file'],
  'no-signal-states': ['Some states of lights', 'all but red, yellow and green'],
  'no-z': ['Heights', 'everything lies flat'],
  'no-drivable': ['Paved areas', 'lanes and kerbs alone say where the road is'],
  'no-lines': ['Painted lines', 'markings and kerbs as lines of their own'],
  'no-areas': ['Some areas', 'such as driveways and speed bumps'],
  'no-neighbors': ['Lanes side by side', 'where they are so for a part of their length'],
  'geometry-approximated': ['Exact lines', 'they are drawn anew, and rounded a little'],
  'no-roles': ['Roles', 'who recorded, and who was asked about'],
  'no-notes': ['Names and notes', notes],
  'no-licence': ['Licence', (s) => (s.licence ? `“${s.licence}” is not named` : 'it is not named')],
  'no-ids': ['Numbers', 'road users and lanes are counted anew'],
  'ids-renumbered': ['Numbers', 'some road users and lanes get new ones'],
  'long-record': ['Usual length', 'nothing is cut, but some readers take no more than a recording'],
};
const ORDER = Object.keys(WORDS);
/** Codes without words stand at the end. */
const rank = (code: string): number => (ORDER.indexOf(code) + ORDER.length + 1) % (ORDER.length + 1);

/** Of codes as the server sends them, a list with commas. */
export function lossesOf(codes: string | null, scene: Scene): readonly Loss[] {
  return (codes ?? '')
    .split(',')
    .map((s) => s.trim())
    .filter(Boolean)
    .sort((a, b) => rank(a) - rank(b))
    .map((code) => {
      const words = WORDS[code];
      if (!words) return { what: plainly(code), how: 'not in the file' };
      const [what, how] = words;
      return { what, how: typeof how === 'string' ? how : how(scene) };
    });
}

/** `no-lane-width`: `Lane width` */
function plainly(code: string): string {
  const words = code.replace(/^no-/, '').replaceAll('-', ' ');
  return words[0].toUpperCase() + words.slice(1);
}

/** What is in the file all the same, in a line. */
export function stays(losses: readonly Loss[], scene: Scene): string {
  const lost = new Set(losses.map((l) => l.what));
  const parts: readonly (readonly [kept: boolean, words: string])[] = [
    [!lost.has('Road'), 'the road'],
    [scene.signals.length > 0 && !lost.has('Traffic lights'), 'traffic lights'],
    [scene.agents.size > 0 && !lost.has('Road users'), many(scene.agents.size, 'road user')],
  ];
  const kept = parts.filter(([is]) => is).map(([, words]) => words);
  if (!lost.has('Road users')) kept.push(`${scene.duration.toFixed(1)} s at 10 steps a second`);
  return kept.join(', ');
}
