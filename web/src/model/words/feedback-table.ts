// Feedback on futures as a table: one row for each answer, one column for each feature.
import type { NameOf } from '../document/scene';
import type { CardVerdict, Feedback } from '../document/feedback';
import { whyWords } from './feedback-words';
import { TEXTS } from '../../texts/scene/feedback';

/** A spreadsheet would read a text with such a start as a formula. */
const FORMULA = /^[=+\-@\t\r]/;

function cell(v: string | number | boolean | null | undefined): string {
  if (typeof v !== 'string') return v == null ? '' : String(v);
  const text = FORMULA.test(v) ? `'${v}` : v;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Comma-separated values; speeds in m/s, the rest in the unit at the end of the heading. */
export function feedbackTable(id: string | null, f: Feedback, nameOf: NameOf): string {
  const rowOf = (a: CardVerdict) => (id === null ? undefined : a.features.first?.[id]);
  const met = [...new Set(f.answers.flatMap((a) => Object.keys(rowOf(a) ?? {})))];
  const columns: readonly (readonly [string, (a: CardVerdict) => string | number | boolean | null | undefined])[] = [
    ['round', (a) => a.round],
    ['letter', (a) => a.letter],
    ['name', (a) => a.name],
    ['verdict', (a) => a.verdict],
    ['why', (a) => whyWords(id, a, nameOf)],
    ['pace_mps', (a) => a.features.pace_mps],
    ['gap_s', (a) => a.features.gap_s],
    ['harshness_mps2', (a) => a.features.harshness_mps2],
    ['standing_s', (a) => a.features.standing_s],
    ['from_log_m', (a) => a.features.from_log_m],
    ['manoeuvre', (a) => (id === null ? undefined : a.features.manoeuvres?.[id])],
    ...met.map((other) => [TEXTS.before(nameOf(other) ?? other), (a: CardVerdict) => rowOf(a)?.[other]] as const),
  ];
  const lines = [columns.map(([title]) => cell(title)), ...f.answers.map((a) => columns.map(([, of]) => cell(of(a))))];
  return `${lines.map((l) => l.join(',')).join('\r\n')}\r\n`;
}
