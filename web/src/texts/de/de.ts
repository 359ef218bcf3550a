// German: what a person meets first.
import type { Language } from '../language';

export const de: Language = {};
