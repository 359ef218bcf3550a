// Messages of the server in the language and units of the page. They arrive as codes with values.
import { acceleration, metres, num, seconds, speedInUse } from '../base/units';
import type { Message } from '../document/message';
import { SENTENCES } from '../../texts/messages/messages';
import type { Sentence, Values } from '../../texts/table';

/** Sentences by code, and the words of enumerated values. */
export interface Sentences {
  readonly sentences: Readonly<Record<string, Sentence>>;
  readonly lists: Readonly<Record<string, Readonly<Record<string, string>>>>;
}

/** The same sentences for a map with these arms: its checks name an arm by the server's name. */
export function withArms(
  table: Sentences,
  arms: readonly { readonly name: string; readonly title: string }[],
): Sentences {
  const titles = Object.fromEntries(arms.map(({ name, title }) => [name, title]));
  return { ...table, lists: { ...table.lists, from: titles, to: titles, first: titles, second: titles } };
}

/** A value as text: its unit is the suffix of its name. */
function valueText(name: string, value: string | number, onFoot: boolean, { lists }: Sentences): string {
  if (typeof value === 'string') return lists[name]?.[value] ?? value;
  if (name.endsWith('_mps2')) return acceleration(value);
  if (name.endsWith('_mps')) return speedInUse(value, onFoot);
  if (name.endsWith('_m')) return metres(value);
  if (name.endsWith('_s')) return seconds(value);
  return num(value, 0);
}

type Written = string | ((values: Values) => string);

/** Writes out texts of a message's values. */
function writer({ values }: Message, table: Sentences): (text: Written) => string {
  const onFoot = values.kind === 'pedestrian';
  const text = (name: string): string => (name in values ? valueText(name, values[name], onFoot, table) : '');
  const all = new Proxy<Values>({}, { get: (_, name) => text(String(name)) });
  return (written) => (typeof written === 'string' ? written : written(all));
}

/** A sentence with the line of the file, or the time from which it holds, before it. */
function since({ values }: Message, sentence: string): string {
  const { since_s: from, line } = values;
  if (typeof line === 'number') return SENTENCES.inLine(num(line, 0), sentence);
  return typeof from === 'number' ? SENTENCES.since(seconds(from), sentence) : sentence;
}

/** The sentence of a table, or the server's English text where the table lacks its code. */
export function messageText(message: Message, english = message.code, table: Sentences = SENTENCES): string {
  const sentence = table.sentences[message.code];
  if (sentence === undefined) return english;
  const write = writer(message, table);
  if (typeof sentence !== 'object') return since(message, write(sentence));
  const rest = write(sentence.rest);
  return since(message, `${write(sentence.title)}.${rest && ` ${rest}`}`);
}

/** The title of a message and the rest, which may be empty; null where it has no title. */
export function messageParts(message: Message): { readonly title: string; readonly rest: string } | null {
  const sentence = (SENTENCES as Sentences).sentences[message.code];
  if (typeof sentence !== 'object') return null;
  const write = writer(message, SENTENCES);
  return { title: since(message, write(sentence.title)), rest: write(sentence.rest) };
}
