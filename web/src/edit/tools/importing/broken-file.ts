// Facts about the text of a refused file: the broken line, its object, and the scene without it.
import { lineOf, linesAround, offsetOf } from './json-place';
import type { SceneJson } from '../../../model/document/scene-json';
import type { Problem } from '../../../net/types';
import { partAt, withoutBroken, type BrokenPart, type Mended } from './mending';

export interface Broken {
  readonly excerpt?: { readonly line: number; readonly from: number; readonly lines: readonly string[] };
  readonly part: BrokenPart | null;
  /** Null where the broken parts cannot be left out. */
  readonly mended: Mended | null;
}

export function lookInto(text: string, p: Problem): Broken {
  const pointer = p.errors?.[0]?.pointer;
  const line = p.line ?? (p.code === 'too-many-agents' ? null : lineAt(text, pointer));
  const scene = sceneIn(text);
  return {
    excerpt: line === null ? undefined : { line, ...linesAround(text, line) },
    part: scene && pointer !== undefined ? partAt(scene, pointer) : null,
    mended: scene && withoutBroken(scene, p),
  };
}

function sceneIn(text: string): SceneJson | null {
  try {
    const read = JSON.parse(text) as SceneJson;
    return Array.isArray(read?.agents) ? read : null;
  } catch {
    return null;
  }
}

function lineAt(text: string, pointer: string | undefined): number | null {
  const at = pointer && text.startsWith('{') ? offsetOf(text, pointer) : null;
  return at === null ? null : lineOf(text, at);
}
