// A message of the server as data: `model/words/message-text.ts` writes it out.
import type { Schemas } from '../base/schemas';

export type Message = Schemas['Message'];
