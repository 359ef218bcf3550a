import type { TEXTS } from '../../editing/keeping';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  onlyOwnerChanges: (owner) => `Nur ${owner} kann diese Szene ändern.`,
  mapAdded: (free) => `„${free}“: Karte angelegt. Änderungen werden automatisch gesichert.`,
  newScene: 'Neue Szene',
  noRoadUsersYet: (name: string) => `„${name}“: noch ohne Verkehrsteilnehmer. Änderungen werden automatisch gesichert.`,
  copy: (name: string) => `${name}, Kopie`,
  edited: (name: string) => `${name}, bearbeitet`,
  savedAs: (name: string) => `Gesichert als „${name}“. Änderungen werden automatisch gesichert.`,
  notSaved: 'Nicht gesichert',
  scene: 'Szene',
  open: 'Öffnen',
  copiedAs: (name: string) => `Kopiert als „${name}“.`,
  notCopied: 'Nicht kopiert',
  notRenamed: 'Nicht umbenannt',
  accessNotChanged: 'Zugriff nicht geändert',
  undo: 'Rückgängig',
  deleted: (name: string) => `„${name}“ gelöscht.`,
  notDeleted: 'Nicht gelöscht',
  restored: (body) => `„${body}“ wiederhergestellt.`,
  notRestored: 'Nicht wiederhergestellt',
  theServerIsNotAnswering: 'der Server antwortet nicht. Die Änderungen sind auf diesem Rechner gesichert.',
  thereIsNoWhole: 'Der Link enthält keine vollständige Szene.',
  sharedScene: 'Geteilte Szene',
  thisSceneCame: 'Diese Szene wurde aus einem Link geöffnet und ist schreibgeschützt.',
  makeACopy: 'Kopie anlegen',
};
