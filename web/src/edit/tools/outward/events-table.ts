// The events of a scene as a table for spreadsheets: one row for each event.
import type { TrafficEvent } from '../../../model/words/event-words';

const COLUMNS = ['time_s', 'until_s', 'kind', 'who', 'whom', 'words', 'x_m', 'y_m', 'in_log'] as const;

/** Comma-separated, in order of time. Kinds are those of `faults` in the API; words are as displayed. */
export function eventsTable(events: readonly TrafficEvent[]): string {
  const rows = [...events]
    .sort((p, q) => p.time - q.time)
    .map((e) => [
      e.time.toFixed(2),
      e.until.toFixed(2),
      e.what,
      text(e.a.name),
      text(e.b?.name ?? ''),
      text(e.words),
      e.at[0].toFixed(2),
      e.at[1].toFixed(2),
      String(e.inLog),
    ]);
  return [COLUMNS, ...rows].map((cells) => cells.join(',')).join('\r\n') + '\r\n';
}

/** A name that looks like a formula stays text. */
function text(value: string): string {
  const plain = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}
