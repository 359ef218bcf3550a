// The handles of the selected road user, for keys and screen readers. They have no picture of their own.
import { useComputed } from '@preact/signals';
import type { Command } from '../../model/commands';
import { deg } from '../../model/geometry';
import { canMove } from '../../model/scene';
import { num, speedLabel } from '../../model/units';
import type { Field, Part } from '../../edit/editor';
import * as moves from '../../edit/moves';
import { laneWords } from '../../edit/snap';
import { useAgent, type LiveAgent } from '../inspector/use-agent';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/access';

export function HandleSliders() {
  const { editor } = useApp();
  const id = useComputed(() => (editor.agent.value && canMove(editor.agent.value) ? editor.selection.value : null));
  return (
    <div class="sr" role="group" aria-label={TEXTS.handles} data-group="handles">
      {id.value ? <Sliders key={id.value} id={id.value} /> : null}
    </div>
  );
}

function Sliders({ id }: { id: string }) {
  const agent = useAgent(id);
  return (
    <div>
      <PartSliders agent={agent} part="start" />
      <PartSliders agent={agent} part="goal" />
      <TimeSlider agent={agent} />
    </div>
  );
}

/** Which way an arrow key goes, as x and y and as more or less. */
const ARROWS: Record<string, readonly [dx: number, dy: number, more: 1 | -1]> = {
  ArrowLeft: [-1, 0, -1],
  ArrowRight: [1, 0, 1],
  ArrowUp: [0, 1, 1],
  ArrowDown: [0, -1, -1],
};

interface SliderProps {
  label: string;
  part: Part;
  now: () => number;
  text: () => string;
  /** The command of an arrow key; `far` with Shift. */
  move: (arrow: (typeof ARROWS)[string], far: boolean) => Command | null;
}

function Slider({ label, part, now, text, move }: SliderProps) {
  const { editor } = useApp();
  const keyDown = (e: KeyboardEvent) => {
    if (!ARROWS[e.key] || e.ctrlKey || e.altKey) return;
    e.preventDefault();
    e.stopPropagation();
    const command = move(ARROWS[e.key], e.shiftKey);
    if (command) editor.run(command);
  };
  return (
    <div
      role="slider"
      tabindex={0}
      aria-label={label}
      aria-valuenow={useComputed(() => now().toFixed(1)) as never}
      aria-valuetext={useComputed(text)}
      aria-valuemin={-10000}
      aria-valuemax={10000}
      onFocus={() => editor.activate(part)}
      onKeyDown={keyDown}
    />
  );
}

const WORD = { start: TEXTS.start, goal: TEXTS.goal } as const;

function PartSliders({ agent, part }: { agent: LiveAgent; part: Part }) {
  const { editor } = useApp();
  const pose = () => moves.shownPose(editor, agent.value, part);
  const freedom = (f: Field) => (agent.value[part][f] === null ? TEXTS.free : TEXTS.fixed);
  const place = () => {
    const p = pose();
    if (!p) return TEXTS.notKnown;
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
        move={([dx, dy], far) => {
          const step = far ? 1 : 0.1;
          return moves.nudge(editor, agent.peek(), part, dx * step, dy * step);
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
        text={() => `${speedLabel(speed(), editor.unitOf(agent.value))}${freedom('speed')}`}
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
