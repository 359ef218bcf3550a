// Finds a value in JSON text by its pointer (RFC 6901): errors name pointers, editors show lines.

/** Offset of the value's start; null where the text has none there. */
export function offsetOf(text: string, pointer: string): number | null {
  const wanted = pointer
    .split('/')
    .slice(1)
    .map((p) => p.replaceAll('~1', '/').replaceAll('~0', '~'));
  let at = space(text, 0);
  for (const step of wanted) {
    const inside =
      text[at] === '{' ? member(text, at, step) : text[at] === '[' ? element(text, at, Number(step)) : null;
    if (inside === null) return null;
    at = inside;
  }
  return at < text.length ? at : null;
}

/** Lines count from 1. */
export function lineOf(text: string, offset: number): number {
  let line = 1;
  for (let i = text.indexOf('\n'); i >= 0 && i < offset; i = text.indexOf('\n', i + 1)) line++;
  return line;
}

/** Lines around one, the longest shortened. */
export function linesAround(text: string, line: number, around = 2, longest = 120): { from: number; lines: string[] } {
  const from = Math.max(1, line - around);
  const all = text.split('\n', line + around).slice(from - 1);
  return { from, lines: all.map((l) => (l.length > longest ? `${l.slice(0, longest)} …` : l)) };
}

function space(text: string, at: number): number {
  while (at < text.length && ' \t\r\n'.includes(text[at])) at++;
  return at;
}

function stringEnd(text: string, at: number): number {
  for (at++; at < text.length && text[at] !== '"'; at++) if (text[at] === '\\') at++;
  return at + 1;
}

/** Offset after the value that begins here. */
function skip(text: string, at: number): number {
  let depth = 0;
  for (; at < text.length; at++) {
    const c = text[at];
    if (c === '"') at = stringEnd(text, at) - 1;
    else if (c === '{' || c === '[') depth++;
    else if (c === '}' || c === ']') depth--;
    else if (c === ',' && depth === 0) return at;
    if (depth < 0) return at;
    if (depth === 0 && (c === '}' || c === ']' || c === '"')) return at + 1;
  }
  return at;
}

function member(text: string, at: number, name: string): number | null {
  at = space(text, at + 1);
  while (text[at] === '"') {
    const end = stringEnd(text, at);
    const key = text.slice(at + 1, end - 1);
    const colon = space(text, end);
    const value = space(text, colon + 1);
    if (text[colon] !== ':') return null;
    if (key === name) return value;
    at = space(text, skip(text, value));
    if (text[at] !== ',') return null;
    at = space(text, at + 1);
  }
  return null;
}

function element(text: string, at: number, index: number): number | null {
  at = space(text, at + 1);
  for (let i = 0; text[at] !== ']' && at < text.length; i++) {
    if (i === index) return at;
    at = space(text, skip(text, at));
    if (text[at] !== ',') return null;
    at = space(text, at + 1);
  }
  return null;
}
