// Start and goal: each field with its value, and whether it is fixed or free.
import type { ComponentChildren } from 'preact';
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { clamp, deg, rad, wrapAngle, type Vec } from '../../model/base/geometry';
import { rangesOf, topSpeed } from '../../model/base/domain';
import { KIND_NAMES, PLACED_KINDS, PRESETS, type PlacedKind } from '../../model/base/kinds';
import { hasGoal, nameIn, type GoalSpec } from '../../model/document/scene';
import { fromUnit, lengthUnit, lengthUnitWord, num, sizeText, speedText, toUnit } from '../../model/base/units';
import type { Field } from '../../edit/session/editor';
import type { HandlePart } from '../../edit/session/drag';
import type { HandleName } from '../../edit/session/drag';
import { goalTime, isGoalOfLog, timeRange, resize, shownPose, toggleField, withField } from '../../edit/moves/moves';
import { noteOn, setKind } from '../../edit/moves/several';
import { laneWords } from '../../edit/moves/snap';
import { typedPlace } from '../../edit/moves/typed-place';
import { leaveGiven } from '../../edit/moves/ways-out';
import { relationCommand } from '../../edit/tools/relations/typed-relation';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { NumberField, Scrub, type NumberFieldProps } from '../parts/number-field';
import { GapOfferButton, RelationRow } from './relation-row';
import type { LiveAgent } from './use-agent';
import { placesAlong } from '../../model/document/lanemap';
import { TEXTS as RELATION } from '../../texts/editing/relation';
import { TEXTS } from '../../texts/panels/agent';

export function StartSection({ agent }: { agent: LiveAgent }) {
  const { form, ui } = useApp();
  const all = useAllFields();
  return (
    <section class="sect startsec" aria-label={TEXTS.start}>
      <h3>
        <span class="mkr" />
        {TEXTS.start}
        <small>{TEXTS.at00S}</small>
      </h3>
      <PoseRows agent={agent} part="start" all={all} />
      {all ? (
        <>
          <TypeRow agent={agent} />
          <Row label={TEXTS.size}>
            <SizeField agent={agent} name="length" />
            <SizeField agent={agent} name="width" />
          </Row>
          <Note agent={agent} />
        </>
      ) : null}
      {form.sheet.value ? null : (
        <button type="button" class="more" aria-expanded={all} onClick={() => ui.showAllFields(!all)}>
          {all ? TEXTS.fewerFields : TEXTS.moreFields}
          <Icon name="down" size={12} />
        </button>
      )}
    </section>
  );
}

/** Are the rarely typed fields shown, too? A sheet has them below the fold. */
const useAllFields = (): boolean => {
  const { form, ui } = useApp();
  return form.sheet.value || ui.allFields.value;
};

