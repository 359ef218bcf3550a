// What the palette finds: actions, and for what is typed road users, scenes and times.
import type { Group } from '../../actions/action';
import type { Context } from '../../actions/context';
import { ACTIONS, perform, possible } from '../../actions/registry';

export interface Entry {
  readonly label: string;
  readonly note: string;
  readonly group: string;
  readonly icon: string;
  readonly keys: readonly string[];
  /** Not possible now; the note says why. */
  readonly off: boolean;
  run(): void;
}

const MOST = 60;
const MOST_ROAD_USERS = 8;
const MOST_SCENES = 6;
/** Groups that stand under the name of the selected road user. */
const FOR_AGENT: readonly Group[] = ['Goal and futures', 'Move'];

export function find(c: Context, typed: string): Entry[] {
  const query = typed.trim().toLowerCase();
  const found = actions(c, query);
  if (query) found.push(...roadUsers(c, query), ...scenes(c, query), ...times(c, query));
  return found.slice(0, MOST);
}

function actions(c: Context, query: string): Entry[] {
  const agent = c.editor.agent.peek();
  const out: Entry[] = [];
  for (const a of ACTIONS) {
    const moves = a.group === 'Move';
    if (a.id === 'palette' || (!query && moves)) continue;
    const words = moves ? a.label : `${a.label} ${a.help}`;
    if (query && !words.toLowerCase().includes(query)) continue;
    const can = possible(c, a);
    out.push({
      label: a.label,
      note: can === true ? a.help : can,
      group: agent && FOR_AGENT.includes(a.group) ? `For ${agent.name}` : a.group,
      icon: a.icon ?? 'key',
      keys: a.keys ?? [],
      off: can !== true,
      run: () => perform(c, a.id),
    });
  }
  const inLabel = (e: Entry): boolean => query !== '' && e.label.toLowerCase().includes(query);
  const forAgent = (e: Entry): boolean => e.group.startsWith('For');
  return out.sort(
    (p, q) =>
      Number(p.off) - Number(q.off) ||
      Number(forAgent(q)) - Number(forAgent(p)) ||
      p.group.localeCompare(q.group) ||
      Number(inLabel(q)) - Number(inLabel(p)),
  );
}

const possibleEntry = { keys: [], off: false } as const;

function roadUsers({ editor, stage }: Context, query: string): Entry[] {
  return [...(editor.scene.peek()?.agents.values() ?? [])]
    .filter((a) => a.name.toLowerCase().includes(query) || a.id === query)
    .slice(0, MOST_ROAD_USERS)
    .map((a) => ({
      ...possibleEntry,
      label: a.name,
      note: a.parked ? 'parked' : a.type,
      group: 'Road users',
      icon: a.kind,
      run() {
        editor.select(a.id);
        if (!a.logStart) return;
        const { x, y } = a.logStart;
        stage.glide.by((v) => v.centre(x, y));
      },
    }));
}

function scenes(c: Context, query: string): Entry[] {
  return c.scenes.list
    .peek()
    .filter((s) => s.name.toLowerCase().includes(query))
    .slice(0, MOST_SCENES)
    .map((s) => ({
      ...possibleEntry,
      label: s.name,
      note: 'open',
      group: 'Scenes',
      icon: 'list',
      run: () => void c.library.open(s.id),
    }));
}

/** `4.2` jumps to that time. */
function times({ editor }: Context, query: string): Entry[] {
  if (!/^\d(\.\d)?$/.test(query)) return [];
  const run = () => {
    editor.playhead.pause();
    editor.setTime(Number(query));
  };
  return [{ ...possibleEntry, label: `Go to ${query} s`, note: 'playhead', group: 'Time', icon: 'clock', run }];
}
