// What a refusal says to people.
import type { Message } from '../model/document/message';
import { messageText } from '../model/words/message-text';
import { change } from '../texts/language';
import { SENTENCES } from '../texts/messages/problem-messages';
import { faultOf } from './problem';
import type { Problem } from './types';

/** A refusal in the language of the page: its sentence where it comes as data, else the meaning of its code. */
export function inWords(p: Problem, sentence = faultOf(p)): string {
  const general = change?.refused(p.code) ?? sentence;
  return p.message ? messageText(p.message as Message, general, SENTENCES) : general;
}
