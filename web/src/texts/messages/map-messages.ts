// The checks of a drawn map, by their codes: see `messages.ts`.
import { table, type Values } from '../table';

export const SENTENCES = table('map-messages', {
  lists: { vehicle: { bus: '12 m bus', car: '5 m car' } },
  sentences: {
    'lanes-lead': 'Every lane leads somewhere',
    'lane-leads-nowhere': (v: Values) => `Lane ${v.lane} leads nowhere`,
    'lane-unreached': (v: Values) => `No lane leads to lane ${v.lane}`,
    'vehicle-turns': (v: Values) => `A ${v.vehicle} can turn`,
    'movement-tight': (v: Values) =>
      `${v.from} to ${v.to} is too tight: radius ${v.radius_m}, a ${v.vehicle} needs ${v.needed_m}`,
    'lane-tight': (v: Values) =>
      `Lane ${v.lane} is too tight: radius ${v.radius_m}, a ${v.vehicle} needs ${v.needed_m}`,
    'lanes-wide': 'Every lane is wide enough',
    'lane-narrow': (v: Values) => `Lane ${v.lane} is ${v.width_m} wide`,
    'greens-apart': 'No two conflicting movements have green at the same time',
    'greens-conflict': (v: Values) => `${v.first} and ${v.second} conflict and have green at the same time`,
  },
});
