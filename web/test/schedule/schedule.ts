// A schedule: actions of a user, two tabs, a network and other users on scenes, decided by one seed.
import { rename, setGoal, setSeed, setSize, type Command } from '../../src/model/document/commands';
import { finalWith, six } from '../edit/session';
import { Clock } from './clock';
import { Dice } from './dice';
import { OWN, SCENES, World, type OpenTab } from './world';

export interface Outcome {
  readonly seed: number;
  readonly steps: readonly string[];
  /** Violated invariants; empty where all hold. */
  readonly broken: readonly string[];
}

/** A possible event: its weight beside the others, and its action; null where it is impossible now. */
interface Happening {
  readonly weight: number;
  /** It concerns no single tab. */
  readonly everywhere?: true;
  run(t: OpenTab, c: Course): string | null | Promise<string | null>;
}

/** Car 1 of the open scene. */
const car = ({ tab }: OpenTab) => tab.editor.scene.peek()?.agents.get('1');

class Course {
  #count = 0;

  constructor(
    readonly dice: Dice,
    readonly world: World,
    readonly clock: Clock,
  ) {}

  /** A number that no other change uses. */
  fresh(): number {
    return ++this.#count;
  }

  goal(t: OpenTab): Command | null {
    const a = car(t);
    return a ? setGoal(a, { ...a.goal, pos: [this.fresh(), 3] }) : null;
  }

  command(t: OpenTab): Command | null {
    const n = this.fresh();
    const a = car(t);
    const made = [
      () => setSeed(n),
      () => rename(`name ${n}`),
      () => ({ ...setSeed(n), name: 'Seed', fold: 'seed' }),
      () => ({ ...setSeed(n), name: 'Seed', fold: 'seed' }),
      () => ({ ...setSeed(n), joins: true }),
      () => this.goal(t),
      () => a && setSize(a, 4 + (n % 20) / 10, 2),
    ];
    return this.dice.of(made)() ?? null;
  }
}

/** A short answer of the generator: it is saved with the document. */
const ANSWER = { chosen: 0, modes: six('1').modes.slice(0, 1) };

/** Opens a scene and selects the road user that the generator's answers are about. */
async function open({ tab }: OpenTab, id: string): Promise<void> {
  await tab.library.open(id);
  tab.editor.select('1');
}

const WEATHERS = {
  fair: () => ({}),
  slow: (d: Dice) => ({ there: d.below(400), back: d.below(400) }),
  heavy: (d: Dice) => ({ there: d.below(3000), back: d.below(3000) }),
  lossy: (d: Dice) => ({
    there: d.below(200),
    back: d.below(200),
    ...(d.chance(0.5) ? { fails: d.of(['request', 'reply', 'busy'] as const) } : {}),
  }),
  away: (d: Dice) => ({ there: d.below(50), fails: d.of(['request', 'busy'] as const) }),
};

const HAPPENINGS: Record<string, Happening> = {
  commit: {
    weight: 14,
    run(t, c) {
      const command = c.command(t);
      if (!command) return null;
      t.tab.editor.commits.run(command);
      return `${command.name}${command.fold ? ' (folds)' : ''}${command.joins ? ' (joins)' : ''}`;
    },
  },
  'begin a drag': {
    weight: 5,
    run({ tab: { editor } }) {
      if (editor.drag.active.peek() || !editor.scene.peek()) return null;
      editor.drag.begin({ part: 'goal', handle: 'body' });
      return '';
    },
  },
  preview: {
    weight: 9,
    run(t, c) {
      const command = t.tab.editor.drag.active.peek() ? c.goal(t) : null;
      if (!command) return null;
      t.tab.editor.drag.preview(command);
      return '';
    },
  },
  'end the drag': {
    weight: 5,
    run(t, c) {
      const { editor } = t.tab;
      if (!editor.drag.active.peek()) return null;
      const put = c.dice.chance(0.4);
      if (put) editor.drag.cancel();
      else editor.drag.end(c.goal(t));
      return put ? 'Esc' : 'release';
    },
  },
  undo: { weight: 5, run: ({ tab }) => (tab.editor.commits.undo(), '') },
  redo: { weight: 3, run: ({ tab }) => (tab.editor.commits.redo(), '') },
  'go to': {
    weight: 2,
    run({ tab: { editor } }, c) {
      const steps = editor.document.history?.kept().steps ?? [];
      const id = c.dice.chance(0.2) || !steps.length ? null : c.dice.of(steps).id;
      editor.commits.goTo(id);
      return String(id);
    },
  },
  title: {
    weight: 1,
    run({ tab: { editor } }, c) {
      const head = editor.document.history?.head;
      if (!head || editor.document.lock.peek()) return null;
      editor.document.entitle(head, `title ${c.fresh()}`);
      return '';
    },
  },
  'speed curve': {
    weight: 2,
    run({ tab: { curve, editor } }) {
      if (!editor.scene.peek() || curve.why) return null;
      curve.add(4, 0, 2);
      return '';
    },
  },
  answer: {
    weight: 8,
    run(t) {
      const { editor, generator } = t.tab;
      const q = generator.asked[generator.asked.length - 1];
      if (generator.asked.length <= t.answered || !car(t) || editor.scene.peek()!.id !== askedFor(q.scene()))
        return null;
      t.answered = generator.asked.length;
      q.on.final(finalWith({ '1': ANSWER }), 5);
      return '';
    },
  },
  open: {
    weight: 5,
    run(t, c) {
      const id = c.dice.of(SCENES);
      void open(t, id);
      return id;
    },
  },
  'edit here': {
    weight: 4,
    run({ tab }) {
      if (!tab.editor.document.lock.peek()) return null;
      tab.library.editHere();
      return '';
    },
  },
  'keep mine': {
    weight: 4,
    run({ tab }) {
      if (!tab.saving.conflict.peek() || tab.editor.document.lock.peek()) return null;
      void tab.saving.keepMine();
      return '';
    },
  },
  'take theirs': {
    weight: 3,
    run({ tab }) {
      if (!tab.saving.conflict.peek()?.etag || tab.editor.document.lock.peek()) return null;
      void tab.library.takeTheirs();
      return '';
    },
  },
  'close the tab': {
    weight: 4,
    run(t, c) {
      c.world.closeTab(t);
      return '';
    },
  },
  'another tab': {
    weight: 8,
    everywhere: true,
    async run(_, c) {
      // Without storage two tabs do not see each other's changes.
      if (c.world.tabs.length > (c.world.storeOff ? 0 : 1)) return null;
      return begin(c);
    },
  },
  'written elsewhere': {
    weight: 1,
    everywhere: true,
    run(_, c) {
      const id = c.dice.of(OWN);
      c.world.foreignWrite(id, `theirs ${c.fresh()}`);
      return id;
    },
  },
  'deleted elsewhere': {
    weight: 0.7,
    everywhere: true,
    run(_, c) {
      const id = c.dice.of(OWN);
      c.world.foreignDelete(id);
      return id;
    },
  },
  weather: {
    weight: 4,
    everywhere: true,
    run(_, c) {
      const name = c.dice.of(Object.keys(WEATHERS) as (keyof typeof WEATHERS)[]);
      c.world.weather = WEATHERS[name];
      return name;
    },
  },
  time: {
    weight: 16,
    everywhere: true,
    async run(_, c) {
      const ms = c.dice.of([5, 50, 250, 400, 700, 2500]) + c.dice.below(50);
      await c.clock.pass(ms);
      return `${ms} ms`;
    },
  },
};

