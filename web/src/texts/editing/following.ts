import { table } from '../table';

export const TEXTS = table('following', {
  run: 'Run',
  drivenElsewhere: 'This run is controlled by another program and read-only here.',
  makeACopy: 'Make a copy',
  notThere: (why: string) => `The run cannot be shown. ${why}`,
  followed: 'Run',
  secondsOf: (names: string, time: string) =>
    names ? `Controlled externally: ${names} · ${time} s` : `Run · ${time} s`,
  hasEnded: (time: string) => `The run has ended · ${time} s`,
});
