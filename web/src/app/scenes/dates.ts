// When something was done, as people say it.

import { LOCALE } from '../../texts/language';
import { TEXTS } from '../../texts/desk/scenes';

const time = new Intl.DateTimeFormat(LOCALE, { hour: '2-digit', minute: '2-digit' });
const day = new Intl.DateTimeFormat(LOCALE, { day: 'numeric', month: 'short' });
const dayAndYear = new Intl.DateTimeFormat(LOCALE, { day: 'numeric', month: 'short', year: 'numeric' });

export const clock = (at: number | Date): string => time.format(at);

const DAY_MS = 86_400_000;
const midnight = (d: Date): number => new Date(d.getFullYear(), d.getMonth(), d.getDate()).getTime();

/** `today 10:42`, `yesterday 18:03`, `3 Nov 09:15`, `3 Nov 2025`. */
export function dayAndTime(at: number | string, now = new Date()): string {
  const d = new Date(at);
  if (Number.isNaN(d.getTime())) return '';
  const days = Math.round((midnight(now) - midnight(d)) / DAY_MS);
  if (days === 0) return TEXTS.today(clock(d));
  if (days === 1) return TEXTS.yesterday(clock(d));
  return d.getFullYear() === now.getFullYear() ? `${day.format(d)} ${clock(d)}` : dayAndYear.format(d);
}