function Note({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const area = useRef<HTMLTextAreaElement>(null);
  const note = useComputed(() => agent.value.note);
  return (
    <textarea
      ref={area}
      class="notes"
      data-text="note"
      aria-label={TEXTS.note}
      placeholder={TEXTS.note}
      rows={1}
      maxlength={2000}
      value={note}
      onBlur={() => {
        if (!area.current) return;
        const typed = area.current.value.trim();
        if (typed !== note.peek()) editor.commits.run(noteOn(agent.peek(), typed));
      }}
      onKeyDown={(e) => {
        if (e.key !== 'Escape') return;
        area.current!.value = note.peek();
        area.current!.blur();
        e.stopPropagation();
      }}
    />
  );
}

export function GoalSection({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const all = useAllFields();
  const place = useComputed(() => {
    const a = agent.value;
    const drag = editor.reading.throttle.read(() => editor.drag.info.value);
    if (drag?.grip.part === 'goal' && drag.lane) return drag.lane.name;
    const to = a.goal.relation?.to;
    if (to !== undefined) return RELATION.relativeTo(nameIn(editor.scene.value!)(to) ?? to);
    if (a.goal.pos && isGoalOfLog(a)) return TEXTS.asRecordedNote;
    if (a.goal.pos) return laneWords(editor.scene.value!.map, a, a.goal.pos[0], a.goal.pos[1], a.goal.heading);
    return hasGoal(a.goal) ? TEXTS.partlyFree : TEXTS.freeTheGenerator;
  });
  // A goal with a place of its own is rarely related to another road user.
  const own = useComputed(() => agent.value.goal.pos !== null && !agent.value.goal.relation).value;
  const run = (time: number, live = false) => {
    const rounded = Math.round(goalTime(editor.scene.peek(), time) * 100) / 100;
    editor.commits.run(withField(agent.peek(), 'goal', { time: rounded }, live));
  };
  const time = { value: () => agent.value.goal.time, step: 0.1, set: run, range: () => timeRange(editor.scene.value) };
  return (
    <section class="sect goalsec" aria-label={TEXTS.goal} style={`--whose: "${TEXTS.ofTheGoal}"`}>
      <h3>
        <span class="mk">
          <Icon name="flag" size={15} />
        </span>
        {TEXTS.goal}
        <small>{place}</small>
      </h3>
      <PoseRows agent={agent} part="goal" all={all} />
      <Row label={TEXTS.time} scrub={time}>
        <NumberField
          {...time}
          label={TEXTS.timeAtTheGoal}
          unit={() => 's'}
          quantity={() => 'time'}
          field="goal-time"
          live={() => editor.drag.info.value?.grip.handle === 'time'}
          text={() => num(agent.value.goal.time, 1)}
        />
      </Row>
      {all || !own ? <RelationRow agent={agent} /> : null}
      <GapOfferButton />
      <LeaveLine agent={agent} />
    </section>
  );
}

/** Road edges that it may cross, with a button to withdraw that. */
function LeaveLine({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const leave = useComputed(() => leaveGiven(agent.value)).value;
  if (!leave) return null;
  return (
    <p class="leave">
      {leave.words}
      <button type="button" aria-label={TEXTS.undo(leave.words)} onClick={() => editor.commits.run(leave.command)}>
        <Icon name="x" size={12} />
      </button>
    </p>
  );
}

interface PartRowProps {
  label: string;
  children: ComponentChildren;
  end?: ComponentChildren;
  /** Dragging the label changes the value. */
  scrub?: Pick<NumberFieldProps, 'value' | 'step' | 'set' | 'range'>;
}

function Row({ label, children, end, scrub }: PartRowProps) {
  return (
    <div class="pr">
      {scrub ? <Scrub letter={label} class="lab scrub" {...scrub} /> : <span class="lab">{label}</span>}
      <div class="fs">{children}</div>
      {end || <span />}
    </div>
  );
}

interface PartProps {
  agent: LiveAgent;
  part: HandlePart;
}

const WORD = { start: TEXTS.start, goal: TEXTS.goal } as const;

/** Shared parts of the fields. */
function usePart({ agent, part }: PartProps) {
  const { editor } = useApp();
  return {
    editor,
    word: WORD[part],
    spec: () => agent.value[part],
    shown: () => shownPose(editor, agent.value, part),
    run: (patch: Partial<GoalSpec>, live = false) => editor.commits.run(withField(agent.peek(), part, patch, live)),
    dragged: (handle: HandleName) => {
      const grip = editor.drag.info.value?.grip;
      return grip?.part === part && grip.handle === handle;
    },
    focused: (field: Field) => () => {
      editor.activate(part);
      editor.touchField(part, field);
    },
  };
}

/** A displayed value: a free one is marked as approximate. */
const about = (free: boolean, v: number | null | undefined, text: (v: number) => string): string =>
  v == null ? '' : `${free ? '≈ ' : ''}${text(v)}`;

/** A start is nearly always fixed: its pills are among the rarely used fields. */
function PoseRows({ all, ...props }: PartProps & { all: boolean }) {
  const pill = all || props.part === 'goal';
  return (
    <>
      <Row label={TEXTS.position} end={pill && <FixedPill {...props} field="pos" label={TEXTS.positionWithin} />}>
        <Coordinate {...props} axis={0} />
        <Coordinate {...props} axis={1} />
      </Row>
      {all ? <HeadingRow {...props} /> : null}
      <SpeedRow {...props} pill={pill} />
    </>
  );
}

/** Does the other road user give this value of a goal? A passing gives the time alone. */
function givenByRelation({ relation: r }: GoalSpec, field: Field): boolean {
  if (!r || r.after_s != null) return false;
  return field === 'speed' ? r.slower_mps != null : true;
}

function FixedPill({ agent, part, field, label }: PartProps & { field: Field; label: string }) {
  const { editor } = useApp();
  const fixed = useComputed(() => agent.value[part][field] !== null).value;
  const related = useComputed(() => part === 'goal' && givenByRelation(agent.value.goal, field)).value;
  const toggle = () => {
    const command = toggleField(editor, agent.peek(), part, field);
    if (command) editor.commits.run(command);
  };
  // Its heading is that of the lane, and is not fixed.
  if (related && field === 'heading') return <span />;
  return (
    <button
      type="button"
      class="fx"
      role="switch"
      aria-checked={fixed}
      aria-label={TEXTS.fixed(WORD[part], label)}
      title={fixed ? TEXTS.fixedYouDecide : related ? TEXTS.relativeToAnother : TEXTS.freeTheGeneratorDecides}
      onClick={toggle}
    >
      <Icon name="lock" size={11} />
      {fixed ? TEXTS.isFixed : related ? TEXTS.isRelative : TEXTS.free}
    </button>
  );
}

function Coordinate({ axis, ...props }: PartProps & { axis: 0 | 1 }) {
  const { editor, word, spec, shown, run, dragged, focused } = usePart(props);
  const name = axis ? 'y' : 'x';
  const free = () => spec().pos === null;
  const set = (v: number, live?: boolean) => {
    const p = shown();
    if (p) run({ pos: Object.freeze(axis ? [p.x, v] : [v, p.y]) as Vec }, live);
  };
  const words = (text: string): true | string | null => {
    const a = props.agent.peek();
    const place = typedPlace(editor, a, text);
    if (typeof place === 'string') return place;
    if (place) {
      run(place);
      return true;
    }
    const related = props.part === 'goal' && relationCommand(editor, a, text.trim());
    if (!related || typeof related === 'string') return null;
    editor.commits.run(related);
    return true;
  };
  return (
    <NumberField
      label={TEXTS.inMetres(word, name)}
      letter={name}
      unit={() => (lengthUnit() === 'ft' ? 'm' : '')}
      quantity={() => 'place'}
      step={0.1}
      field={`${props.part}-pos`}
      value={() => shown()?.[name] ?? null}
      text={() => about(free(), shown()?.[name], (v) => num(v, 1))}
      range={() => placesAlong(editor.scene.peek()!.map, axis)}
      free={free}
      live={() => dragged('body')}
      set={set}
      words={words}
      onFocus={focused('pos')}
    />
  );
}

function HeadingRow(props: PartProps) {
  const { editor, word, spec, shown, run, dragged, focused } = usePart(props);
  const degrees = (radians: number): number => Math.round(deg(radians));
  const free = () => spec().heading === null;
  const field = {
    step: 1,
    value: () => {
      const p = shown();
      return p ? degrees(p.heading) : null;
    },
    set: (v: number, live?: boolean) => {
      editor.drag.setHeadingFollows(props.part, props.agent.peek(), false);
      run({ heading: wrapAngle(rad(v)) }, live);
    },
  };
  return (
    <Row label={TEXTS.heading} scrub={field} end={<FixedPill {...props} field="heading" label={TEXTS.headingWithin} />}>
      <NumberField
        {...field}
        label={TEXTS.headingInDegrees(word)}
        unit={() => '°'}
        quantity={() => 'angle'}
        field={`${props.part}-heading`}
        text={() => about(free(), shown()?.heading, (v) => num(degrees(v), 0))}
        free={free}
        live={() => dragged('heading')}
        onFocus={focused('heading')}
      />
    </Row>
  );
}

function SpeedRow({ pill, ...props }: PartProps & { pill: boolean }) {
  const { editor, word, spec, shown, run, dragged, focused } = usePart(props);
  const { agent } = props;
  const onFoot = useComputed(() => agent.value.type === 'pedestrian').value;
  const unit = () => editor.view.unitOf(agent.value);
  const free = () => spec().speed === null;
  const field = {
    step: onFoot ? 0.1 : 1,
    value: () => {
      const p = shown();
      return p ? Number(toUnit(p.speed, unit()).toFixed(2)) : null;
    },
    set: (v: number, live?: boolean) => run({ speed: clamp(fromUnit(v, unit()), 0, topSpeed(agent.peek())) }, live),
    range: () => [0, toUnit(topSpeed(agent.value), unit())] as const,
  };
  return (
    <Row
      label={TEXTS.speed}
      scrub={field}
      end={pill && <FixedPill {...props} field="speed" label={TEXTS.speedWithin} />}
    >
      <NumberField
        {...field}
        label={TEXTS.speedOf(word)}
        unit={unit}
        quantity={unit}
        field={`${props.part}-speed`}
        text={() => about(free(), shown()?.speed, (v) => speedText(v, unit()))}
        free={free}
        live={() => dragged('speed')}
        onFocus={focused('speed')}
      />
    </Row>
  );
}

/** Its type: a kind in one of its usual sizes. Another kind uses another expert. */
function TypeRow({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const shown = useComputed(() => {
    const { kind, subtype, length, width } = agent.value;
    const i =
      kind === 'other'
        ? -1
        : PRESETS[kind].findIndex(
            (p) => p.length === length && p.width === width && (p.subtype === subtype || subtype === null),
          );
    return i < 0 ? `${kind}:own` : `${kind}:${i}`;
  });
  const choose = (value: string) => {
    const [kind, i] = value.split(':') as [PlacedKind, string];
    const size = PRESETS[kind]?.[Number(i)];
    const command = size && setKind([agent.peek()], kind, size);
    if (command) editor.commits.run(command);
  };
  const own = useComputed(() => (shown.value.endsWith(':own') ? agent.value.kind : null)).value;
  return (
    <Row label={TEXTS.type}>
      <select
        class="field pick"
        aria-label={TEXTS.type}
        data-field="type"
        value={shown.value}
        onChange={(e) => choose(e.currentTarget.value)}
      >
        {PLACED_KINDS.map((kind) => (
          <optgroup key={kind} label={KIND_NAMES[kind]}>
            {own === kind ? <option value={`${kind}:own`}>{TEXTS.customSize(KIND_NAMES[kind])}</option> : null}
            {PRESETS[kind].map((p, i) => (
              <option key={p.label} value={`${kind}:${i}`}>
                {p.label}
              </option>
            ))}
          </optgroup>
        ))}
      </select>
    </Row>
  );
}

function SizeField({ agent, name }: { agent: LiveAgent; name: 'length' | 'width' }) {
  const { editor } = useApp();
  const set = (v: number) => {
    const a = agent.peek();
    editor.commits.run(name === 'length' ? resize(a, v, a.width) : resize(a, a.length, v));
  };
  return (
    <NumberField
      label={TEXTS.sizeIn(TEXTS.sizes[name], lengthUnitWord())}
      letter={TEXTS.letters[name]}
      unit={lengthUnit}
      quantity={() => 'length'}
      step={0.1}
      value={() => agent.value[name]}
      range={() => rangesOf(agent.value)[`${name}_m`]}
      text={() => sizeText(agent.value[name])}
      set={set}
    />
  );
}
