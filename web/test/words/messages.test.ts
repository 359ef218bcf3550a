// Sentences of the server: each code has its English and its German, and each contains all of its values.
import { readdirSync, readFileSync } from 'node:fs';
import ts from 'typescript';
import { describe, expect, it } from 'vitest';
import { toldIn } from '../../src/model/base/units';
import type { Message } from '../../src/model/document/message';
import type { Reach } from '../../src/model/document/futures';
import { armTitles } from '../../src/model/words/arm-titles';
import { reachWords } from '../../src/model/words/reach-words';
import { messageText, withArms } from '../../src/model/words/message-text';
import { SENTENCES as FILES } from '../../src/texts/messages/file-messages';
import { german as germanFiles } from '../../src/texts/german/messages/file-messages';
import { german as germanMaps } from '../../src/texts/german/messages/map-messages';
import { german } from '../../src/texts/german/messages/messages';
import { SENTENCES as MAPS } from '../../src/texts/messages/map-messages';
import { german as germanProblems } from '../../src/texts/german/messages/problem-messages';
import { german as germanRefusals } from '../../src/texts/german/messages/refusal-messages';
import { WORDS } from '../../src/texts/german/refusal-words';
import { SENTENCES as PROBLEMS } from '../../src/texts/messages/problem-messages';
import { SENTENCES as REFUSALS } from '../../src/texts/messages/refusal-messages';
import { SENTENCES } from '../../src/texts/messages/messages';
import type { Sentence, Values } from '../../src/texts/table';

const { sentences: kinds, words } = JSON.parse(readFileSync('../assets/messages.json', 'utf8')) as {
  sentences: { code: string; english: string; one?: string; values: string[] }[];
  words: Record<string, string[]>;
};
const together = (...tables: { readonly sentences: object }[]): object =>
  Object.assign({}, ...tables.map((table) => table.sentences));
const LANGUAGES = {
  english: together(SENTENCES, FILES, MAPS, PROBLEMS, REFUSALS),
  german: together(german, germanFiles, germanMaps, germanProblems, germanRefusals),
} as Record<string, Record<string, Sentence>>;

/** A sentence with its title, written out. */
function written(sentence: Sentence, values: Values): string {
  if (typeof sentence === 'string') return sentence;
  if (typeof sentence === 'function') return sentence(values);
  return `${sentence.title(values)}. ${written(sentence.rest, values)}`;
}

/** The values in a sentence. */
function asked(sentence: Sentence): string[] {
  const names = new Set<string>();
  written(sentence, new Proxy({}, { get: (_, name) => (names.add(String(name)), `<${String(name)}>`) }));
  return [...names].sort();
}

