// Sentences of the server in the language and units of the page. They come as codes with values.
import { acceleration, metres, num, seconds, speedInUse } from '../base/units';
import type { Message } from '../document/message';
import { armTitle } from './arm-names';
import { TEXTS, type Values } from '../../texts/messages';

type Code = keyof typeof TEXTS.sentences;
type Sentence = string | ((values: Values) => string);

/** Values that name a thing of a fixed list: the words for it. */
const LISTS: Readonly<Record<string, Readonly<Record<string, string>>>> = {
  kind: TEXTS.kinds,
  subject: TEXTS.subjects,
  vehicle: TEXTS.vehicles,
};
/** Values that name an arm of a junction. */
const ARMS: ReadonlySet<string> = new Set(['from', 'to', 'first', 'second']);

/** A value as text: its unit is the suffix of its name. */
function valueText(name: string, value: string | number, onFoot: boolean): string {
  if (typeof value === 'string') return LISTS[name]?.[value] ?? (ARMS.has(name) ? armTitle(value) : value);
  if (name.endsWith('_mps2')) return acceleration(value);
  if (name.endsWith('_mps')) return speedInUse(value, onFoot);
  if (name.endsWith('_m')) return metres(value);
  if (name.endsWith('_s')) return seconds(value);
  return num(value, 0);
}

/** The sentence, or what the server calls it in English where this page does not know the code. */
export function messageText({ code, values }: Message, english = code): string {
  if (!(code in TEXTS.sentences)) return english;
  const sentence: Sentence = TEXTS.sentences[code as Code];
  const { since_s: since } = values;
  const onFoot = values.kind === 'pedestrian';
  const texts = new Proxy<Values>(
    {},
    { get: (_, name) => (String(name) in values ? valueText(String(name), values[String(name)], onFoot) : '') },
  );
  const text = typeof sentence === 'string' ? sentence : sentence(texts);
  return typeof since === 'number' ? TEXTS.since(seconds(since), text) : text;
}
