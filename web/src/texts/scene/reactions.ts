import { table } from '../table';

export const TEXTS = table('reactions', {
  replanned: 'replanned',
  noLongerReacts: (whom: string) => `no longer reacts to ${whom}`,
  differs: 'Differs from the recording.',
  endsTurned: 'Ends with a different heading than in the recording.',
  travelsLess: (way: string) => `Covers ${way} less than in the recording.`,
  travelsMore: (way: string) => `Covers ${way} more than in the recording.`,
  waits: (long: string, whom: string, behind: boolean) => `waits${long} ${behind ? 'behind' : 'for'} ${whom}`,
  slowsTo: (speed: string, whom: string, behind: boolean) => `slows to ${speed} ${behind ? 'behind' : 'for'} ${whom}`,
  stopsBriefly: (whom: string, behind: boolean) => `stops briefly ${behind ? 'behind' : 'for'} ${whom}`,
  speedsUpFor: (name: string) => `speeds up ahead of ${name}`,
  staysOut: (name: string) => `does not appear: ${name} is in its place`,
  keepsClearOf: (name: string, behind: boolean) => (behind ? `stays behind ${name}` : `keeps clear of ${name}`),
});
