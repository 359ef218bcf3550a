// The picked part of the map in the inspector: a signal with its phases, a lane with its limit and its users, a
// crosswalk or a stop sign with who goes first.
import { num, speedInUse } from '../../model/base/units';
import type { Lane } from '../../model/document/lanemap';
import { hasSignals } from '../../model/physics/signals';
import { placeOfItem } from '../../edit/gestures/on-the-map';
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
  const lane = item.kind === 'lane' ? scene.map.lanes.get(item.lane) : undefined;
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
      {lane ? <LaneRows lane={lane} /> : null}
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

function LaneRows({ lane: { limit, kind, type } }: { lane: Lane }) {
  const who =
    kind === 'bike'
      ? TEXTS.users.bike
      : type === 'bus_lane'
        ? TEXTS.users.bus
        : type === 'freeway'
          ? TEXTS.users.motorAlone
          : TEXTS.users.motor;
  return (
    <section class="sect last">
      <Line label={TEXTS.speedLimit} value={limit === null ? TEXTS.notGiven : speedInUse(limit, false)} />
      <Line label={TEXTS.whoMayUseIt} value={who} />
    </section>
  );
}

function Line({ label, value }: { label: string; value: string }) {
  return (
    <div class="kindrow">
      <span class="sec grow">{label}</span>
      <b>{value}</b>
    </div>
  );
}

function Priority({ words }: { words: string }) {
  return (
    <section class="sect last">
      <h3>{TEXTS.priority}</h3>
      <p>{words}</p>
    </section>
  );
}
