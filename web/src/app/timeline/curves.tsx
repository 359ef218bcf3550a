// Speed curves of the selected road user: recording, futures, start and goal.
import { untracked } from '@preact/signals';
import { thinned, type Vec } from '../../model/base/geometry';
import { smoothSpeed, STEP_S, stretches, type Motion } from '../../model/base/motion';
import { isSettled, type Future, type Futures } from '../../model/document/futures';
import { startPose, touched, type Agent } from '../../model/document/scene';
import { toUnit } from '../../model/base/units';
import { modeStyle, UNSEEN_PX } from '../../draw/strokes';
import type { Context } from '../../actions/context';
import { useApp } from '../parts/app-context';
import { colourKey } from '../../draw/sprites';
import { eventShown, severalShown, X0, type Axes, type SpeedLine, hasCurves } from './axes';
import { TEXTS } from '../../texts/panels/timeline';

export function Curves({ axes: a }: { axes: Axes }) {
  const c = useApp();
  const { editor, curve } = c;
  const several = severalShown(c);
  const meeting = editor.view.beside.peek()?.meeting;
  const both = c.variants.comparing.followed.peek() && c.variants.comparing.compared.peek();
  const event = eventShown(c);
  const few = !!both || !!meeting || !!event;
  const agent = meeting || both ? null : editor.agent.peek();
  const dashed = curve.before.peek() ? TEXTS.before : editor.view.layers.peek().log ? TEXTS.log : null;
  const name = agent
    ? ` · ${agent.name}${dashed ? TEXTS.dashed(dashed) : ''}`
    : both
      ? TEXTS.inVariants(several[0].agent.name, both.left.id, both.right.id)
      : meeting
        ? TEXTS.inCase(several.map((l) => l.agent.name).join(TEXTS.and), meeting.called)
        : event
          ? ` · ${event.a.name}${event.b ? TEXTS.dashed(event.b.name) : ''}`
          : several.length
            ? TEXTS.selectedOneLine(several.length, editor.selected.peek().length)
            : '';
  const drawn = agent
    ? (editor.reading.futures.peek()?.modes.map((m) => m.motion) ?? [agent.log])
    : several.map((l) => l.motion);
  if (!hasCurves(a)) return null;
  return (
    <>
      {agent ? (
        <AgentCurves axes={a} agent={agent} />
      ) : several.length ? (
        <SeveralCurves axes={a} all={several} strong={few} />
      ) : (
        <Hint axes={a} />
      )}
      <text class="back" x={X0 + 8} y={titleAt(a, drawn)}>
        {`${a.unit}${name}`}
      </text>
    </>
  );
}

/** The title is above or below, wherever the start of the curves leaves more room. */
function titleAt(a: Axes, motions: readonly Motion[]): number {
  const room = (y: number): number =>
    Math.min(
      ...motions.flatMap((m) =>
        [...m.speed.slice(0, TITLE_STEPS)].map((v) => Math.abs(a.y(toUnit(Math.abs(v), a.unit)) - y)),
      ),
    );
  const [above, below] = [a.y0 + 11, a.y1 - 6];
  return room(below) > room(above) ? below : above;
}

/** One thin line each; thick for the one under the pointer, and for the few of a case or an event. */
function SeveralCurves({ axes, all, strong }: { axes: Axes; all: readonly SpeedLine[]; strong: boolean }) {
  const { editor } = useApp();
  const hovered = editor.hover.peek();
  return (
    <>
      {all.map(({ agent: a, motion }, i) => (
        <Curve
          key={i}
          axes={axes}
          motion={motion}
          colour={`var(--${colourKey(a)})`}
          width={a.id === hovered || (strong && !i) ? 2.5 : strong ? 1.6 : 1.1}
          opacity={a.id === hovered || strong ? 1 : 0.65}
          dash={strong && i ? '5 3' : ''}
          smooth
        />
      ))}
    </>
  );
}

function Hint({ axes: a }: { axes: Axes }) {
  return (
    <text class="big back" x={(X0 + a.x1) / 2} y={(a.y0 + a.y1) / 2 + 4} text-anchor="middle">
      {whatIsMissing(useApp())}
    </text>
  );
}

function whatIsMissing({ layouts, editor: { resting } }: Context): string {
  if (layouts.isNew.peek()) return TEXTS.nobodyOnThisMap;
  const scene = resting.peek();
  if (!scene) return TEXTS.nothingToPlay;
  return scene.agents.size ? TEXTS.selectARoadUser : TEXTS.placeARoadUser;
}

