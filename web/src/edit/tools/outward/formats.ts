// File formats that the server writes and reads, by purpose, in plain words.
import type { FormatInfo } from '../../../net/types';
import { TEXTS } from '../../../texts/files/formats';

/** Purpose of an exported file. */
export type ExportPurpose = 'again' | 'simulate' | 'table' | 'show' | 'train' | 'more';

export const WISHES: readonly (readonly [ExportPurpose, string])[] = [
  ['again', TEXTS.keepEditing],
  ['simulate', TEXTS.testInASimulator],
  ['table', TEXTS.analyse],
  ['show', TEXTS.showToOthers],
  ['train', TEXTS.trainAModel],
  ['more', TEXTS.more],
];

export interface OutFormat {
  readonly id: string;
  readonly wish: ExportPurpose;
  readonly label: string;
  readonly icon: string;
  /** One plain sentence about its use. */
  readonly says: string;
  /** Other search words for it. */
  readonly sought?: string;
}

const OUT: readonly OutFormat[] = [
  {
    id: 'dragtraffic',
    wish: 'again',
    label: TEXTS.savedScene,
    icon: 'layers',
    says: TEXTS.theCompleteScene,
  },
  {
    id: 'openscenario',
    wish: 'simulate',
    label: TEXTS.simulatorScenario,
    icon: 'car',
    says: TEXTS.roadAndRoadUsers,
  },
  {
    id: 'opendrive',
    wish: 'simulate',
    label: TEXTS.roadOnly,
    icon: 'road',
    says: TEXTS.theLanesAsOpendrive,
  },
  {
    id: 'commonroad',
    wish: 'simulate',
    label: TEXTS.commonroadScenario,
    icon: 'file',
    says: TEXTS.aPlanningProblem,
  },
  {
    id: 'sumo',
    wish: 'simulate',
    label: TEXTS.sumoScenario,
    icon: 'car',
    says: TEXTS.roadTripsAnd,
  },
  {
    id: 'sumo-net',
    wish: 'simulate',
    label: TEXTS.sumoRoadOnly,
    icon: 'road',
    says: TEXTS.theLanesLinks,
  },
  {
    id: 'sumo-fcd',
    wish: 'simulate',
    label: TEXTS.sumoRecording,
    icon: 'table',
    says: TEXTS.positionsAtEachStep,
  },
  {
    id: 'csv',
    wish: 'table',
    label: TEXTS.table,
    icon: 'table',
    says: TEXTS.oneRowPerStep,
    sought: TEXTS.tableNames,
  },
  {
    id: 'parquet',
    wish: 'table',
    label: TEXTS.tableCompact,
    icon: 'table',
    says: TEXTS.theSameRowsFor,
  },
  {
    id: 'geojson',
    wish: 'table',
    label: TEXTS.mapLayers,
    icon: 'layers',
    says: TEXTS.lanesAndWays,
  },
  {
    id: 'mcap',
    wish: 'table',
    label: TEXTS.foxgloveLog,
    icon: 'film',
    says: TEXTS.toStepThrough,
  },
  {
    id: 'html',
    wish: 'show',
    label: TEXTS.interactivePage,
    icon: 'play',
    says: TEXTS.playsInAnyBrowser,
  },
  {
    id: 'womd',
    wish: 'train',
    label: TEXTS.scenarioRecord,
    icon: 'file',
    says: TEXTS.asInTheWaymo,
  },
  {
    id: 'womd-example',
    wish: 'train',
    label: TEXTS.scenarioAsTf,
    icon: 'file',
    says: TEXTS.theFlatFormOf,
  },
  {
    id: 'sim-agents',
    wish: 'train',
    label: TEXTS.simAgentsSubmission,
    icon: 'file',
    says: TEXTS.futuresOfAll,
  },
  {
    id: 'scenarionet',
    wish: 'train',
    label: TEXTS.scenarionet,
    icon: 'file',
    says: TEXTS.forMetadrive,
  },
  {
    id: 'av2',
    wish: 'train',
    label: TEXTS.argoverse2Scenario,
    icon: 'file',
    says: TEXTS.motionAsIn,
  },
  {
    id: 'gpudrive',
    wish: 'train',
    label: TEXTS.gpudrive,
    icon: 'file',
    says: TEXTS.forTrainingMany,
  },
  {
    id: 'nocturne',
    wish: 'train',
    label: TEXTS.nocturne,
    icon: 'file',
    says: TEXTS.forAgentsThat,
  },
];

/** A format without texts here is still offered, under the server's name. */
const plain = ({ id, name }: FormatInfo): OutFormat => ({ id, wish: 'more', label: name, icon: 'file', says: '' });

/** Formats that the server writes, by purpose; each with its file ending and common names. */
export function outFormats(known: readonly FormatInfo[]): (OutFormat & { ending: string; name: string })[] {
  const written = known.filter((f) => f.export);
  const worded = OUT.filter((o) => written.some((f) => f.id === o.id));
  const others = written.filter((f) => !OUT.some((o) => o.id === f.id)).map(plain);
  return [...worded, ...others].map((o) => {
    const f = written.find(({ id }) => id === o.id)!;
    return {
      ...o,
      ending: `.${o.id === 'dragtraffic' ? 'json' : f.extensions[0]}`,
      name: [f.name, o.sought].filter(Boolean).join(', '),
    };
  });
}

/** A kind of file that can be imported. */
export interface InKind {
  readonly label: string;
  readonly icon: string;
  readonly says: string;
  readonly formats: readonly string[];
}

const IN: readonly InKind[] = [
  {
    label: TEXTS.savedScenes,
    icon: 'layers',
    says: TEXTS.asTheyWereSaved,
    formats: ['dragtraffic'],
  },
  {
    label: TEXTS.recordedTraffic,
    icon: 'film',
    says: TEXTS.scenariosOfData,
    formats: ['womd', 'av2', 'scenarionet', 'commonroad', 'gpudrive', 'nocturne'],
  },
  {
    label: TEXTS.simulatedTraffic,
    icon: 'car',
    says: TEXTS.sumoTrajectories,
    formats: ['sumo-fcd'],
  },
  {
    label: TEXTS.trajectoryTables,
    icon: 'table',
    says: TEXTS.oneRowPerTime,
    formats: ['csv', 'parquet'],
  },
  {
    label: TEXTS.mapsOnly,
    icon: 'road',
    says: TEXTS.theRoadOfAScene,
    formats: ['opendrive', 'lanelet2', 'sumo-net', 'osm'],
  },
];

/** Formats that the server reads, by kind; a format without texts here is last. */
export function inKinds(known: readonly FormatInfo[]): (InKind & { files: readonly FormatInfo[] })[] {
  const read = known.filter((f) => f.import);
  const kinds = IN.map((k) => ({ ...k, files: k.formats.flatMap((id) => read.find((f) => f.id === id) ?? []) }));
  const others = read.filter((f) => !IN.some((k) => k.formats.includes(f.id)));
  const more = { label: TEXTS.more, icon: 'file', says: '', formats: others.map((f) => f.id), files: others };
  return [...kinds, more].filter((k) => k.files.length);
}
