// The inspector without a selection: road users, events, contents of the map.
import { useComputed } from '@preact/signals';
import type { Agent, Scene } from '../../model/document/scene';
import { drivingSide } from '../../model/physics/driving-side';
import { metres, num } from '../../model/base/units';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Later } from '../later';
import { EventList } from './event-list';
import { SceneScore } from './scene-score';
import { TEXTS } from '../../texts/panels/inspector';

const FIRST_EVENTS = 6;

export function ScenePanel() {
  const { editor } = useApp();
  // Counts are updated when road users are added or removed, not during a drag.
  void useComputed(() => editor.resting.value?.castKey).value;
  const scene = editor.scene.peek();
  return scene ? <About scene={scene} /> : <Nothing />;
}

function Head({ note }: { note: string }) {
  return (
    <div class="ih">
      <div class="ag t-ink">
        <Icon name="layers" size={20} />
      </div>
      <div class="grow">
        <h2>{TEXTS.scene}</h2>
        <p>{note}</p>
      </div>
    </div>
  );
}

function Nothing() {
  return (
    <>
      <Head note={TEXTS.opensWithThe} />
      <div class="sect last">
        <p class="sec">{TEXTS.whatThisPanelLists}</p>
      </div>
    </>
  );
}

function About({ scene }: { scene: Scene }) {
  const { editor, form } = useApp();
  const some = useComputed(() => editor.reading.events.value.length > 0).value;
  const span = useComputed(() => TEXTS.nextS(num(editor.resting.value?.duration ?? 0, 0)));
  return (
    <>
      <Head note={scene.agents.size ? TEXTS.nothingSelected : TEXTS.noRoadUsersYet} />
      <section class="sect">
        <h3>
          {TEXTS.inThisScene}
          <small>{TEXTS.roadUsers(scene.agents.size)}</small>
        </h3>
        {scene.agents.size ? null : <Ways />}
        {kinds(scene).map(([icon, label, n, colour]) => (
          <div key={label} class="kindrow">
            <span class={`t-${colour}`}>
              <Icon name={icon} />
            </span>
            <span class="sec">{label}</span>
            <span class="grow" />
            <b>{n}</b>
          </div>
        ))}
      </section>
      <section class="sect">
        <h3>
          {TEXTS.events}
          <small>{span}</small>
        </h3>
        <EventList most={FIRST_EVENTS} />
        {some ? <ActionButton id="what-counts" class="counts" icon="" /> : null}
      </section>
      <SceneScore />
      {form.sheet.value ? (
        <section class="sect">
          <h3>{TEXTS.futures}</h3>
          <Later part="generate options" />
        </section>
      ) : null}
      <section class="sect last lines">
        <h3>{TEXTS.map}</h3>
        {mapLines(scene).map((l) => (
          <p key={l}>{l}</p>
        ))}
      </section>
    </>
  );
}

/** The suggestions of the picture, for when they were closed there. */
function Ways() {
  return (
    <div class="offers">
      {['place-first', 'tool-fill', 'import-log'].map((id) => (
        <ActionButton key={id} id={id} class="line" size={15} />
      ))}
    </div>
  );
}

type KindRow = [icon: string, label: string, count: number, colour: string];

function kinds(scene: Scene): KindRow[] {
  const agents = [...scene.agents.values()];
  const n = (f: (a: Agent) => boolean): number => agents.filter(f).length;
  const rows: KindRow[] = [
    ['car', TEXTS.carsMoving, n((a) => a.kind === 'car' && !a.parked), 'vehicle'],
    ['car', TEXTS.carsParked, n((a) => a.parked), 'parked'],
    ['truck', TEXTS.trucksAndBuses, n((a) => (a.kind === 'truck' || a.kind === 'bus') && !a.parked), 'vehicle'],
    ['motorcycle', TEXTS.motorcycles, n((a) => a.kind === 'motorcycle' && !a.parked), 'vehicle'],
    ['cyclist', TEXTS.cyclists, n((a) => a.kind === 'cyclist'), 'cyclist'],
    ['pedestrian', TEXTS.pedestrians, n((a) => a.kind === 'pedestrian'), 'pedestrian'],
    ['other', TEXTS.otherObjects, n((a) => a.kind === 'other'), 'other'],
  ];
  return rows.filter(([, , count]) => count > 0);
}

function mapLines({ map, signals, licence }: Scene): string[] {
  const lanes = [...map.lanes.values()];
  const n = (kind: string): number => lanes.filter((l) => l.kind === kind).length;
  const { x0, x1, y0, y1 } = map.box;
  const parts = [
    TEXTS.lanes(n('road')),
    map.crosswalks.length ? TEXTS.crosswalks(map.crosswalks.length) : '',
    n('bike') ? TEXTS.bikeLanes(n('bike')) : '',
  ];
  const control = signals.length ? TEXTS.signals : map.stopSigns.length ? TEXTS.stopSigns : TEXTS.noSignals;
  return [
    parts.filter(Boolean).join(' · '),
    `${metres(x1 - x0, 0)} × ${metres(y1 - y0, 0)} · ${control}`,
    ...(drivingSide(map) === 'left-hand' ? [TEXTS.leftHandTraffic] : []),
    ...(licence ? [TEXTS.licence(licence)] : []),
  ];
}
