// What a refusal says to people.
import { change } from '../texts/language';
import { faultOf } from './problem';
import type { Problem } from './types';

/** The server's sentence in English; in another language what its code stands for. */
export const inWords = (p: Problem, sentence = faultOf(p)): string => change?.refused(p.code) ?? sentence;
