// Keys in one spelling: `Ctrl+Shift+Z`. Shifted signs are read as Shift plus the plain sign, so that a table of
// shortcuts can be shown as it is typed.

import { KEYS } from '../texts/desk/keys';

const SHIFTED: Record<string, string> = { '{': '[', '}': ']', ':': ';', '"': "'", '<': ',', '>': '.', _: '-' };
const NAMES: Record<string, string> = {
  ' ': 'Space',
  Escape: 'Esc',
  Delete: 'Del',
  ContextMenu: 'Menu',
  ArrowUp: 'Up',
  ArrowDown: 'Down',
  ArrowLeft: 'Left',
  ArrowRight: 'Right',
  '−': '-',
};

export interface KeyLike {
  key: string;
  code?: string;
  ctrlKey: boolean;
  metaKey: boolean;
  altKey: boolean;
  shiftKey: boolean;
}

export function keyOf(e: KeyLike): string {
  let key = NAMES[e.key] ?? e.key;
  let shift = e.shiftKey;
  if (SHIFTED[key]) {
    key = SHIFTED[key];
    shift = true;
  } else if (key === '=') key = '+';
  else if (key === '+') shift = shift && e.code === 'Equal';
  else if (key === '?') shift = false;
  else if (/^[a-z]$/i.test(key)) key = key.toUpperCase();
  // Alt and Shift change what a key types on some keyboards; its place does not change.
  const digit = (e.altKey || e.shiftKey) && /^Digit(\d)$/.exec(e.code ?? '');
  if (digit) key = digit[1];
  const letter = e.altKey && /^Key([A-Z])$/.exec(e.code ?? '');
  if (letter) key = letter[1];
  return [e.ctrlKey || e.metaKey ? 'Ctrl' : '', e.altKey ? 'Alt' : '', shift ? 'Shift' : '', key]
    .filter(Boolean)
    .join('+');
}

const SHOWN: Readonly<Record<string, string>> = {
  Up: '↑',
  Down: '↓',
  Left: '←',
  Right: '→',
  Enter: '↵',
  '-': '−',
  ...KEYS,
};

/** The caps to draw for a key. */
export function caps(key: string): string[] {
  const parts = key.endsWith('++') ? [...key.slice(0, -2).split('+'), '+'] : key === '+' ? ['+'] : key.split('+');
  return parts.filter(Boolean).map((p) => SHOWN[p] ?? p);
}
