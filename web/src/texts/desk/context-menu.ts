import { table } from '../table';

export const TEXTS = table('context-menu', {
  type: 'Type',
  actionsForThis: 'Actions for this road user',
  actionsForThese: 'Actions for these road users',
  actionsForThisFuture: 'Actions for this future',
  actionsForThisGoal: 'Actions for this goal',
  actionsForThisPlace: 'Actions for this place',
});
