// The picked part of the map in the inspector: a signal with its phases, a lane with its limit and its users, a
// crosswalk or a stop sign with who goes first.
import { useComputed } from '@preact/signals';
import { fromUnit, num, speedInUse, speedText, toUnit } from '../../model/base/units';
import { ruleOf } from '../../model/document/lanemap';
import type { LaneRule } from '../../model/document/scene-json';
import { hasSignals } from '../../model/physics/signals';
import { placeOfItem } from '../../edit/gestures/on-the-map';
import { setLaneRule } from '../../edit/tools/map-items/lane-rule';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { capitalised } from '../../texts/language';
import { TEXTS } from '../../texts/panels/map-item';

const ICONS = { signal: 'clock', 'stop-sign': 'mark-rule', crosswalk: 'pedestrian', lane: 'road' } as const;

export default function MapItemPanel() {
  const { editor } = useApp();
  const item = editor.mapItem.value;
  const scene = editor.resting.value;
  if (!item || !scene) return null;
  const lane = item.kind === 'lane' && scene.map.lanes.has(item.lane) ? item.lane : null;
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name={ICONS[item.kind]} size={20} />
        </div>
        <div class="grow">
          <h2>{TEXTS.kinds[item.kind]}</h2>
          <p>{capitalised(placeOfItem(scene, item))}</p>
        </div>
        <button
          type="button"
          class="btn i"
          aria-label={TEXTS.close}
          title={TEXTS.close}
          onClick={() => editor.pickOnMap(null)}
        >
          <Icon name="x" size={16} />
        </button>
      </div>
      {item.kind === 'signal' ? <Phases /> : null}
      {lane ? <LaneRows key={lane} id={lane} place={placeOfItem(scene, item)} /> : null}
      {item.kind === 'crosswalk' ? (
        <Priority words={hasSignals(scene, item.index) ? TEXTS.bySignals : TEXTS.pedestriansFirst} />
      ) : null}
      {item.kind === 'stop-sign' ? <Priority words={TEXTS.everyoneStops} /> : null}
    </>
  );
}

function Phases() {
  const { editor, signalEdges } = useApp();
  const phases = signalEdges.phases.value;
  const duration = () => editor.resting.value?.duration ?? 0;
  const now = editor.playhead.time.value;
  const here = phases.findLast((p) => p.from < now - 1e-6);
  const free = here !== undefined && phases.every((p) => Math.abs(p.from - now) > 0.05);
  return (
    <section class="sect last phaselist" aria-label={TEXTS.phases}>
      <h3>
        {TEXTS.phases}
        <small>{TEXTS.group(signalEdges.lanes.value.length)}</small>
      </h3>
      {phases.map(({ light }, i) => (
        <div key={i} class="kindrow">
          <span class={`light ${light}`} />
          <span class="sec grow">{TEXTS.lights[light]}</span>
          {i ? (
            <>
              <NumberField
                label={TEXTS.beginOf(TEXTS.lights[light])}
                field="phase"
                unit={() => 's'}
                quantity={() => 'time'}
                step={0.1}
                range={() => [0, duration()]}
                value={() => signalEdges.phases.value[i]?.from ?? null}
                text={() => num(signalEdges.phases.value[i]?.from ?? 0, 1)}
                set={(t) => signalEdges.set(i, t)}
              />
              <button
                type="button"
                class="btn i"
                aria-label={TEXTS.remove(TEXTS.lights[light])}
                title={TEXTS.remove(TEXTS.lights[light])}
                onClick={() => signalEdges.remove(i)}
              >
                <Icon name="x" size={14} />
              </button>
            </>
          ) : (
            <b>{TEXTS.from(num(0, 1))}</b>
          )}
        </div>
      ))}
      {here && free ? (
        <button type="button" class="opt" onClick={() => signalEdges.add(now)}>
          <Icon name="plus" size={15} />
          {TEXTS.add(TEXTS.lights[signalEdges.after(here.light)], num(now, 1))}
        </button>
      ) : null}
      <p class="sec">{TEXTS.howToAdd}</p>
    </section>
  );
}

/** Types of lanes to choose from; any other type is one for motor vehicles. */
const USERS = {
  surface_street: TEXTS.users.motor,
  freeway: TEXTS.users.motorAlone,
  bus_lane: TEXTS.users.bus,
  bike_lane: TEXTS.users.bike,
} as const;
type ChosenType = keyof typeof USERS;

const isChosenType = (type: string): type is ChosenType => Object.hasOwn(USERS, type);
const chosenType = (type: string): ChosenType => (isChosenType(type) ? type : 'surface_street');

/** Limits that can be typed, m/s. */
const LIMITS_MPS = [5 / 3.6, 200 / 3.6] as const;

function LaneRows({ id, place }: { id: string; place: string }) {
  const { editor } = useApp();
  const lane = useComputed(() => editor.resting.value!.map.lanes.get(id)!);
  const { limit, type } = lane.value;
  const was = ruleOf(lane.value);
  const unit = () => editor.view.speedUnit.value;
  const set = (rule: Partial<LaneRule>, name: string) => {
    const now = { speed_limit_mps: lane.peek().limit, type: lane.peek().type };
    editor.commits.run(setLaneRule(editor.resting.peek()!, lane.peek(), { ...now, ...rule }, name));
  };
  const choose = (chosen: ChosenType) => {
    const to = chosenType(was.type) === chosen ? was.type : chosen;
    set({ type: to }, TEXTS.usersChanged(place));
  };
  return (
    <section class="sect last lanerules">
      <div class="pr">
        <span class="lab">{TEXTS.speedLimit}</span>
        <NumberField
          label={TEXTS.speedLimit}
          field="lane-limit"
          unit={unit}
          quantity={unit}
          step={unit() === 'km/h' ? 10 : 5}
          range={() => [Math.ceil(toUnit(LIMITS_MPS[0], unit())), Math.floor(toUnit(LIMITS_MPS[1], unit()))]}
          value={() => {
            const mps = lane.value.limit;
            return mps === null ? null : toUnit(mps, unit());
          }}
          text={() => {
            const mps = lane.value.limit;
            return mps === null ? '' : speedText(mps, unit());
          }}
          set={(v) => set({ speed_limit_mps: fromUnit(v, unit()) }, TEXTS.limitChanged(place))}
        />
        <Former
          is={was.speed_limit_mps === limit}
          words={was.speed_limit_mps === null ? TEXTS.notGiven : speedInUse(was.speed_limit_mps, false)}
        />
      </div>
      <div class="pr">
        <span class="lab">{TEXTS.whoMayUseIt}</span>
        <select
          class="field pick"
          aria-label={TEXTS.whoMayUseIt}
          data-field="lane-users"
          value={chosenType(type)}
          onChange={(e) => choose(e.currentTarget.value as ChosenType)}
        >
          {Object.entries(USERS).map(([of, words]) => (
            <option key={of} value={of}>
              {words}
            </option>
          ))}
        </select>
        <Former is={was.type === type} words={USERS[chosenType(was.type)]} />
      </div>
    </section>
  );
}

/** What the map has, where the scene has another rule. */
const Former = ({ is, words }: { is: boolean; words: string }) => (is ? null : <small>{TEXTS.inTheMap(words)}</small>);

function Priority({ words }: { words: string }) {
  return (
    <section class="sect last">
      <h3>{TEXTS.priority}</h3>
      <p>{words}</p>
    </section>
  );
}
