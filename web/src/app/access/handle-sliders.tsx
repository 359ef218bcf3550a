// The handles of the selected road user, for keys and screen readers. They have no picture of their own.
import { useComputed, type ReadonlySignal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import type { Command } from '../../model/commands';
import { deg } from '../../model/geometry';
import { canMove } from '../../model/scene';
import { num, speedLabel } from '../../model/units';
import type { Field, Part } from '../../edit/editor';
import * as moves from '../../edit/moves';
import { laneWords } from '../../edit/snap';
import { useAgent, type LiveAgent } from '../inspector/use-agent';
import { useApp } from '../parts/app-context';

export function HandleSliders() {
  const { editor } = useApp();
  const id = useComputed(() =>
    editor.restingAgent.value && canMove(editor.restingAgent.value) ? editor.selection.value : null,
  );
  return (
    <div class="sr" role="group" aria-label="Handles" data-group="handles">
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
      aria-valuenow={useAtRest(() => now().toFixed(1)) as never}
      aria-valuetext={useAtRest(text)}
      aria-valuemin={-10000}
      aria-valuemax={10000}
      onFocus={() => editor.activate(part)}
      onKeyDown={keyDown}
    />
  );
}

/** What `read` gives; while a pointer drags, as it was before: nobody hears of a handle that they move with it. */
function useAtRest(read: () => string): ReadonlySignal<string> {
  const { editor } = useApp();
  const last = useRef<string | null>(null);
  return useComputed(() => (editor.dragging.value && last.current !== null ? last.current : (last.current = read())));
}

const WORD = { start: 'Start', goal: 'Goal' } as const;

function PartSliders({ agent, part }: { agent: LiveAgent; part: Part }) {
  const { editor } = useApp();
  const pose = () => moves.shownPose(editor, agent.value, part);
  const freedom = (f: Field) => (agent.value[part][f] === null ? ', free' : ', fixed');
  const place = () => {
    const p = pose();
    if (!p) return 'not known';
    const lane = laneWords(editor.scene.value!.map, agent.value, p.x, p.y, p.heading);
    return `${num(p.x, 1)}, ${num(p.y, 1)} metres, ${lane}${freedom('pos')}`;
  };
  const heading = () => deg(pose()?.heading ?? 0);
  const speed = () => pose()?.speed ?? 0;
  return (
    <>
      <Slider
        label={`${WORD[part]} position`}
        part={part}
        now={() => pose()?.x ?? 0}
        text={place}
        move={([dx, dy], far) => {
          const step = far ? 1 : 0.1;
          return moves.nudge(editor, agent.peek(), part, dx * step, dy * step);
        }}
      />
      <Slider
        label={`${WORD[part]} heading`}
        part={part}
        now={heading}
        text={() => `${Math.round(heading())} degrees${freedom('heading')}`}
        move={([, , more], far) => moves.turn(editor, agent.peek(), part, more * (far ? 15 : 1))}
      />
      <Slider
        label={`${WORD[part]} speed`}
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
      label="Goal time"
      part="goal"
      now={() => agent.value.goal.time}
      text={() => `${num(agent.value.goal.time, 1)} seconds`}
      move={([, , more], far) => moves.later(editor, agent.peek(), more * (far ? 1 : 0.1))}
    />
  );
}
