// Every button has an action, no key is used twice, no text is missing, and layers import only downwards.
import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { ACTIONS, actionForKey } from '../../src/actions/registry';
import { HELPS } from '../../src/texts/desk/helps';
import { TEXTS as PALETTE } from '../../src/texts/desk/palette';
import { german as GERMAN } from '../../src/texts/german/desk/palette';
import type { Action } from '../../src/actions/action';
import { caps, keyOf } from '../../src/actions/keys';

const src = new URL('../../src/', import.meta.url);
const files = (dir: string) =>
  readdirSync(new URL(`${dir}/`, src), { recursive: true, encoding: 'utf8' })
    .filter((f) => /\.tsx?$/.test(f))
    .map((f) => ({ name: `${dir}/${f}`, text: readFileSync(new URL(`${dir}/${f}`, src), 'utf8') }));
const app = files('app');

describe('action registry', () => {
  it('has unique ids, and texts for everything', () => {
    expect(new Set(ACTIONS.map((a) => a.id)).size).toBe(ACTIONS.length);
    for (const a of ACTIONS) {
      expect(a.label.trim(), a.id).not.toBe('');
      expect(HELPS[a.help].trim(), a.id).not.toBe('');
      expect(a.label, a.id).not.toMatch(/!|\b(agent|sample|rollout|ground truth|denoising)\b/i);
    }
  });

  it('is found by synonyms too, each for an existing action', () => {
    const ids = new Set(ACTIONS.map((a) => a.id));
    for (const texts of [PALETTE.alsoCalled, GERMAN.alsoCalled])
      expect(Object.keys(texts).filter((id) => !ids.has(id))).toEqual([]);
    expect(Object.keys(GERMAN.alsoCalled)).toEqual(Object.keys(PALETTE.alsoCalled));
  });

  it('uses no key twice', () => {
    const keys = (which: (a: Action) => boolean) => ACTIONS.filter(which).flatMap((a) => [...(a.keys ?? [])]);
    for (const dragging of [false, true]) {
      const all = keys((a) => !a.onOffer && !!a.whileDragging === dragging);
      expect(all.filter((k, i) => all.indexOf(k) !== i)).toEqual([]);
      for (const k of all) {
        expect(actionForKey(k, { dragging })?.keys).toContain(k);
        expect(!!actionForKey(k, { dragging })?.whileDragging).toBe(dragging);
      }
    }
    // Actions offered only at times may share a key: the first offered one gets it.
    const offered = keys((a) => !!a.onOffer);
    for (const k of offered) expect(actionForKey(k, { offers: () => true })?.keys).toContain(k);
  });

  it('gives a key to an offered action, and otherwise to its usual one', () => {
    const way = (id: string) => ({ offers: (a: Action) => a.id === id });
    expect(actionForKey('Enter', way('by-road'))?.id).toBe('by-road');
    expect(actionForKey('Enter', { ...way('by-road'), dragging: true })?.id).toBe('by-road');
    expect(actionForKey('Enter', way('may-cross'))?.id).toBe('inspect');
    expect(actionForKey('Enter')?.id).toBe('inspect');
    expect(actionForKey('Alt+Enter')).toBeUndefined();
  });

  it('knows every action that a button names', () => {
    const ids = new Set(ACTIONS.map((a) => a.id));
    const named =
      /<(?:Action|Icon)Button[^>]*?\bid="([\w-]+)"|(?:perform|actionOf)\(c?,? ?'([\w-]+)'|data-action="([\w-]+)"/g;
    const all = app.flatMap((f) => [...f.text.matchAll(named)].map((m) => m[1] ?? m[2] ?? m[3]));
    expect(all).toEqual(expect.arrayContaining(['undo', 'generate', 'choose-files', 'play']));
    for (const id of all) expect(ids).toContain(id);
  });

  it('has an icon for every name used', () => {
    const paths = readFileSync(new URL('app/parts/icons.tsx', src), 'utf8');
    const known = new Set([...paths.matchAll(/(?:^|[\s,{])'?([\w-]+)'?:\s*'[Mm]/g)].map((m) => m[1]));
    for (const a of ACTIONS) if (a.icon) expect(known, a.id).toContain(a.icon);
    const named = /<Icon name="(\w+)"|\bicon(?:="|: ')(\w+)/g;
    for (const f of app) for (const m of f.text.matchAll(named)) expect(known, f.name).toContain(m[1] ?? m[2]);
  });

  it('draws no text as markup and no style as an attribute', () => {
    for (const f of ['app', 'actions', 'edit', 'draw'].flatMap(files)) {
      expect(f.text, f.name).not.toMatch(/innerHTML|InnerHTML|outerHTML|insertAdjacentHTML|document\.write/);
      expect(f.text, f.name).not.toMatch(/\bstyle="|setAttribute\('style'/);
    }
    expect(readFileSync(new URL('../index.html', src), 'utf8')).not.toMatch(/style=|<style|<script(?![^>]*src)/);
  });
});

describe('keys', () => {
  const press = (
    key: string,
    mods: Partial<Record<'ctrlKey' | 'metaKey' | 'altKey' | 'shiftKey', boolean>> = {},
    code = '',
  ) => keyOf({ key, code, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...mods });
  it('have one spelling', () => {
    expect(press('z', { ctrlKey: true })).toBe('Ctrl+Z');
    expect(press('Z', { metaKey: true, shiftKey: true })).toBe('Ctrl+Shift+Z');
    expect(press('{', { shiftKey: true })).toBe('Shift+[');
    expect(press('?', { shiftKey: true })).toBe('?');
    expect(press('=')).toBe('+');
    expect(press('+', { shiftKey: true }, 'Equal')).toBe('Shift++');
    expect(press('+', {}, 'NumpadAdd')).toBe('+');
    expect(press('¡', { altKey: true }, 'Digit1')).toBe('Alt+1');
    expect(press(' ')).toBe('Space');
    expect(caps('Shift++')).toEqual(['Shift', '+']);
    expect(caps('Ctrl+Up')).toEqual(['Ctrl', '↑']);
  });
});
