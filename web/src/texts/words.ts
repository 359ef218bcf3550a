// The shape of a table of texts.

/** A text, or how to make it of values; they may lie in groups. */
export type Word = string | ((...values: never[]) => string);
export interface Words {
  readonly [key: string]: Word | Words;
}
