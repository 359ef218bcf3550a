// Reasons of refused files in words. Loads at the first refusal, since it includes the sentences of all readers.
import type { Message } from '../../../model/document/message';
import { messageText } from '../../../model/words/message-text';
import { inWords } from '../../../net/refusal';
import type { Problem } from '../../../net/types';
import { TEXTS } from '../../../texts/files/importing';
import { SENTENCES } from '../../../texts/messages/file-messages';
import { SENTENCES as REFUSALS } from '../../../texts/messages/refusal-messages';
import type { FileVerdict } from './file-verdict';

/** The fault of a file: its sentence where it comes as data. */
export function faultIn(file: string, p: Problem): string {
  const message = p.message as Message | undefined;
  if (message?.code === 'not-a-known-format') return TEXTS.isNotAScene(file);
  if (!message) return inWords(p);
  return messageText(message, inWords(p), message.code in REFUSALS.sentences ? REFUSALS : SENTENCES);
}

/** The fault of a file, its place and the remedy; without a problem the file has no scene. */
export function explain(
  file: string,
  p: Problem | undefined,
): Pick<FileVerdict, 'wrong' | 'where' | 'todo' | 'details'> {
  if (!p) return { wrong: TEXTS.thereIsNoScene, todo: TEXTS.scenarioRecords };
  const first = p.errors?.[0];
  const where = [file, first?.pointer, p.offset !== undefined ? TEXTS.byte(p.offset) : ''].filter(Boolean).join(', ');
  return { wrong: faultIn(file, p), where, todo: whatToDo(p.code), details: JSON.stringify(p, null, 2) };
}

function whatToDo(code: Problem['code']): string {
  if (code === 'format-unknown') return TEXTS.chooseAnotherFile(TEXTS.scenarioRecords);
  if (code.includes('too-large')) return TEXTS.fileTooLarge;
  if (code === 'unsupported-version') return TEXTS.updateThisProgram;
  return TEXTS.fixTheFile;
}

/** Columns of a table with unknown column names; null for another fault. */
export function columnsIn(p: Problem): readonly string[] | null {
  const message = p.message as Message | undefined;
  if (message?.code !== 'columns-missing') return null;
  // The server shortens a long list.
  return String(message.values.columns)
    .split(', ')
    .filter((name) => name !== '...');
}
