// Parameters of a map being made: the selected arm, the whole map, and its checks.
import { Fragment, type ComponentChildren } from 'preact';
import { useState } from 'preact/hooks';
import { connectionOf, laneOf, rangeOf, sameWay, TEMPLATE_TITLES } from '../../model/document/layouts';
import { messageText, withArms } from '../../model/words/message-text';
import { SENTENCES } from '../../texts/messages/map-messages';
import { fromUnit, lengthUnit, num, speedText, toLength, toUnit } from '../../model/base/units';
import type { Arm, Parameters } from '../../net/types';
import { FEWEST_ARMS, MOST_ARMS } from '../../edit/tools/layouts/layouts';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { Slider } from '../parts/slider';
import { Switch } from '../parts/switch';
import '../../styles/layouts.css';
import { TEXTS } from '../../texts/panels/layouts';
import { inSentence } from '../../texts/language';

/** The rows of the panel, in order; `whole` ones are counts. */
interface ParameterLine {
  readonly label: string;
  readonly unit: string;
  readonly step: number;
}
const LINES: Readonly<Record<string, ParameterLine>> = {
  length_m: { label: TEXTS.length, unit: 'm', step: 10 },
  bend_deg: { label: TEXTS.bend, unit: '°', step: 5 },
  radius_m: { label: TEXTS.radius, unit: 'm', step: 5 },
  lanes: { label: TEXTS.lanes, unit: '', step: 1 },
  lanes_forward: { label: TEXTS.lanesForward, unit: '', step: 1 },
  lanes_backward: { label: TEXTS.lanesBack, unit: '', step: 1 },
  island_radius_m: { label: TEXTS.island, unit: 'm', step: 1 },
  ring_lanes: { label: TEXTS.ringLanes, unit: '', step: 1 },
  ring_lane_width_m: { label: TEXTS.ringLaneWidth, unit: 'm', step: 0.25 },
  ring_speed_limit_kmh: { label: TEXTS.ringSpeedLimit, unit: 'km/h', step: 5 },
  parallel_m: { label: TEXTS.parallelLength, unit: 'm', step: 10 },
  ramp_angle_deg: { label: TEXTS.rampAngle, unit: '°', step: 1 },
  ramp_speed_limit_kmh: { label: TEXTS.rampSpeedLimit, unit: 'km/h', step: 10 },
  aisles: { label: TEXTS.aisles, unit: '', step: 1 },
  bays: { label: TEXTS.baysPerSide, unit: '', step: 1 },
  bay_width_m: { label: TEXTS.bayWidth, unit: 'm', step: 0.1 },
  bay_length_m: { label: TEXTS.bayLength, unit: 'm', step: 0.1 },
  aisle_m: { label: TEXTS.aisleWidth, unit: 'm', step: 0.25 },
  speed_limit_kmh: { label: TEXTS.speedLimit, unit: 'km/h', step: 10 },
  cycle_lane_m: { label: TEXTS.cycleLane, unit: 'm', step: 0.1 },
  parking_m: { label: TEXTS.parking, unit: 'm', step: 0.1 },
  median_m: { label: TEXTS.median, unit: 'm', step: 0.5 },
  crosswalk_m: { label: TEXTS.crosswalk, unit: 'm', step: 0.5 },
  kerb_radius_m: { label: TEXTS.kerbRadius, unit: 'm', step: 0.5 },
  lane_width_m: { label: TEXTS.laneWidth, unit: 'm', step: 0.25 },
  sidewalk_m: { label: TEXTS.pavement, unit: 'm', step: 0.5 },
};
const SWITCHES: Readonly<Record<string, string>> = {
  on_ramp: TEXTS.rampJoins,
  off_ramp: TEXTS.rampLeaves,
  speed_bumps: TEXTS.speedBumps,
};
/** Values found by trial: draggable, and typed. */
const DRAGGED: ReadonlySet<string> = new Set(['kerb_radius_m', 'lane_width_m']);
/** Default widths of switchable elements. */
const USUAL: Readonly<Record<string, number>> = { cycle_lane_m: 1.8, crosswalk_m: 3, median_m: 2, parking_m: 2.3 };

