// The kinds of file that the server writes and reads, by what people want of them, in plain words.
import type { FormatInfo } from '../../net/types';

/** What a file out of here is for. */
export type Wish = 'again' | 'simulate' | 'table' | 'show' | 'train' | 'more';

export const WISHES: readonly (readonly [Wish, string])[] = [
  ['again', 'Go on with it here'],
  ['simulate', 'Test in a simulator'],
  ['table', 'Look into it: tables and maps'],
  ['show', 'Show to a colleague'],
  ['train', 'Train a model'],
  ['more', 'More'],
];

export interface OutFormat {
  readonly id: string;
  readonly wish: Wish;
  readonly label: string;
  readonly icon: string;
  /** One plain sentence: what it is good for. */
  readonly says: string;
}

const OUT: readonly OutFormat[] = [
  {
    id: 'dragtraffic',
    wish: 'again',
    label: 'Saved scene',
    icon: 'layers',
    says: 'Everything that is in it. Opens here as it is now.',
  },
  {
    id: 'openscenario',
    wish: 'simulate',
    label: 'Simulator scenario',
    icon: 'car',
    says: 'Road and road users, for esmini, CARLA and others that play OpenSCENARIO.',
  },
  {
    id: 'opendrive',
    wish: 'simulate',
    label: 'Road alone',
    icon: 'road',
    says: 'The lanes as OpenDRIVE, for simulators and map tools.',
  },
  {
    id: 'commonroad',
    wish: 'simulate',
    label: 'CommonRoad scenario',
    icon: 'file',
    says: 'A task for motion planners: one drives, the others are in its way.',
  },
  {
    id: 'sumo',
    wish: 'simulate',
    label: 'SUMO scenario',
    icon: 'car',
    says: 'Road, trips and the recording in one zip that SUMO runs.',
  },
  {
    id: 'sumo-net',
    wish: 'simulate',
    label: 'SUMO road alone',
    icon: 'road',
    says: 'The lanes, links and lights as a network of SUMO.',
  },
  {
    id: 'sumo-fcd',
    wish: 'simulate',
    label: 'SUMO recording alone',
    icon: 'table',
    says: 'Where everybody is at each step, as SUMO itself writes it.',
  },
  {
    id: 'csv',
    wish: 'table',
    label: 'Table',
    icon: 'table',
    says: 'A row for each road user and step, for Excel and others.',
  },
  {
    id: 'parquet',
    wish: 'table',
    label: 'Table, compact',
    icon: 'table',
    says: 'The same rows for pandas, R and DuckDB: smaller and quicker.',
  },
  {
    id: 'geojson',
    wish: 'table',
    label: 'Map layers',
    icon: 'layers',
    says: 'Lanes and ways as lines, for QGIS and web maps.',
  },
  {
    id: 'mcap',
    wish: 'table',
    label: 'Foxglove log',
    icon: 'film',
    says: 'To step through in Foxglove, beside logs of a car.',
  },
  {
    id: 'html',
    wish: 'show',
    label: 'Page that plays',
    icon: 'play',
    says: 'Plays in any browser, with nothing to install. Can be sent by mail.',
  },
  {
    id: 'womd',
    wish: 'train',
    label: 'Scenario record',
    icon: 'file',
    says: 'As in the Waymo Open Motion Dataset.',
  },
  {
    id: 'womd-example',
    wish: 'train',
    label: 'Scenario as tf.Example',
    icon: 'file',
    says: 'The flat form of the same dataset, for TensorFlow and Waymax.',
  },
  {
    id: 'sim-agents',
    wish: 'train',
    label: 'Sim Agents submission',
    icon: 'file',
    says: 'Futures of everybody as the Waymo challenge takes them.',
  },
  {
    id: 'scenarionet',
    wish: 'train',
    label: 'ScenarioNet',
    icon: 'file',
    says: 'For MetaDrive and what else reads ScenarioNet.',
  },
  {
    id: 'av2',
    wish: 'train',
    label: 'Argoverse 2 scenario',
    icon: 'file',
    says: 'Motion as in Argoverse 2, without its map.',
  },
  {
    id: 'gpudrive',
    wish: 'train',
    label: 'GPUDrive',
    icon: 'file',
    says: 'For training many worlds at once on a graphics card.',
  },
  {
    id: 'nocturne',
    wish: 'train',
    label: 'Nocturne',
    icon: 'file',
    says: 'For agents that see only what they could see.',
  },
];

/** A format without words here still goes out, under the name that the server gives it. */
const plain = ({ id, name }: FormatInfo): OutFormat => ({ id, wish: 'more', label: name, icon: 'file', says: '' });

/** What the server writes, in the order of the wishes; each with its ending and the name under which others know it. */
export function outFormats(known: readonly FormatInfo[]): (OutFormat & { ending: string; name: string })[] {
  const written = known.filter((f) => f.export);
  const worded = OUT.filter((o) => written.some((f) => f.id === o.id));
  const others = written.filter((f) => !OUT.some((o) => o.id === f.id)).map(plain);
  return [...worded, ...others].map((o) => {
    const f = written.find(({ id }) => id === o.id)!;
    return { ...o, ending: `.${o.id === 'dragtraffic' ? 'json' : f.extensions[0]}`, name: f.name };
  });
}

/** A kind of file that can be brought in. */
export interface InKind {
  readonly label: string;
  readonly icon: string;
  readonly says: string;
  readonly formats: readonly string[];
}

const IN: readonly InKind[] = [
  {
    label: 'Saved scenes',
    icon: 'layers',
    says: 'As they were saved here, also on another computer.',
    formats: ['dragtraffic'],
  },
  {
    label: 'Recorded traffic',
    icon: 'film',
    says: 'Scenarios of data sets, with their road. Drop an Argoverse scenario and its map together.',
    formats: ['womd', 'av2', 'scenarionet', 'commonroad', 'gpudrive', 'nocturne'],
  },
  {
    label: 'Simulated traffic',
    icon: 'car',
    says: 'What SUMO writes of who drove where. Drop it together with its network.',
    formats: ['sumo-fcd'],
  },
  {
    label: 'Tables of motion',
    icon: 'table',
    says: 'A row for each road user and moment. The columns may have any names: you say what they are.',
    formats: ['csv', 'parquet'],
  },
  {
    label: 'Maps alone',
    icon: 'road',
    says: 'The road of a scene. You put road users on it, or traffic all over it.',
    formats: ['opendrive', 'lanelet2', 'sumo-net', 'osm'],
  },
];

/** What the server reads, by kind; a format without words here stands at the end. */
export function inKinds(known: readonly FormatInfo[]): (InKind & { files: readonly FormatInfo[] })[] {
  const read = known.filter((f) => f.import);
  const kinds = IN.map((k) => ({ ...k, files: k.formats.flatMap((id) => read.find((f) => f.id === id) ?? []) }));
  const others = read.filter((f) => !IN.some((k) => k.formats.includes(f.id)));
  const more = { label: 'More', icon: 'file', says: '', formats: others.map((f) => f.id), files: others };
  return [...kinds, more].filter((k) => k.files.length);
}
