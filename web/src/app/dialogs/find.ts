// Results of the palette: actions, and for typed text also road users, scenes and times.
import type { Group } from '../../actions/action';
import type { Context } from '../../actions/context';
import { KINDS, type What } from '../../model/physics/cases';
import { KIND_WORDS } from '../../model/base/kinds';
import { sentenceOf } from '../../model/words/case-words';
import { ACTIONS, perform, possible } from '../../actions/registry';
import { GROUP_TITLES } from '../../texts/desk/groups';
import { HELPS } from '../../texts/desk/helps';
import { about } from '../scenes/drawer';
import { dayAndTime } from '../scenes/dates';
import { TEXTS } from '../../texts/desk/palette';

export interface FindEntry {
  readonly label: string;
  readonly note: string;
  readonly group: string;
  readonly icon: string;
  readonly keys: readonly string[];
  /** Ranked higher: the most common of several equal matches. */
  readonly common?: boolean;
  /** Not possible now; the note has the reason. */
  readonly off: boolean;
  run(): void;
}

const MOST = 60;
const MOST_OF_A_KIND = 8;
const MOST_RECENT = 4;
/** Groups under the name of the selected road user. */
const FOR_AGENT: readonly Group[] = ['goal', 'rounds', 'move', 'edit'];
const SCENES = TEXTS.scenes;
const ALSO_CALLED: Readonly<Record<string, string>> = TEXTS.alsoCalled;

export function find(c: Context, typed: string): FindEntry[] {
  const words = typed.trim().toLowerCase().split(/\s+/).filter(Boolean);
  if (!words.length) return [...actions(c, []), ...recent(c)].slice(0, MOST);
  const found = [
    ...cases(c, typed),
    ...actions(c, words),
    ...roadUsers(c, words),
    ...scenes(c, words),
    ...times(c, typed.trim()),
  ];
  return inGroups(found, words).slice(0, MOST);
}