export default function LayoutPanel() {
  const { maker, layouts } = useApp();
  const wish = layouts.wish.value;
  const parameters = layouts.parameters.value;
  if (!wish) return null;
  const title = layouts.isNew.value ? TEXTS.newMap : TEXTS.changeTheMap;
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name="road" size={20} />
        </div>
        <div class="grow">
          <h2>{title}</h2>
          <p>
            {[
              wish.template.endsWith('-arms') && parameters?.arms
                ? TEXTS.arms(parameters.arms.length)
                : inSentence(TEMPLATE_TITLES[wish.template]),
              parameters?.control && inSentence(CONTROL_WORDS[parameters.control]),
            ]
              .filter(Boolean)
              .join(', ')}
          </p>
        </div>
      </div>
      <div class="layouts">
        {parameters?.arms ? <ArmSection arms={parameters.arms} /> : null}
        {parameters ? <Whole parameters={parameters} /> : null}
        <Checks />
      </div>
      <div class="layouts-foot">
        <ActionButton id="use-map" class="pri" icon="" withKey>
          {TEXTS.useThisMap}
        </ActionButton>
        <button type="button" class="btn line" onClick={() => maker.leave()}>
          {TEXTS.cancel}
        </button>
      </div>
    </>
  );
}

function Row({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class="line">
      <span>{label}</span>
      {children}
    </div>
  );
}

interface NumberRowProps {
  place: string;
  name: string;
  value: () => number;
  set: (v: number) => void;
}

function NumberRow({ place, name, value, set }: NumberRowProps) {
  const { editor, layouts } = useApp();
  const { speedUnit } = editor.view;
  const { label, unit, step } = LINES[name];
  const template = layouts.wish.value!.template;
  const whole = Number.isInteger(step) && !unit;
  const digits = whole ? 0 : step < 1 ? 2 : 0;
  if (unit === 'km/h')
    return (
      <Row label={label}>
        <NumberField
          label={label}
          field={`layout-${place}`}
          unit={() => speedUnit.value}
          quantity={() => speedUnit.value}
          step={speedUnit.value === 'km/h' ? step : 5}
          value={() => toUnit(value() / 3.6, speedUnit.value)}
          text={() => speedText(value() / 3.6, speedUnit.value)}
          set={(v) => set(Number((fromUnit(v, speedUnit.peek()) * 3.6).toFixed(6)))}
          range={() => {
            const [min, max] = rangeOf(template, place);
            return [toUnit(min / 3.6, speedUnit.value), toUnit(max / 3.6, speedUnit.value)];
          }}
        />
      </Row>
    );
  const told = unit === 'm' ? toLength : (v: number) => v;
  const text = () => num(told(value()), Number.isInteger(told(value())) ? 0 : lengthUnit() === 'm' ? digits || 1 : 1);
  const range = rangeOf(template, place);
  return (
    <Row label={label}>
      {DRAGGED.has(name) ? (
        <Slider label={label} value={value()} range={range} step={step} text={`${text()} ${lengthUnit()}`} set={set} />
      ) : null}
      <NumberField
        label={label}
        field={`layout-${place}`}
        unit={() => (unit === 'm' ? lengthUnit() : unit)}
        quantity={() => (unit === 'm' ? 'length' : unit ? 'angle' : 'count')}
        step={step}
        value={value}
        text={text}
        set={(v) => set(whole ? Math.round(v) : v)}
        range={() => range}
      />
    </Row>
  );
}

