// The shape of a table of texts.

/** A text, or a function that makes it from values; texts may be grouped. */
export type Word = string | ((...values: never[]) => string);
export interface Words {
  readonly [key: string]: Word | Words;
}
