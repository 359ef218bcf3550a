import type { TEXTS } from '../../editing/pins';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  pin: 'Diese Zukunft anheften',
  selectFirst: 'Erst einen Verkehrsteilnehmer mit Zukünften auswählen.',
  atMost: (most) => `Höchstens ${most} Zukünfte lassen sich anheften. Erst eine lösen.`,
  pinLetter: (letter) => `Zukunft ${letter} anheften`,
  unpinLetter: (letter) => `Zukunft ${letter} lösen`,
  unpin: (name) => `Angeheftete Zukunft lösen: ${name}`,
  pinnedSign: 'angeheftet',
  pinned: (letter, name) => `Zukunft ${letter} von ${name} angeheftet`,
  unpinned: (future, name) => `Angeheftete Zukunft von ${name} gelöst: ${future}`,
  taken: (future, name) => `Angeheftete Zukunft von ${name} gewählt: ${future}`,
  anotherType: 'für eine andere Art',
  startsAway: (distance) => `beginnt ${distance} entfernt`,
  startsTurned: 'beginnt mit anderer Richtung',
  startsAt: (speed) => `beginnt mit ${speed}`,
  fromTheGoal: (distance) => `${distance} vom Ziel`,
  endsTurned: 'endet mit anderer Richtung',
  endsAt: (speed) => `endet mit ${speed}`,
  missesVia: 'verfehlt einen Zwischenpunkt',
  noLongerFits: (name, why) => `${name} passt nicht mehr: ${why}. Auswählen stellt Start und Ziel wieder her.`,
};
