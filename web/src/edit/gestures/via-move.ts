// The command for a via point, or its ring, dragged to a place.
import type { Point, Vec } from '../../model/base/geometry';
import type { Command } from '../../model/document/commands';
import type { Agent } from '../../model/document/scene';
import type { View } from '../../draw/view';
import type { Editor } from '../session/editor';
import type { Grip } from '../session/drag';
import { laneNameAt, snapToLane } from '../moves/snap';
import { moveVia, widenVia } from '../moves/vias';
import { inHalves } from '../../model/base/units';
import type { Modifiers, Press } from './chart';
import type { Move } from './dragging-handle';

export class ViaMove implements Move {
  /** Kerbs hold back only goals: a via point may lead over one. */
  readonly held = false;
  readonly #grab: Vec;
  readonly #from: Vec;

  constructor(
    private readonly editor: Editor,
    private readonly view: View,
    readonly grip: Grip,
    readonly agent: Agent,
    press: Press,
  ) {
    this.#grab = view.from(press.x, press.y);
    this.#from = agent.goal.via[this.#index].pos;
  }

  get #index(): number {
    return this.grip.index ?? 0;
  }

  passKerbs(): void {}

  to(at: Point, mods: Modifiers): Command {
    const [x, y] = this.view.from(at.x, at.y);
    if (this.grip.handle === 'ring') {
      const away = ([px, py]: Vec): number => Math.hypot(px - this.#from[0], py - this.#from[1]);
      const metres = this.agent.goal.via[this.#index].tolerance + away([x, y]) - away(this.#grab);
      // Rounded to 5 cm; with Shift to half a metre or a whole foot.
      const held = Math.round(metres * 20) / 20;
      return widenVia(this.agent, this.#index, mods.shift ? inHalves(metres) : held)!;
    }
    const wanted: Vec = [this.#from[0] + x - this.#grab[0], this.#from[1] + y - this.#grab[1]];
    return moveVia(this.agent, this.#index, this.#snapped(wanted, mods))!;
  }

  #snapped([x, y]: Vec, mods: Modifiers): Vec {
    const { editor, agent } = this;
    const map = editor.scene.peek()!.map;
    const s = mods.alt ? null : snapToLane(map, agent, x, y, null, this.view.z, null);
    const [px, py] = s ? [s.x, s.y] : [x, y];
    const lane = s?.lane ?? null;
    const name = laneNameAt(map, agent, px, py, s?.laneHeading ?? null);
    editor.drag.over({ laneId: lane?.id ?? null, lane: name, stop: null, lag: null });
    const round = (v: number): number => Math.round(v * 100) / 100;
    return [round(px), round(py)];
  }
}
