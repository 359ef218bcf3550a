import type { SENTENCES } from '../../messages/map-messages';
import type { Said, Values } from '../../table';

export const german: Said<typeof SENTENCES> = {
  lists: { vehicle: { bus: '12-m-Bus', car: '5-m-Auto' } },
  sentences: {
    'lanes-lead': 'Jede Spur führt weiter',
    'lane-leads-nowhere': (v: Values) => `Spur ${v.lane} führt nirgends hin`,
    'lane-unreached': (v: Values) => `Keine Spur führt zu Spur ${v.lane}`,
    'vehicle-turns': (v: Values) => `Ein ${v.vehicle} kann abbiegen`,
    'movement-tight': (v: Values) =>
      `${v.from} nach ${v.to} ist zu eng: Radius ${v.radius_m}, ein ${v.vehicle} braucht ${v.needed_m}`,
    'lane-tight': (v: Values) =>
      `Spur ${v.lane} ist zu eng: Radius ${v.radius_m}, ein ${v.vehicle} braucht ${v.needed_m}`,
    'lanes-wide': 'Jede Spur ist breit genug',
    'lane-narrow': (v: Values) => `Spur ${v.lane} ist ${v.width_m} breit`,
    'greens-apart': 'Keine zwei feindlichen Ströme haben zugleich Grün',
    'greens-conflict': (v: Values) => `${v.first} und ${v.second} sind feindlich und haben zugleich Grün`,
  },
};
