// Times and order of the places on the way, for fields and sliders.
import { setVias, type Command } from '../model/document/commands';
import type { Agent } from '../model/document/scene';
import { nearestOn, passed, timesOf } from '../model/document/vias';
import type { Editor } from './editor';
import { changeVia } from './vias';
import { TEXTS } from '../texts/editing/via';

/** When the future in force passes it, seconds; null where nothing is known. */
export function viaTime(e: Editor, a: Agent, i: number): number | null {
  const f = e.futures.value;
  const m = f?.modes[e.chosen.value]?.motion;
  const at = m && passed(a.goal.via, m)[i];
  return at ? Math.round(at.time * 10) / 10 : null;
}

/** A time that it may have, to the tenth of a second; null where none is left between its neighbours. */
export function heldTime(a: Agent, i: number, time: number, latest: number): number | null {
  const due = a.goal.pos ? a.goal.time : latest + 0.1;
  const [from, to] = timesOf(a.goal.via, i, due);
  return from > to + 1e-6 ? null : Math.round(Math.min(to, Math.max(from, time)) * 10) / 10;
}

/** Fixes the time at what is shown, or frees it. */
export function toggleViaTime(e: Editor, a: Agent, i: number): Command | null {
  const v = a.goal.via[i];
  if (!v) return null;
  if (v.time !== null) return changeVia(a, i, { time: null });
  const shown = viaTime(e, a, i);
  const time = shown === null ? null : heldTime(a, i, shown, e.scene.peek()?.length ?? shown);
  return time === null ? null : changeVia(a, i, { time });
}

/** Two neighbours that the future in force would pass the other way round: the first of them. */
export function outOfOrder(e: Editor, a: Agent): number | null {
  const m = e.futures.value?.modes[e.chosen.value]?.motion;
  const all = a.goal.via;
  if (!m || all.length < 2) return null;
  if (passed(all, m).every((p) => p.ok)) return null;
  const times = all.map((v) => nearestOn(m, v.pos).time);
  const i = times.findIndex((t, k) => k + 1 < times.length && t > times[k + 1] + 0.05);
  return i < 0 ? null : i;
}

/** The neighbours change places in the order; times stay in order. */
export function swapVias(a: Agent, i: number): Command {
  const all = [...a.goal.via];
  const [p, q] = [all[i], all[i + 1]];
  all[i] = Object.freeze({ ...q, time: p.time });
  all[i + 1] = Object.freeze({ ...p, time: q.time });
  return setVias(a, all, TEXTS.swapped(a.name));
}
