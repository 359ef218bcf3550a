import { table } from '../table';

export const TEXTS = table('place-panel', {
  one: 'One',
  clickTheStartPosition: 'Click the start position, drag to set the heading',
  alongALine: 'Along a line',
  dragALine: 'Drag a line to place a row along it',
  overAnArea: 'Over an area',
  dragOverTheGround: 'Drag an area to place a group in it',
  placeA: (kind_name: string) => `Place a ${kind_name}`,
  donePlacing: 'Done placing',
  size: 'Size',
  customSize: 'Custom size',
  count: 'Count',
  numberOfRoadUsers: 'Number of road users',
  sizes: { length: 'length', width: 'width' },
  letters: { length: 'L', width: 'W' },
  customIn: (name: string, unit: string) => `Custom ${name} in ${unit}`,
});