function ArmSection({ arms }: { arms: readonly Arm[] }) {
  const { layouts } = useApp();
  const index = Math.min(layouts.arm.value, arms.length - 1);
  const arm = arms[index];
  const set = (change: Partial<Arm>) => layouts.setArm(index, change);
  const now = (): Arm => layouts.arms.value[Math.min(layouts.arm.value, layouts.arms.value.length - 1)];
  const name = layouts.made.value?.arms[index]?.title ?? TEXTS.arm;
  const turned = layouts.turned.value;
  const number = (key: 'length_m' | 'speed_limit_kmh' | 'cycle_lane_m' | 'crosswalk_m' | 'median_m') => (
    <NumberRow
      key={key}
      place={`arms.${key}`}
      name={key}
      value={() => now()?.[key] ?? 0}
      set={(v) => set({ [key]: v })}
    />
  );
  const priority = layouts.parameters.value?.control === 'priority';
  return (
    <section class="sect" aria-label={TEXTS.armNamed(name)}>
      <h3>
        {TEXTS.armNamed(name)}
        <span class="grow" />
        <ActionButton id="arm-previous" iconOnly icon="prev" size={14} />
        <small>{TEXTS.of(index + 1, arms.length)}</small>
        <ActionButton id="arm-next" iconOnly icon="next" size={14} />
      </h3>
      <Row label={TEXTS.angle}>
        <NumberField
          label={TEXTS.angle}
          field="layout-arms.angle_deg"
          unit={() => '°'}
          quantity={() => 'angle'}
          step={1}
          value={() => now()?.angle_deg ?? 0}
          text={() => num(now()?.angle_deg ?? 0, Number.isInteger(now()?.angle_deg) ? 0 : 1)}
          set={(v) => set({ angle_deg: v })}
          range={() => [-360, 360]}
        />
        {turned?.index === index ? <small>{TEXTS.was(num(turned.before.angle_deg, 0))}</small> : null}
      </Row>
      <Row label={TEXTS.lanesIn}>
        <Count label={TEXTS.lanesIn} value={arm.lanes_in} set={(v) => set({ lanes_in: v })} />
        <span class="mut">{TEXTS.out}</span>
        <Count label={TEXTS.lanesOut} value={arm.lanes_out} set={(v) => set({ lanes_out: v })} />
      </Row>
      {layouts.wish.value?.template === 'roundabout' ? null : <TurnLanes index={index} arm={arm} />}
      <Connections arm={index} />
      {number('length_m')}
      {number('speed_limit_kmh')}
      {(['cycle_lane_m', 'crosswalk_m', 'median_m'] as const).map((key) =>
        arm[key] > 0 ? (
          <div key={key} class="with">
            {number(key)}
            <Switch label={LINES[key].label} on set={() => set({ [key]: 0 })} />
          </div>
        ) : (
          <Row key={key} label={LINES[key].label}>
            <Switch label={LINES[key].label} on={false} set={() => set({ [key]: USUAL[key] })} />
          </Row>
        ),
      )}
      {priority ? (
        <Row label={TEXTS.hasPriority}>
          <Switch label={TEXTS.hasPriority} on={arm.main} set={(main) => set({ main })} />
        </Row>
      ) : null}
      <div class="row">
        <button
          type="button"
          class="btn line"
          disabled={arms.length >= MOST_ARMS}
          onClick={() => layouts.addArm(layouts.widestGap())}
        >
          {TEXTS.addAnArm}
        </button>
        <button
          type="button"
          class="btn line"
          disabled={arms.length <= FEWEST_ARMS}
          onClick={() => layouts.removeArm(index)}
        >
          {TEXTS.removeIt}
        </button>
      </div>
    </section>
  );
}

function Count({ label, value, set }: { label: string; value: number; set: (v: number) => void }) {
  return (
    <span class="count" role="group" aria-label={label}>
      <button type="button" aria-label={TEXTS.oneFewer(label)} disabled={value <= 0} onClick={() => set(value - 1)}>
        −
      </button>
      <b>{value}</b>
      <button type="button" aria-label={TEXTS.oneMore(label)} disabled={value >= 5} onClick={() => set(value + 1)}>
        +
      </button>
    </span>
  );
}

const TURNS = ['left', 'straight', 'right'] as const;
const TURN_WORDS = TEXTS.turns;
const SIGNS = { left: '↰', straight: '↑', right: '↱' } as const;

