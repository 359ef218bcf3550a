// What a refusal says to people.
import { change } from '../texts/language';
import { faultOf } from './problem';
import type { Problem } from './types';

/** A sentence of the server in the language of the page: where it is not known there, what its code stands for. */
export function inWords(p: Problem, sentence = faultOf(p)): string {
  if (!change) return sentence;
  const heard = change.heard(sentence);
  return heard === sentence ? (change.refused(p.code) ?? sentence) : heard;
}
