import type { TEXTS } from '../../desk/context-menu';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  type: 'Art',
  actionsForThis: 'Aktionen für diesen Verkehrsteilnehmer',
  actionsForThese: 'Aktionen für diese Verkehrsteilnehmer',
  actionsForThisFuture: 'Aktionen für diese Zukunft',
  actionsForThisGoal: 'Aktionen für dieses Ziel',
  actionsForThisPlace: 'Aktionen für diesen Ort',
};