function AgentCurves({ axes, agent }: { axes: Axes; agent: Agent }) {
  const { editor, curve } = useApp();
  const f = editor.reading.futures.peek();
  const before = f && curve.before.peek();
  // The draggable points are rendered separately; while a handle is dragged there are none.
  const taken = curve.points.peek().length > 0 && !editor.drag.active.peek();
  // With two dashed lines one would be mistaken for the other.
  const showLog = !before && (editor.view.layers.peek().log || !f || editor.reading.replays.peek());
  const inForce = !f || editor.reading.replays.peek();
  return (
    <>
      {before ? <Curve axes={axes} motion={before} colour="var(--ink-2)" width={1.5} opacity={0.9} dash="4 3" /> : null}
      {showLog ? (
        <Curve
          axes={axes}
          motion={agent.log}
          colour={inForce ? 'var(--ink)' : 'var(--log)'}
          width={inForce ? 2.25 : 1.5}
          opacity={0.9}
          dash={f ? '4 3' : ''}
          smooth
        />
      ) : null}
      {f ? <FutureCurves axes={axes} futures={f} /> : null}
      {taken ? null : <StartPoint axes={axes} agent={agent} />}
      {taken ? null : <GoalPoint axes={axes} agent={agent} />}
    </>
  );
}

/** About the length of the title in steps of a curve. */
const TITLE_STEPS = 14;

const modeColour = (i: number): string => `var(--mode-${'abcdef'[i]})`;

/** The followed one last, on top of the others. */
function FutureCurves({ axes, futures: f }: { axes: Axes; futures: Futures }) {
  const { editor, curve } = useApp();
  const chosen = editor.reading.bold.peek();
  const hovered = editor.hoverFuture.peek();
  const max = Math.max(...f.modes.map((m) => m.probability));
  const dash = isSettled(f) && !f.sketch ? '' : '3 3';
  // With a drawn speed profile the other futures do not apply.
  const others = !curve.profile.peek();
  const inForce: Future | undefined = f.modes[chosen];
  return (
    <>
      {f.modes.map((m, i) =>
        i === chosen || !(others || hovered === i) ? null : (
          <Curve
            key={i}
            axes={axes}
            motion={m.motion}
            colour={modeColour(i)}
            width={hovered === i ? 2.25 : 1.25}
            opacity={hovered === i ? 1 : 0.25 + 0.4 * modeStyle(m.probability, max).alpha}
            dash={dash}
          />
        ),
      )}
      {inForce ? (
        <Curve
          axes={axes}
          motion={inForce.motion}
          colour={f.sketch ? 'var(--ink-3)' : modeColour(chosen)}
          width={2.5}
          opacity={1}
          dash={dash}
        />
      ) : null}
    </>
  );
}

interface CurveProps {
  axes: Axes;
  motion: Motion;
  colour: string;
  width: number;
  opacity: number;
  dash: string;
  smooth?: boolean;
}

function Curve({ axes, motion, colour, width, opacity, dash, smooth = false }: CurveProps) {
  return (
    <path
      d={pathOf(axes, motion, smooth)}
      fill="none"
      stroke={colour}
      stroke-width={width}
      opacity={opacity}
      stroke-dasharray={dash}
      stroke-linejoin="round"
    />
  );
}

/** A line through the speeds, with the gaps of the recording. */
function pathOf(a: Axes, m: Motion, smooth: boolean): string {
  const speeds = smooth ? smoothSpeed(m) : m.speed;
  const last = Math.floor((a.duration + 1e-6) / STEP_S) - m.first;
  const at = (i: number): Vec => [a.x((m.first + i) * STEP_S), a.y(toUnit(Math.abs(speeds[i]), a.unit))];
  let d = '';
  for (const [from, to] of stretches(m, Math.max(0, -m.first), Math.min(last, speeds.length - 1))) {
    let pen = 'M';
    thinned(from, to, at, UNSEEN_PX, ([x, y]) => {
      d += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
      pen = 'L';
    });
  }
  return d;
}

function StartPoint({ axes: a, agent }: { axes: Axes; agent: Agent }) {
  const start = startPose(agent);
  if (!start || !touched(agent)) return null;
  const y = a.y(toUnit(start.speed, a.unit));
  return <circle cx={a.x(0)} cy={y} r={4.5} fill="var(--surface)" stroke="var(--ink)" stroke-width={2.5} />;
}

function GoalPoint({ axes: a, agent }: { axes: Axes; agent: Agent }) {
  const { editor } = useApp();
  const goal = untracked(() => editor.reading.goalPose(agent));
  if (!goal || !agent.goal.pos) return null;
  const free = agent.goal.speed === null;
  return (
    <circle
      cx={a.x(Math.min(a.duration, agent.goal.time))}
      cy={a.y(toUnit(goal.speed, a.unit))}
      r={5}
      fill={free ? 'var(--surface)' : 'var(--goal)'}
      stroke="var(--goal)"
      stroke-width={2}
      stroke-dasharray={free ? '2.6 2.4' : ''}
    />
  );
}
