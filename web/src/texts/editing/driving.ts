import { table } from '../table';

export const TEXTS = table('driving', {
  toStart: (name: string) => `${name} is ready. Press W, A, S, D or an arrow key to start.`,
  pressToStart: 'Press a key to start',
  pressToGoOn: 'Paused. Press a key to continue',
  secondsOf: (time: string, most: string) => `${time} of ${most} s`,
  faster: 'faster',
  brake: 'brake',
  brakeHard: 'brake hard',
  steer: 'steer',
  keep: 'Keep',
  cancel: 'Cancel',
  controls: 'Keyboard drive',
  reacts: (name: string) => `${name} reacts`,
  hits: (name: string, other: string) => `${name} hits ${other}`,
  cancelled: 'Drive cancelled. The scene is unchanged.',
  didNotStart: (why: string) => `The drive did not start. ${why}`,
});
