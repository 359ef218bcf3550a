import { table } from '../table';

export const TEXTS = table('place-panel', {
  one: 'One',
  clickWhereIt: 'Click where it should start, drag to turn it',
  alongALine: 'Along a line',
  dragALineThey: 'Drag a line: they stand along it',
  overAnArea: 'Over an area',
  dragOverTheGround: 'Drag over the ground: they spread over it',
  placeA: (kind_name: string) => `Place a ${kind_name}`,
  donePlacing: 'Done placing',
  size: 'Size',
  ownSize: 'Own size',
  howMany: 'How many',
  howManyRoadUsers: 'How many road users',
  sizes: { length: 'length', width: 'width' },
  letters: { length: 'L', width: 'W' },
  ownIn: (name: string, unit: string) => `Own ${name} in ${unit}`,
});
