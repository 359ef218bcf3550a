// All displayed texts are in tables, one for each part of the page, so that a script loads only its own texts. A text
// with values is a function of them. Another language is a table of the same shape (`german`).
import { change } from './language';
import type { Words } from './words';
import { ENGLISH, FINGERS, tapping } from './tapping';

export { plural } from './language';

/** The same shape with any texts in it. */
export type Said<T> = {
  readonly [K in keyof T]: T[K] extends string ? string : T[K] extends (...v: never[]) => string ? T[K] : Said<T[K]>;
};

/** A sentence of the server, or one with a title that also stands alone; the rest may be empty. */
export type Sentence =
  | string
  | ((values: Values) => string)
  | { readonly title: (values: Values) => string; readonly rest: string | ((values: Values) => string) };

/** Values of a server sentence by name, as text in the units of the page; an absent one is empty. */
export type Values = Readonly<Record<string, string>>;

/** The texts of an area in this language. */
export function table<const T extends Words>(area: string, english: T): Said<T> {
  const said = change ? change.area(area, english) : english;
  return (FINGERS ? tapping(said, change ? change.taps : ENGLISH) : said) as Said<T>;
}