/** Turns of each lane; a click on a sign adds or removes one. */
function TurnLanes({ index, arm }: { index: number; arm: Arm }) {
  const { layouts } = useApp();
  // Turns by the turn lanes, and by single connections.
  const said = arm.turns ?? layouts.made.value?.arms[index]?.turns ?? [];
  if (!said.length) return null;
  const there = (lane: number, turn: (typeof TURNS)[number]): boolean =>
    layouts.ways.value.some((w) => w.turn === turn && String(laneOf(w.from)) === String([index, lane]));
  const toggle = (lane: number, turn: (typeof TURNS)[number]) => {
    const is = there(lane, turn);
    layouts.setTurns(
      index,
      lane,
      said.map((t, i) => (i !== lane ? [...t] : TURNS.filter((x) => (x === turn ? !is : there(lane, x))))),
    );
  };
  return (
    <Row label={TEXTS.turnLanes}>
      <span class="turns">
        {said.map((_, lane) => (
          <span key={lane} role="group" aria-label={TEXTS.lane(lane + 1)}>
            {TURNS.map((turn) => (
              <button
                key={turn}
                type="button"
                aria-pressed={there(lane, turn)}
                aria-label={TEXTS.laneTurning(lane + 1, TURN_WORDS[turn])}
                class={there(lane, turn) ? 'on' : ''}
                onClick={() => toggle(lane, turn)}
              >
                {SIGNS[turn]}
              </button>
            ))}
          </span>
        ))}
      </span>
    </Row>
  );
}

/** Single ways of the selected arm: selected, removed, added; the same as on the picture. */
function Connections({ arm }: { arm: number }) {
  const { layouts } = useApp();
  const [lane, setLane] = useState(0);
  const [open, setOpen] = useState(false);
  const places = layouts.made.value?.arms ?? [];
  const ins = places[arm]?.ins_m.length ?? 0;
  if (!layouts.connects || !ins) return null;
  const own = layouts.ways.value.filter((w) => laneOf(w.from)[0] === arm);
  const from = Math.min(lane, ins - 1);
  const free = places.flatMap((place, to) =>
    place.outs_m.flatMap((_, out) => {
      const way = connectionOf([arm, from], [to, out]);
      return own.some((w) => sameWay(w, way)) ? [] : [{ way, name: layouts.exitName([to, out]) }];
    }),
  );
  const picking = own.some((w) => layouts.way.value && sameWay(w, layouts.way.value));
  const changed = [...layouts.connections.added, ...layouts.connections.removed].some((w) => laneOf(w.from)[0] === arm);
  return (
    <details class="ways" open={open || picking || changed} onToggle={(e) => setOpen(e.currentTarget.open)}>
      <summary>
        <span>{TEXTS.connections}</span>
        <small>{own.length}</small>
      </summary>
      <ul>
        {own.map((way) => {
          const words = TEXTS.laneTo(laneOf(way.from)[1] + 1, layouts.exitName(laneOf(way.to)));
          const picked = !!layouts.way.value && sameWay(way, layouts.way.value);
          return (
            <li key={way.lane} class={picked ? 'on' : ''}>
              <button
                type="button"
                aria-pressed={picked}
                onClick={() => layouts.pickWay(picked ? null : { from: way.from, to: way.to })}
                onPointerEnter={() => layouts.point({ kind: 'way', arm, way: { from: way.from, to: way.to } })}
                onPointerLeave={() => layouts.point(null)}
              >
                <i aria-hidden="true">{SIGNS[way.turn]}</i>
                {words}
              </button>
              <button type="button" class="x" aria-label={TEXTS.remove(words)} onClick={() => layouts.removeWay(way)}>
                <Icon name="x" size={14} />
              </button>
            </li>
          );
        })}
      </ul>
      {free.length ? (
        <div class="add">
          <select
            class="field pick"
            aria-label={TEXTS.fromLane}
            value={from}
            onChange={(e) => setLane(Number(e.currentTarget.value))}
          >
            {Array.from({ length: ins }, (_, i) => (
              <option key={i} value={i}>
                {TEXTS.lane(i + 1)}
              </option>
            ))}
          </select>
          <select
            class="field pick"
            aria-label={TEXTS.connectTo}
            value=""
            onChange={(e) => {
              const added = free.find(({ way }) => way.to === e.currentTarget.value)?.way;
              if (!added) return;
              layouts.addWay(added);
              layouts.pickWay(added);
            }}
          >
            <option value="">{TEXTS.connectToMore}</option>
            {free.map(({ way, name }) => (
              <option key={way.to} value={way.to}>
                {name}
              </option>
            ))}
          </select>
        </div>
      ) : null}
      {changed ? (
        <button type="button" class="btn line" onClick={() => layouts.set(layouts.usualWays(arm))}>
          {TEXTS.reset}
        </button>
      ) : null}
    </details>
  );
}

