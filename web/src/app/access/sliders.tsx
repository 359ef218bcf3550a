// A slider for each handle of a road user: start, goal, and via points.
import { useComputed, type ReadonlySignal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import type { Command } from '../../model/document/commands';
import { deg } from '../../model/base/geometry';
import { lengthText, lengthUnitWord, num, speedLabel } from '../../model/base/units';
import type { Field } from '../../edit/session/editor';
import type { HandlePart } from '../../edit/session/drag';
import * as moves from '../../edit/moves/moves';
import { laneWords } from '../../edit/moves/snap';
import { heldTime, viaTime } from '../../edit/moves/via-times';
import { changeVia, moveVia, viaName, widenVia } from '../../edit/moves/vias';
import { useAgent, type LiveAgent } from '../inspector/use-agent';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/desk/access';
import { TEXTS as VIA } from '../../texts/editing/via';

export function Sliders({ id }: { id: string }) {
  const agent = useAgent(id);
  return (
    <div>
      <PartSliders agent={agent} part="start" />
      <PartSliders agent={agent} part="goal" />
      <TimeSlider agent={agent} />
      <ViaSliders agent={agent} />
    </div>
  );
}

/** Direction of an arrow key: right and up in the picture, and more or less. */
const ARROWS: Record<string, readonly [right: number, up: number, more: 1 | -1]> = {
  ArrowLeft: [-1, 0, -1],
  ArrowRight: [1, 0, 1],
  ArrowUp: [0, 1, 1],
  ArrowDown: [0, -1, -1],
};

interface HandleSliderProps {
  label: string;
  part: HandlePart;
  /** Index of the via point. */
  via?: number;
  now: () => number;
  text: () => string;
  /** The command of an arrow key; `far` with Shift. */
  move: (arrow: (typeof ARROWS)[string], far: boolean) => Command | null;
}

function Slider({ label, part, via, now, text, move }: HandleSliderProps) {
  const { editor } = useApp();
  const focus = (e: FocusEvent) => {
    editor.activate(part);
    if (via !== undefined) editor.takeVia(via);
    if ((e.currentTarget as Element).matches(':focus-visible')) editor.focusHandle({ part, via: via ?? null });
  };
  const keyDown = (e: KeyboardEvent) => {
    if (!ARROWS[e.key] || e.ctrlKey || e.altKey) return;
    e.preventDefault();
    e.stopPropagation();
    const command = move(ARROWS[e.key], e.shiftKey);
    if (command) editor.commits.run(command);
  };
  return (
    <div
      role="slider"
      tabindex={0}
      aria-label={label}
      aria-valuenow={useAtRest(() => now().toFixed(1)) as never}
      aria-valuetext={useAtRest(text)}
      aria-valuemin={-10000}
      aria-valuemax={10000}
      onFocus={focus}
      onBlur={() => editor.focusHandle(null)}
      onKeyDown={keyDown}
    />
  );
}

/** The value of `read`; frozen during a pointer drag, which needs no announcements. */
function useAtRest(read: () => string): ReadonlySignal<string> {
  const { editor } = useApp();
  const last = useRef<string | null>(null);
  return useComputed(() =>
    editor.drag.active.value && last.current !== null ? last.current : (last.current = read()),
  );
}

const WORD = { start: TEXTS.start, goal: TEXTS.goal } as const;

function PartSliders({ agent, part }: { agent: LiveAgent; part: HandlePart }) {
  const { editor, stage } = useApp();
  const pose = () => moves.shownPose(editor, agent.value, part);
  const freedom = (f: Field) => (agent.value[part][f] === null ? TEXTS.free : TEXTS.fixed);
  const place = () => {
    const p = pose();
    if (!p) return TEXTS.unknown;
    const lane = laneWords(editor.scene.value!.map, agent.value, p.x, p.y, p.heading);
    return TEXTS.metres(num(p.x, 1), num(p.y, 1), lane, freedom('pos'));
  };
  const heading = () => deg(pose()?.heading ?? 0);
  const speed = () => pose()?.speed ?? 0;
  return (
    <>
      <Slider
        label={TEXTS.position(WORD[part])}
        part={part}
        now={() => pose()?.x ?? 0}
        text={place}
        move={([right, up], far) => {
          const step = far ? 1 : 0.1;
          return moves.nudge(editor, agent.peek(), part, ...stage.view.along(right * step, up * step));
        }}
      />
      <Slider
        label={TEXTS.heading(WORD[part])}
        part={part}
        now={heading}
        text={() => TEXTS.degrees(Math.round(heading()), freedom('heading'))}
        move={([, , more], far) => moves.turn(editor, agent.peek(), part, more * (far ? 15 : 1))}
      />
      <Slider
        label={TEXTS.speed(WORD[part])}
        part={part}
        now={speed}
        text={() => `${speedLabel(speed(), editor.view.unitOf(agent.value))}${freedom('speed')}`}
        move={([, , more], far) => moves.faster(editor, agent.peek(), part, more * (far ? 10 : 1))}
      />
    </>
  );
}

function TimeSlider({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  return (
    <Slider
      label={TEXTS.goalTime}
      part="goal"
      now={() => agent.value.goal.time}
      text={() => TEXTS.seconds(num(agent.value.goal.time, 1))}
      move={([, , more], far) => moves.later(editor, agent.peek(), more * (far ? 1 : 0.1))}
    />
  );
}

function ViaSliders({ agent }: { agent: LiveAgent }) {
  const count = useComputed(() => agent.value.goal.via.length).value;
  return (
    <>
      {Array.from({ length: count }, (_, i) => (
        <ViaSlider key={i} agent={agent} i={i} />
      ))}
    </>
  );
}

function ViaSlider({ agent, i }: { agent: LiveAgent; i: number }) {
  const { editor, stage } = useApp();
  const via = () => agent.value.goal.via[i];
  const name = useComputed(() => viaName(agent.value, i)).value;
  const place = () => {
    const [x, y] = via()?.pos ?? [0, 0];
    return VIA.metres(num(x, 1), num(y, 1), laneWords(editor.scene.value!.map, agent.value, x, y, null));
  };
  const time = () => via()?.time ?? viaTime(editor, agent.value, i) ?? 0;
  return (
    <>
      <Slider
        label={VIA.position(name)}
        part="goal"
        via={i}
        now={() => via()?.pos[0] ?? 0}
        text={place}
        move={([right, up], far) => {
          const [x, y] = agent.peek().goal.via[i].pos;
          const step = far ? 1 : 0.1;
          const [dx, dy] = stage.view.along(right * step, up * step);
          return moveVia(agent.peek(), i, [x + dx, y + dy], true);
        }}
      />
      <Slider
        label={VIA.tolerance(name)}
        part="goal"
        via={i}
        now={() => via()?.tolerance ?? 0}
        text={() => VIA.wide(lengthText(via()?.tolerance ?? 0, 1), lengthUnitWord())}
        move={([, , more], far) =>
          widenVia(agent.peek(), i, agent.peek().goal.via[i].tolerance + more * (far ? 1 : 0.1), true)
        }
      />
      <Slider
        label={VIA.time(name)}
        part="goal"
        via={i}
        now={time}
        text={() => `${TEXTS.seconds(num(time(), 1))}${via()?.time == null ? TEXTS.free : TEXTS.fixed}`}
        move={([, , more], far) => {
          const a = agent.peek();
          const t = heldTime(a, i, time() + more * (far ? 1 : 0.1), editor.scene.peek()?.length ?? 9);
          return t === null ? null : changeVia(a, i, { time: t }, true);
        }}
      />
    </>
  );
}
