// The inspector with nothing selected: who is here, what happens, what the map holds.
import { useComputed } from '@preact/signals';
import { actionOf } from '../../actions/registry';
import type { Agent, Scene } from '../../model/scene';
import { num } from '../../model/units';
import { useApp } from '../parts/app-context';
import { ActionButton, Segments } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Controls } from '../parts/asking';
import { OTHERS } from '../parts/others';
import { EventList } from './event-list';
import { SceneScore } from './scene-score';

const FIRST_EVENTS = 6;

export function ScenePanel() {
  const { editor } = useApp();
  // Who comes or goes is counted anew; who is dragged is not.
  void useComputed(() => editor.resting.value?.roster).value;
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
        <h2>Scene</h2>
        <p>{note}</p>
      </div>
    </div>
  );
}

function Nothing() {
  return (
    <>
      <Head note="Opens with the first scene" />
      <div class="sect last">
        <p class="sec">
          Here you will see who is in the scene and, for a selected road user, its start, its goal and its six futures.
        </p>
      </div>
    </>
  );
}

function About({ scene }: { scene: Scene }) {
  const { editor, form } = useApp();
  const others = useComputed(() => `${actionOf(`others-${editor.resting.value?.others ?? 'react'}`).help}.`);
  return (
    <>
      <Head note={scene.agents.size ? 'Nothing selected' : 'Nobody is here yet'} />
      <section class="sect">
        <h3>
          In this scene
          <small>{scene.agents.size} road users</small>
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
          Events
          <small>next {num(scene.duration, 0)} s</small>
        </h3>
        <EventList most={FIRST_EVENTS} />
      </section>
      <SceneScore />
      {form.sheet.value ? (
        <section class="sect">
          <h3>Futures</h3>
          <div class="row asking">
            <Controls />
          </div>
        </section>
      ) : null}
      <section class="sect">
        <h3>Others</h3>
        <Segments label="What the others do" items={OTHERS} />
        <p class="note">{others}</p>
      </section>
      <section class="sect last lines">
        <h3>Map</h3>
        {mapLines(scene).map((l) => (
          <p key={l}>{l}</p>
        ))}
      </section>
    </>
  );
}

/** The same ways out as on the picture, for when that was closed. */
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
    ['car', 'Cars, moving', n((a) => a.kind === 'car' && !a.parked), 'vehicle'],
    ['car', 'Cars, parked', n((a) => a.parked), 'parked'],
    ['truck', 'Trucks and buses', n((a) => (a.kind === 'truck' || a.kind === 'bus') && !a.parked), 'vehicle'],
    ['motorcycle', 'Motorcycles', n((a) => a.kind === 'motorcycle' && !a.parked), 'vehicle'],
    ['cyclist', 'Cyclists', n((a) => a.kind === 'cyclist'), 'cyclist'],
    ['pedestrian', 'Pedestrians', n((a) => a.kind === 'pedestrian'), 'pedestrian'],
    ['other', 'Other objects', n((a) => a.kind === 'other'), 'other'],
  ];
  return rows.filter(([, , count]) => count > 0);
}

function mapLines({ map, signals, licence }: Scene): string[] {
  const lanes = [...map.lanes.values()];
  const n = (kind: string): number => lanes.filter((l) => l.kind === kind).length;
  const { x0, x1, y0, y1 } = map.box;
  const parts = [
    `${n('road')} lanes`,
    map.crosswalks.length ? `${map.crosswalks.length} crosswalks` : '',
    n('bike') ? `${n('bike')} bike lanes` : '',
  ];
  const control = signals.length ? 'signals' : map.stopSigns.length ? 'stop signs' : 'no signals';
  return [
    parts.filter(Boolean).join(' · '),
    `${num(x1 - x0, 0)} m × ${num(y1 - y0, 0)} m · ${control}`,
    ...(licence ? [`Licence: ${licence}`] : []),
  ];
}
