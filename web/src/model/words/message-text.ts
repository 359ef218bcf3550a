// Messages of the server in the language and units of the page. They arrive as codes with values.
import { acceleration, metres, num, seconds, speedInUse } from '../base/units';
import type { Message } from '../document/message';
import { armTitle } from './arm-names';
import { SENTENCES } from '../../texts/messages/messages';
import type { Values } from '../../texts/table';

/** Sentences by code, and the words of enumerated values. */
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

/** The sentence of a table, or the server's English text where the table lacks its code. */
export function messageText({ code, values }: Message, english = code, table: Sentences = SENTENCES): string {
  const sentence = table.sentences[code];
  if (sentence === undefined) return english;
  const onFoot = values.kind === 'pedestrian';
  const text = (name: string): string => (name in values ? valueText(name, values[name], onFoot, table) : '');
  const written =
    typeof sentence === 'string' ? sentence : sentence(new Proxy<Values>({}, { get: (_, name) => text(String(name)) }));
  const { since_s: since, line } = values;
  if (typeof line === 'number') return SENTENCES.inLine(num(line, 0), written);
  return typeof since === 'number' ? SENTENCES.since(seconds(since), written) : written;
}