/** Score of a text for the typed words: all must occur, best at its start or at the start of a word. */
export function fit(text: string, words: readonly string[]): number {
  const lower = text.toLowerCase();
  let sum = 0;
  for (const w of words) {
    const at = lower.indexOf(w);
    if (at < 0) return 0;
    sum += at === 0 ? 4 : /[\s(]/.test(lower[at - 1]) ? 3 : 1;
  }
  return sum / words.length;
}

/** Bonus of common entries, above the gap between a match at the start and one within. */
const COMMON = 1.5;

/** The group with the best match first, and in each group the best first. */
function inGroups(found: readonly FindEntry[], words: readonly string[]): FindEntry[] {
  const worth = (e: FindEntry): number => (e.off ? -10 : 0) + (e.common ? COMMON : 0) + (fit(e.label, words) || 0.5);
  const best = new Map<string, number>();
  for (const e of found) best.set(e.group, Math.max(best.get(e.group) ?? -Infinity, worth(e)));
  return [...found].sort(
    (p, q) => best.get(q.group)! - best.get(p.group)! || p.group.localeCompare(q.group) || worth(q) - worth(p),
  );
}

/** Order of a workflow: starting first, then continuing; groups of the selection come before all. */
const ORDER: readonly Group[] = [
  'place',
  'time',
  'scene',
  'variants',
  'rounds',
  'goal',
  'select',
  'look',
  'edit',
  'everything',
];

function actions(c: Context, words: readonly string[]): FindEntry[] {
  const agent = c.editor.agent.peek();
  const out: FindEntry[] = [];
  for (const a of ACTIONS) {
    const moves = a.group === 'move';
    if (a.id === 'palette' || a.id === 'deselect' || (!words.length && moves) || a.onOffer?.(c) === false) continue;
    const said = moves ? a.label : `${a.label} ${HELPS[a.help]} ${ALSO_CALLED[a.id] ?? ''}`;
    if (words.length && !fit(said, words)) continue;
    const can = possible(c, a);
    out.push({
      label: a.label,
      note: can === true ? HELPS[a.help] : can,
      group: agent && FOR_AGENT.includes(a.group) ? TEXTS.for(agent.name) : GROUP_TITLES[a.group],
      icon: a.icon ?? 'key',
      keys: a.keys ?? [],
      common: !moves && /^[A-Z]$/.test(a.keys?.[0] ?? ''),
      off: can !== true,
      run: () => perform(c, a.id),
    });
  }
  const titles = ORDER.map((group) => GROUP_TITLES[group]);
  const rank = (e: FindEntry): number => titles.indexOf(e.group);
  return out.sort((p, q) => Number(p.off) - Number(q.off) || rank(p) - rank(q));
}

const possibleEntry = { keys: [], off: false } as const;

function roadUsers({ editor, reveal }: Context, words: readonly string[]): FindEntry[] {
  return [...(editor.scene.peek()?.agents.values() ?? [])]
    .filter((a) => fit(a.name, words) || a.id === words[0])
    .slice(0, MOST_OF_A_KIND)
    .map((a) => ({
      ...possibleEntry,
      label: a.name,
      note: a.parked ? TEXTS.parked : KIND_WORDS[a.kind],
      group: TEXTS.roadUsers,
      icon: a.kind,
      run() {
        editor.select(a.id);
        reveal([a.id]);
      },
    }));
}

function sceneEntry(c: Context, s: Context['scenes']['list']['value'][number]): FindEntry {
  const when = s.readonly || !s.updated_at ? '' : ` · ${dayAndTime(s.updated_at)}`;
  const run = () => void c.library.open(s.id);
  return { ...possibleEntry, label: s.name, note: about(s) + when, group: SCENES, icon: 'list', run };
}

const scenes = (c: Context, words: readonly string[]): FindEntry[] =>
  c.scenes.list
    .peek()
    .filter((s) => fit(s.name, words))
    .slice(0, MOST_OF_A_KIND)
    .map((s) => sceneEntry(c, s));

/** The last opened scenes, except the open one. */
const recent = (c: Context): FindEntry[] =>
  c.scenes.recent
    .peek()
    .filter((id) => id !== c.editor.scene.peek()?.id)
    .flatMap((id) => c.scenes.find(id) ?? [])
    .slice(0, MOST_RECENT)
    .map((s) => sceneEntry(c, s));

/** `near miss between Car 7 and Cyclist 2`: a case to search, if one or two road users are named. */
function cases(c: Context, typed: string): FindEntry[] {
  const text = typed.toLowerCase();
  const all = [...(c.editor.scene.peek()?.agents.values() ?? [])];
  const named = all
    .map((a) => ({ a, at: text.search(new RegExp(`(^|\\W)${escaped(a.name.toLowerCase())}(\\W|$)`)) }))
    .filter((x) => x.at >= 0)
    .sort((p, q) => p.at - q.at)
    .slice(0, 2)
    .map((x) => x.a);
  if (!named.length) return [];
  return ASKED_FOR.filter(([kind, words]) => words.test(text) && (named.length === 2 || !KINDS[kind].two)).map(
    ([kind]) => ({
      ...possibleEntry,
      label: TEXTS.find(sentenceOf(kind, named[0].name, named[1]?.name ?? null)),
      note: TEXTS.triesSpeedsGoal,
      group: GROUP_TITLES.cases,
      icon: 'search',
      run() {
        c.editor.selectAll(named.map((a) => a.id));
        void c.searching.begin(
          kind,
          named.map((a) => a.id),
          true,
        );
      },
    }),
  );
}

const escaped = (s: string): string => s.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

const anyOf = (words: string): RegExp => new RegExp(words.split(' ').map(escaped).join('|'));
const ASKED_FOR: readonly (readonly [What, RegExp])[] = [
  ['near', anyOf(TEXTS.askedForNear)],
  ['collision', anyOf(TEXTS.askedForCollision)],
  ['first', anyOf(TEXTS.askedForFirst)],
  ['braking', anyOf(TEXTS.askedForBraking)],
  ['goal', anyOf(TEXTS.askedForGoal)],
  ['red', anyOf(TEXTS.askedForRed)],
];

/** `4.2` jumps to that time. */
function times({ editor }: Context, query: string): FindEntry[] {
  if (!/^\d([.,]\d)?$/.test(query)) return [];
  const run = () => {
    editor.playhead.pause();
    editor.playhead.moveTo(Number(query.replace(',', '.')));
  };
  return [
    { ...possibleEntry, label: TEXTS.goToS(query), note: TEXTS.playhead, group: GROUP_TITLES.time, icon: 'clock', run },
  ];
}
