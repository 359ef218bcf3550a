import type { TEXTS } from '../../scene/kinds';
import { plural } from '../plural';
import type { Said } from '../../table';

export const german: Said<typeof TEXTS> = {
  car: 'Pkw',
  truck: 'Lkw',
  bus: 'Bus',
  motorcycle: 'Motorrad',
  cyclist: 'Radfahrer',
  pedestrian: 'Fußgänger',
  object: 'Objekt',
  smallCar: 'Kleinwagen',
  van: 'Lieferwagen',
  deliveryTruck: 'Verteiler-Lkw',
  semiTrailer: 'Sattelzug',
  cityBus: 'Stadtbus',
  articulatedBus: 'Gelenkbus',
  minibus: 'Kleinbus',
  moped: 'Moped',
  bicycle: 'Fahrrad',
  cargoBike: 'Lastenrad',
  kickScooter: 'Tretroller',
  adult: 'Erwachsener',
  child: 'Kind',
  wheelchair: 'Rollstuhl',
  // The same as above, written out: the build renames the keys of the table, but not these.
  one: {
    car: 'Pkw',
    truck: 'Lkw',
    bus: 'Bus',
    motorcycle: 'Motorrad',
    cyclist: 'Radfahrer',
    pedestrian: 'Fußgänger',
    other: 'Objekt',
  },
  count: {
    car: (n: number) => `${n} Pkw`,
    truck: (n: number) => `${n} Lkw`,
    bus: (n: number) => plural(n, { one: `${n} Bus`, other: `${n} Busse` }),
    motorcycle: (n: number) => plural(n, { one: `${n} Motorrad`, other: `${n} Motorräder` }),
    cyclist: (n: number) => `${n} Radfahrer`,
    pedestrian: (n: number) => `${n} Fußgänger`,
    other: (n: number) => plural(n, { one: `${n} Objekt`, other: `${n} Objekte` }),
  },
  andMoreTypes: (rows: string, n: number) => `${rows} und ${n} weitere Arten`,
};
