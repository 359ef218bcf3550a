// All that a person reads stands in tables, one a part of the page, so that a script brings its own words alone. A text
// with values in it is a function of them. Another language is a table of the same shape (`german`).
import { change } from './language';
import type { Words } from './words';
import { ENGLISH, FINGERS, tapping } from './tapping';

export { plural } from './language';

/** The same shape with any words in it. */
export type Said<T> = {
  readonly [K in keyof T]: T[K] extends string ? string : T[K] extends (...v: never[]) => string ? T[K] : Said<T[K]>;
};

/** Values of a sentence of the server, by name, as text in the units of the page; one that is absent is empty. */
export type Values = Readonly<Record<string, string>>;

/** The words of an area, as this language says them. */
export function table<const T extends Words>(area: string, english: T): Said<T> {
  const said = change ? change.area(area, english) : english;
  return (FINGERS ? tapping(said, change ? change.taps : ENGLISH) : said) as Said<T>;
}