const askedFor = (ref: unknown): string => {
  const { id, scene } = ref as { id?: string; scene?: { id: string } };
  return id ?? scene!.id;
};

/** Another tab opens a scene. */
async function begin(c: Course): Promise<string | null> {
  const id = c.dice.of(SCENES);
  const coming = c.world.openTab().then((t) => t && open(t, id));
  void coming;
  await c.clock.pass(1);
  return id;
}

/** All pending requests arrive, the server answers, and drags end. */
async function rest(c: Course): Promise<void> {
  c.world.weather = WEATHERS.fair;
  for (const { tab } of c.world.tabs) tab.editor.drag.end(null);
  await c.clock.pass(150_000);
  await c.world.checkAtRest();
}

const LEAST_STEPS = 20;
const MOST_STEPS = 90;

export async function runSchedule(seed: number): Promise<Outcome> {
  const dice = new Dice(seed);
  const clock = new Clock();
  const world = new World(dice, dice.chance(0.1));
  const c = new Course(dice, world, clock);
  const steps: string[] = world.storeOff ? ['(nothing is kept on this computer)'] : [];
  const unhandled = (e: unknown) => world.broken.push(`unhandled: ${String((e as Error)?.stack ?? e)}`);
  process.on('unhandledRejection', unhandled);
  clock.install();
  try {
    steps.push(`tab 1 opens ${await begin(c)}`);
    await clock.pass(100);
    const most = LEAST_STEPS + dice.below(MOST_STEPS - LEAST_STEPS);
    for (let i = 0; i < most && !world.broken.length; i++) {
      // A user acts when no promise is pending, like events of a page.
      await clock.pass(0);
      steps.push(await step(c));
      world.checkRequests();
    }
    await rest(c);
    if (!world.broken.length) await again(c, steps);
  } catch (e) {
    world.broken.push(`thrown: ${String((e as Error).stack)}`);
  } finally {
    clock.restore();
    process.off('unhandledRejection', unhandled);
  }
  return { seed, steps, broken: [...new Set(world.broken)] };
}

/** Tabs are closed at rest, without a conflict. */
async function closeAll(c: Course): Promise<void> {
  for (const t of [...c.world.tabs]) {
    const { editor, saving } = t.tab;
    if (!c.world.broken.length && saving.conflict.peek() && !editor.document.lock.peek()) await endConflict(t, c);
    c.world.closeTab(t);
  }
}

/** "Keep this version" ends a conflict, whatever the server has; repeated where that changed again since. */
async function endConflict({ name, tab }: OpenTab, c: Course): Promise<void> {
  for (let tries = 0; tries < 2 && tab.saving.conflict.peek(); tries++) {
    void tab.saving.keepMine();
    await rest(c);
  }
  const state = tab.saving.state.peek();
  if (state !== 'saved') c.world.broken.push(`${name} kept its version, and says "${state}"`);
}

/** Every scene is opened once more in a tab of its own, until it is at rest. */
async function again(c: Course, steps: string[]): Promise<void> {
  await closeAll(c);
  for (const id of SCENES) {
    steps.push(`${id} is opened in a new tab`);
    void c.world.openTab().then((t) => t && open(t, id));
    await rest(c);
    await closeAll(c);
    if (c.world.broken.length) return;
  }
}

const WEIGHT = Object.values(HAPPENINGS).reduce((sum, h) => sum + h.weight, 0);

async function step(c: Course): Promise<string> {
  const { dice, world } = c;
  for (;;) {
    let at = dice.next() * WEIGHT;
    const [name, happening] = Object.entries(HAPPENINGS).find(([, h]) => (at -= h.weight) < 0)!;
    const t = world.tabs.length ? dice.of(world.tabs) : null;
    if (!t && name !== 'another tab') continue;
    const said = await happening.run(t!, c);
    const who = happening.everywhere ? '' : `${t!.name} `;
    if (said !== null) return `${who}${name}${said ? `: ${said}` : ''}`;
  }
}
