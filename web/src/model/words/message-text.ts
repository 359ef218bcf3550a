// Sentences of the server in the language and units of the page. They come as codes with values.
import { acceleration, metres, num, seconds, speedInUse } from '../base/units';
import type { Message } from '../document/message';
import { armTitle } from './arm-names';
import { SENTENCES } from '../../texts/messages/messages';
import type { Values } from '../../texts/table';

/** Sentences by code, and the words of values that name a thing of a list. */
export interface Sentences {
  readonly sentences: Readonly<Record<string, string | ((values: Values) => string)>>;
  readonly lists: Readonly<Record<string, Readonly<Record<string, string>>>>;
}

/** Values that name an arm of a junction. */
const ARMS: ReadonlySet<string> = new Set(['from', 'to', 'first', 'second']);

/** A value as text: its unit is the suffix of its name. */
function valueText(name: string, value: string | number, onFoot: boolean, { lists }: Sentences): string {
  if (typeof value === 'string') return lists[name]?.[value] ?? (ARMS.has(name) ? armTitle(value) : value);
  if (name.endsWith('_mps2')) return acceleration(value);
  if (name.endsWith('_mps')) return speedInUse(value, onFoot);
  if (name.endsWith('_m')) return metres(value);
  if (name.endsWith('_s')) return seconds(value);
  return num(value, 0);
}

/** A sentence of a table, or what the server calls it in English where the table does not have its code. */
export function messageText({ code, values }: Message, english = code, table: Sentences = SENTENCES): string {
  const sentence = table.sentences[code];
  if (sentence === undefined) return english;
  const onFoot = values.kind === 'pedestrian';
  const text = (name: string): string => (name in values ? valueText(name, values[name], onFoot, table) : '');
  const written =
    typeof sentence === 'string' ? sentence : sentence(new Proxy<Values>({}, { get: (_, name) => text(String(name)) }));
  const { since_s: since } = values;
  return typeof since === 'number' ? SENTENCES.since(seconds(since), written) : written;
}