/** Regular expressions with letters that are no words: by file, the patterns and the reason. */
const PATTERNS: Readonly<Record<string, readonly (readonly [pattern: RegExp, reason: string])[]>> = {
  'actions/keys.ts': [[/Digit|Key/, 'codes of keys, from the browser']],
  'app/dialogs/shortcuts.tsx': [[/^\/\^[a-z]+-|\(next\|previous\)|\(slower\|faster\)/, 'ids of actions']],
  'app/page-input.ts': [[/^\/\^\(?Ctrl/, 'keys']],
  'app/later.tsx': [[/https/, 'the address of a script']],
  'edit/tools/importing/file-import.ts': [
    [/scenario_|log_map_|xml|json|gpkg/, 'names of files that data sets and tools use'],
  ],
  'edit/tools/importing/map-outline.ts': [[/node|geometry|lane/, 'elements of map files']],
  'edit/tools/layouts/arms-overlay.ts': [[/arm/, 'ids of lanes']],
  'edit/tools/outward/table-columns.ts': [
    [/id\||time|x\||y\||yaw|speed|type|len|width|frame/, 'column names of tables'],
  ],
  'model/document/layouts.ts': [[/arm/, 'ids of lanes']],
  'net/client.ts': [[/gzip|sha256|json|filename/, 'headers of HTTP and names of files']],
  'net/imports.ts': [[/json/, 'the ending of a file']],
  'net/root.ts': [[/assets/, 'a path of the page']],
};

describe('sentences of the server', () => {
  it('are never matched by their words', () => {
    const files = readdirSync('src', { recursive: true, encoding: 'utf8' }).filter((name) => /\.tsx?$/.test(name));
    const patterns = files.flatMap((name) => {
      const found: { name: string; text: string }[] = [];
      const visit = (node: ts.Node): void => {
        if (ts.isRegularExpressionLiteral(node)) found.push({ name: name.replaceAll('\\', '/'), text: node.text });
        ts.forEachChild(node, visit);
      };
      visit(ts.createSourceFile(name, readFileSync(`src/${name}`, 'utf8'), ts.ScriptTarget.Latest));
      return found;
    });
    expect(patterns.length).toBeGreaterThan(40);
    // A run of three letters may be a word: any language's, and any sentence's of the server.
    const ofWords = patterns.filter(({ text }) => /\p{L}{3}/u.test(text.replace(/\\[a-z]/gi, '')));
    const unknown = ofWords.filter(({ name, text }) => !PATTERNS[name]?.some(([allowed]) => allowed.test(text)));
    expect(unknown).toEqual([]);
    const unused = Object.entries(PATTERNS).flatMap(([file, list]) =>
      list.filter(([allowed]) => !ofWords.some(({ name, text }) => name === file && allowed.test(text))),
    );
    expect(unused).toEqual([]);
  });

  it.each(Object.keys(LANGUAGES))('all stand in %s, with all of their values', (language) => {
    const sentences = LANGUAGES[language];
    expect(Object.keys(sentences).sort()).toEqual(kinds.map((kind) => kind.code).sort());
    const differing = kinds.filter(({ code, values }) => asked(sentences[code]).join() !== [...values].sort().join());
    expect(differing.map((kind) => kind.code)).toEqual([]);
  });

  it('have all words of their values in German', () => {
    const lists = Object.entries(WORDS).map(([name, list]) => [name, Object.keys(list).sort()]);
    expect(Object.fromEntries(lists)).toEqual(words);
  });

  it.each([
    ['english', []],
    // Codes with the same sentence in singular and plural.
    ['german', ['loss-users-over-room', 'too-many-regenerated']],
  ])('stand in the singular for one thing, in %s', (language, same) => {
    const sentence = (code: string, one: string): string => {
      const counted = code.startsWith('signals-made') ? 'junctions' : code === 'too-many-requests' ? 'most' : 'count';
      return written(
        LANGUAGES[language][code],
        new Proxy({}, { get: (_, name) => (name === counted ? one : `<${String(name)}>`) }),
      );
    };
    const counted = kinds.filter((kind) => kind.one && kind.one !== kind.english).map((kind) => kind.code);
    expect(counted.length).toBeGreaterThan(40);
    const alike = counted.filter((code) => sentence(code, '1') === sentence(code, '2').replace('2', '1'));
    expect(alike.sort()).toEqual(same);
  });

  it('have lengths and speeds in the units of the page', () => {
    const far = { time_s: 4, goal_m: 61, start_mps: 13.9, kind: 'vehicle', most_m: 48.2 };
    const text = () => messageText({ code: 'goal-too-far', values: far });
    expect(text()).toBe(
      'Too far for 4.0 s. The goal is 61 m away. From 50 km/h, this vehicle covers at most 48 m in 4.0 s.',
    );
    toldIn('mph');
    expect(text()).toBe(
      'Too far for 4.0 s. The goal is 200 ft away. From 31 mph, this vehicle covers at most 158 ft in 4.0 s.',
    );
    toldIn('km/h');
    const walking = messageText({ code: 'goal-too-fast', values: { time_s: 2, start_mps: 1.4, kind: 'pedestrian' } });
    expect(walking).toBe('Cannot accelerate that much in 2.0 s from 1.4 m/s.');
  });

  it('give the time from which they hold, and name arms and lists in the words of the page', () => {
    const values = { since_s: 9, kind: 'cyclist' };
    expect(messageText({ code: 'goal-turn-too-tight', values })).toBe(
      'From 9.0 s on: The turn is too tight for this cyclist.',
    );
    const arms = { first: 'North', second: 'North-west 2' };
    const titled = withArms(MAPS, [
      { name: 'North', title: 'Nord' },
      { name: 'North-west 2', title: 'Nordwest 2' },
    ]);
    expect(messageText({ code: 'greens-conflict', values: arms }, '', titled)).toBe(
      'Nord and Nordwest 2 conflict and have green at the same time',
    );
    expect(messageText({ code: 'ids-suffixed', values: { count: 3, subject: 'road-users' } }, '', FILES)).toBe(
      '3 repeated ids of road users got a suffix',
    );
  });

  it('have a title where the page shows one above the rest', () => {
    const values = { time_s: 4, goal_m: 61, start_mps: 13.9, kind: 'vehicle', most_m: 48.2 };
    const goal = { pos: null, time: 4 };
    const words = (message: Message) => reachWords({ status: 'unreachable', message } as Reach, goal);
    expect(words({ code: 'goal-too-far', values })).toEqual({
      title: 'Too far for 4.0 s',
      words: 'The goal is 61 m away. From 50 km/h, this vehicle covers at most 48 m in 4.0 s.',
    });
    expect(words({ code: 'goal-too-slow', values: { time_s: 2.5 } })).toEqual({
      title: 'Cannot brake that much in 2.5 s',
      words: 'The nearest reachable point is shown.',
    });
    expect(words({ code: 'start-overlaps', values: { agent: '3' } })).toEqual({
      title: 'Out of reach in 4.0 s',
      words: 'The start overlaps road user 3.',
    });
  });

  it('name arms by their direction, with a number where several share it', () => {
    expect(armTitles([0, 22.5, 90, 130, 140, 180, -90, -22.5])).toEqual([
      'East',
      'North-east',
      'North',
      'North-west 1',
      'North-west 2',
      'West',
      'South',
      'South-east',
    ]);
  });

  it('stay in English where the page does not know the code', () => {
    expect(messageText({ code: 'of-a-newer-server', values: {} }, 'As the server says it.')).toBe(
      'As the server says it.',
    );
  });
});
