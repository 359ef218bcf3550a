// The tools of the rail, in its order. A new one is a file of its own and a line in this list: its button, key,
// palette entry and line in the shortcut sheet are made from it.
import type { Chart, State } from './chart';
import type { Press } from './pressed';
import type { Help } from '../../texts/desk/helps';
import type { PlacedKind } from '../../model/base/kinds';
import { FILL } from './filling';
import { LASSO } from './lasso';
import { MEASURE } from './measuring';
import { PAN } from './panning';
import { PLACE } from './placing';
import { SELECT } from './select';

export interface Tool {
  readonly name: string;
  readonly label: string;
  readonly key: string;
  readonly icon: string;
  readonly help: Help;
  /** The pointer over the picture where nothing is under it; empty for the plain one. */
  readonly cursor: string;
  /** Does a press take hold of what lies under it? */
  readonly picks: boolean;
  /** What is placed by it; the rail keeps these together. */
  readonly places?: PlacedKind;
  /** The pointer moves over the picture with nothing pressed. */
  hover?(chart: Chart): void;
  /** What a press becomes once it moves. */
  drag(chart: Chart, press: Press): State;
  /** A press that did not move. */
  click(chart: Chart, press: Press, timeStamp: number): void;
}

export const TOOLS = [SELECT, LASSO, PAN, MEASURE, ...PLACE, FILL] as const satisfies readonly Tool[];

export type ToolName = (typeof TOOLS)[number]['name'];

export const toolOf = (name: ToolName): Tool => TOOLS.find((t) => t.name === name)!;
