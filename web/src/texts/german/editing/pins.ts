import type { TEXTS } from '../../editing/pins';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  pin: 'Diese Zukunft anheften',
  selectFirst: 'Erst jemanden mit Zukünften auswählen.',
  atMost: (most) => `${most} sind angeheftet, mehr geht nicht. Erst eine lösen.`,
  pinLetter: (letter) => `Zukunft ${letter} anheften`,
  letGoLetter: (letter) => `Zukunft ${letter} lösen`,
  letGo: (name) => `Angeheftete Zukunft lösen: ${name}`,
  pinnedSign: 'angeheftet',
  pinned: (letter, name) => `Zukunft ${letter} von ${name} angeheftet`,
  unpinned: (future, name) => `Angeheftete Zukunft von ${name} gelöst: ${future}`,
  taken: (future, name) => `Angeheftete Zukunft von ${name} gewählt: ${future}`,
  anotherKind: 'für eine andere Art',
  startsAway: (distance) => `beginnt ${distance} entfernt`,
  startsTurned: 'beginnt anders gedreht',
  startsAt: (speed) => `beginnt mit ${speed}`,
  fromTheGoal: (distance) => `${distance} vom Ziel`,
  endsTurned: 'endet anders gedreht',
  endsAt: (speed) => `endet mit ${speed}`,
  missesVia: 'verfehlt einen Zwischenpunkt',
  noLongerFits: (name, why) =>
    `${name}: ${why}, passt also nicht mehr. Wer sie wählt, bekommt Start und Ziel dazu zurück.`,
};
