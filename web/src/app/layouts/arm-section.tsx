// The selected arm of a map being made: its numbers, turn lanes and single connections.
import { useState } from 'preact/hooks';
import { connectionOf, laneOf, sameWay } from '../../model/document/layouts';
import { num } from '../../model/base/units';
import type { Arm } from '../../net/types';
import { FEWEST_ARMS, MOST_ARMS } from '../../edit/tools/layouts/layouts';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { Switch } from '../parts/switch';
import { TEXTS } from '../../texts/panels/layouts';
import { Count, LINES, NumberRow, Row } from './rows';

/** Default widths of switchable elements. */
const USUAL: Readonly<Record<string, number>> = { cycle_lane_m: 1.8, crosswalk_m: 3, median_m: 2, parking_m: 2.3 };

export function ArmSection({ arms }: { arms: readonly Arm[] }) {
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
