// A message of the server as data: `model/words/message-text.ts` writes it out.
import type { components } from '../base/api';

export type Message = components['schemas']['Message'];