const CONTROL_WORDS = { signals: TEXTS.signals, priority: TEXTS.priority, equal: TEXTS.equal } as const;
const CONTROLS = Object.entries(CONTROL_WORDS) as readonly (readonly [keyof typeof CONTROL_WORDS, string])[];
const SIDES = [
  ['right-hand', TEXTS.rightHand],
  ['left-hand', TEXTS.leftHand],
] as const;

function Choice<T extends string>({
  label,
  items,
  value,
  set,
}: {
  label: string;
  items: readonly (readonly [T, string])[];
  value: T | undefined;
  set: (v: T) => void;
}) {
  return (
    <Row label={label}>
      <div class="seg" role="group" aria-label={label}>
        {items.map(([id, text]) => (
          <button
            key={id}
            type="button"
            class={`btn ${id === value ? 'on' : ''}`}
            aria-pressed={id === value}
            onClick={() => set(id)}
          >
            {text}
          </button>
        ))}
      </div>
    </Row>
  );
}

function Whole({ parameters }: { parameters: Parameters }) {
  const { layouts } = useApp();
  const keys = Object.keys(LINES).filter((k) => k in parameters);
  const now = (key: string): number =>
    ((layouts.parameters.value as Record<string, unknown> | null)?.[key] as number | undefined) ?? 0;
  const switches = Object.keys(SWITCHES).filter((k) => k in parameters) as (keyof Parameters)[];
  return (
    <section class="sect">
      <h3>{parameters.arms ? TEXTS.junction : TEXTS.road}</h3>
      {parameters.control ? (
        <Choice
          label={TEXTS.rightOfWay}
          items={CONTROLS}
          value={parameters.control}
          set={(control) => layouts.set({ control })}
        />
      ) : null}
      {keys.map((key) => (
        <Fragment key={key}>
          <NumberRow place={key} name={key} value={() => now(key)} set={(v) => layouts.set({ [key]: v })} />
          {key === 'kerb_radius_m' ? <Tightest asked_m={now(key)} /> : null}
        </Fragment>
      ))}
      {switches.map((key) => (
        <Row key={key} label={SWITCHES[key]}>
          <Switch label={SWITCHES[key]} on={!!parameters[key]} set={(on) => layouts.set({ [key]: on })} />
        </Row>
      ))}
      <Choice
        label={TEXTS.traffic}
        items={SIDES}
        value={parameters.traffic}
        set={(traffic) => layouts.set({ traffic })}
      />
    </section>
  );
}

/** A corner that is drawn with a smaller radius than requested. */
function Tightest({ asked_m }: { asked_m: number }) {
  const made = useApp().layouts.made.value;
  const [least] = [...(made?.corners ?? [])].sort((a, b) => a.radius_m - b.radius_m);
  if (!made || !least || least.radius_m > asked_m - 0.05) return null;
  const [a, b] = least.arms.map((arm) => made.arms[arm].title);
  return <p class="mut short">{TEXTS.tighterCorner(`${num(toLength(least.radius_m), 1)} ${lengthUnit()}`, a, b)}</p>;
}

function Checks() {
  const { stage, layouts } = useApp();
  const made = layouts.made.value;
  const fault = layouts.fault.value;
  const failed = made?.checks.filter((c) => !c.passed) ?? [];
  const sentences = withArms(SENTENCES, made?.arms ?? []);
  return (
    <section class="sect last" aria-label={TEXTS.checks}>
      <h3>{TEXTS.checks}</h3>
      <ul class="checks">
        {fault ? <li class="bad">{fault}</li> : null}
        {made?.checks.map((c) => (
          <li key={c.text} class={c.passed ? 'ok' : 'bad'}>
            {c.at_m ? (
              <button
                type="button"
                onClick={() => {
                  const [x, y] = c.at_m!;
                  stage.glide.by((v) => v.centre(x, y));
                }}
              >
                <b>{failed.indexOf(c) + 1}</b> {messageText(c.message, c.text, sentences)}
              </button>
            ) : (
              messageText(c.message, c.text, sentences)
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
