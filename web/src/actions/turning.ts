// The picture turned: along a road, by steps, and north up again.
import { nearestLanes } from '../model/document/lanemap';
import { rad, type OnLine, type Vec } from '../model/base/geometry';
import { startPose } from '../model/document/scene';
import type { Editor } from '../edit/editor';
import { poseShown } from '../edit/frame';
import { lanesFor } from '../edit/snap';
import { hasScene, type Action } from './action';
import type { Context } from './context';
import { TEXTS } from '../texts/desk/actions';

const STEP_RAD = rad(15);
const QUARTER_RAD = rad(90);
/** Somebody drives on a lane within so many metres. */
const ON_ROAD_M = 4;
/** This near to a panel or to the edge somebody is as good as out of the picture, pixels. */
const EDGE_PX = 40;
/** A road is looked for as far as this from the pointer, metres. */
const NEAR_M = 60;
/** Metres of road shown around the selected road users and their goals. */
export const AROUND_M = 18;

function stepBy(c: Context, angle: number): void {
  c.stage.glide.by((v) => v.turnTo(v.turn + angle));
}

/** Where the selected ones start, and where they go. */
export function placesOfSelected(e: Editor): Vec[] {
  return e.chosenOnes.flatMap((a): Vec[] => {
    const p = startPose(a);
    const goal = p && (e.goalPose(a) ?? p);
    return goal
      ? [
          [p.x, p.y],
          [goal.x, goal.y],
        ]
      : [];
  });
}

/** Where the selected one is, or the first of several, and where its road leads there. */
function wayOfSelected({ editor }: Context): OnLine | null {
  const a = editor.chosenOnes.at(0);
  const p = a && poseShown(editor, a);
  if (!p) return null;
  const fits = lanesFor(a);
  const road = fits && nearestLanes(editor.scene.peek()!.map, p.x, p.y, p.heading, ON_ROAD_M, fits).at(0);
  return { x: p.x, y: p.y, heading: road?.heading ?? p.heading };
}

/** The road under the pointer, else the one nearest to the middle of the picture. */
function roadInView({ editor, gestures, stage: { view: v } }: Context): OnLine | null {
  const map = (editor.layouts.made.peek()?.scene ?? editor.scene.peek())?.map;
  const { left, right, top, bottom } = v.inset;
  const at = gestures.pointer ?? { x: (v.w + left - right) / 2, y: (v.h + top - bottom) / 2 };
  return map ? (nearestLanes(map, ...v.from(at.x, at.y), null, NEAR_M, (l) => l.kind !== 'walk').at(0) ?? null) : null;
}

/**
 * Whoever is selected drives up the picture. With nobody selected a road has no direction: it lies level or upright,
 * whichever is the smaller turn.
 */
function alignWithRoad(c: Context): void {
  const { editor, stage } = c;
  // While a map is made nobody is on it.
  const mine = editor.layouts.isOpen.peek() ? null : wayOfSelected(c);
  const way = mine ?? roadInView(c);
  if (!way) {
    editor.notices.show({ text: TEXTS.noRoadIsNear });
    return;
  }
  const places = placesOfSelected(editor);
  stage.glide.by((v) => {
    const now = way.heading + v.turn;
    const turn = (mine ? QUARTER_RAD : Math.round(now / QUARTER_RAD) * QUARTER_RAD) - way.heading;
    // What it is turned for stays where it is, unless its way leads out of the picture.
    v.turnAt(...v.to(way.x, way.y), turn);
    if (mine && !places.every(([x, y]) => v.isClear(x, y, EDGE_PX))) v.fitPlaces(places, AROUND_M, v.z);
  });
}

export const turning: readonly Omit<Action, 'group'>[] = [
  {
    id: 'align-road',
    label: TEXTS.alignWithTheRoad,
    keys: ['Alt+R'],
    icon: 'road',
    help: 'theSelectedDrives',
    when: hasScene,
    run: alignWithRoad,
  },
  {
    id: 'north-up',
    label: TEXTS.northUp,
    keys: ['Alt+N'],
    icon: 'north',
    help: 'turnsThePicture',
    run: (c) => c.stage.glide.by((v) => v.turnTo(0)),
  },
  {
    id: 'turn-picture-left',
    label: TEXTS.turnThePictureLeft,
    keys: ['Shift+PageUp'],
    help: 'by15DegreesAbout',
    run: (c) => stepBy(c, STEP_RAD),
  },
  {
    id: 'turn-picture-right',
    label: TEXTS.turnThePictureRight,
    keys: ['Shift+PageDown'],
    help: 'by15DegreesAbout',
    run: (c) => stepBy(c, -STEP_RAD),
  },
];
