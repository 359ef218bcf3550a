// Sentences of the engine by code: `assets/messages.json` lists them with their values. Each value is text in the units
// of the page; an absent value is empty.
import { table, type Values } from '../table';

export const SENTENCES = table('messages', {
  /** Before a sentence that applies from a time on. */
  since: (time: string, sentence: string) => `From ${time} on: ${sentence}`,
  /** Before a sentence about a line of a text file. */
  inLine: (line: string, sentence: string) => `Line ${line}: ${sentence}`,
  lists: { kind: { vehicle: 'this vehicle', cyclist: 'this cyclist', pedestrian: 'this pedestrian' } },
  sentences: {
    // Of the goal's reach: the title is the heading of the verdict.
    'goal-too-far': {
      title: (v: Values) => `Too far for ${v.time_s}`,
      rest: (v: Values) =>
        `The goal is ${v.goal_m} away. From ${v.start_mps}, ${v.kind} covers at most ${v.most_m} in ${v.time_s}.`,
    },
    'goal-too-fast': {
      title: (v: Values) => `Cannot accelerate that much in ${v.time_s} from ${v.start_mps}`,
      rest: (v: Values) => (v.need_mps2 ? `Required: ${v.need_mps2}.` : ''),
    },
    'goal-above-top-speed': {
      title: (v: Values) => `Above the top speed of ${v.kind}`,
      rest: (v: Values) => (v.need_mps ? `Required: ${v.need_mps}.` : ''),
    },
    'goal-too-near': {
      title: () => 'Cannot stop that soon',
      rest: (v: Values) =>
        `Braking from ${v.start_mps} takes ${v.least_m}; the goal is ${v.goal_m} away.${v.need_mps2 && ` Required: ${v.need_mps2}.`}`,
    },
    'goal-too-slow': {
      title: (v: Values) => `Cannot brake that much in ${v.time_s}`,
      rest: (v: Values) => (v.need_mps2 ? `Required: ${v.need_mps2}.` : ''),
    },
    'goal-too-tight': {
      title: () => 'Too tight at this speed',
      rest: (v: Values) => (v.need_mps2 ? `Required lateral acceleration: ${v.need_mps2}.` : ''),
    },
    'goal-turn-too-tight': { title: (v: Values) => `The turn is too tight for ${v.kind}`, rest: '' },
    'goal-blocked': {
      title: (v: Values) => `Road user ${v.agent} blocks ${v.kind}`,
      rest: (v: Values) => `It stops ${v.short_m} short of the goal.`,
    },
    'goal-blocked-by-traffic': {
      title: (v: Values) => `Another road user blocks ${v.kind}`,
      rest: (v: Values) => `It stops ${v.short_m} short of the goal.`,
    },
    'goal-off-road': { title: (v: Values) => `There is no lane within ${v.within_m} of the goal`, rest: '' },
    'goal-beyond-top-speed': {
      title: (v: Values) => `${v.goal_m} in ${v.time_s} requires more than the top speed`,
      rest: '',
    },
    // Of a goal that is relative to another road user.
    'relation-gone': {
      title: (v: Values) => `Road user ${v.agent} is not in the scene at ${v.time_s}`,
      rest: 'The goal is relative to it.',
    },
    'relation-lane-ends': {
      title: (v: Values) => `The lane ends ${v.short_m} before the goal`,
      rest: (v: Values) => `The goal is relative to road user ${v.agent} at ${v.time_s}.`,
    },
    'relation-no-lane-left': {
      title: (v: Values) => `Lane ${v.number} to the left of road user ${v.agent} does not exist`,
      rest: (v: Values) => `This applies to its position at ${v.time_s}.`,
    },
    'relation-no-lane-right': {
      title: (v: Values) => `Lane ${v.number} to the right of road user ${v.agent} does not exist`,
      rest: (v: Values) => `This applies to its position at ${v.time_s}.`,
    },
    'relation-not-passed': {
      title: (v: Values) => `Road user ${v.agent} does not pass the goal`,
      rest: (v: Values) => `It does not come within ${v.within_m} of it.`,
    },
    'relation-off-lanes': {
      title: (v: Values) => `Road user ${v.agent} is on no lane at ${v.time_s}`,
      rest: 'No lane is beside it.',
    },
    'relation-outside': {
      title: (v: Values) => `The goal would be due at ${v.time_s}`,
      rest: (v: Values) =>
        `Road user ${v.agent} passes it at ${v.passed_s}; ${v.least_s} to ${v.most_s} is possible for the goal.`,
    },
    'relation-stands': {
      title: (v: Values) => `Road user ${v.agent} stands at ${v.time_s}`,
      rest: 'A time gap needs a speed; use a gap in metres.',
    },
    'relation-too-slow': {
      title: (v: Values) => `${v.slower_mps} slower gives a speed below zero`,
      rest: (v: Values) => `Road user ${v.agent} drives at ${v.other_mps} at ${v.time_s}.`,
    },
    'start-off-road': (v: Values) => `There is no lane within ${v.within_m} of the start.`,
    'start-overlaps': (v: Values) => `The start overlaps road user ${v.agent}.`,
    'via-missed': (v: Values) =>
      `The future misses via point ${v.number} by ${v.distance_m} at ${v.time_s}; the tolerance is ${v.tolerance_m}.`,
    'nothing-generated': 'No road user is regenerated, and no known motion ends before the last window.',
    'motion-ends': (v: Values) =>
      `The known motion ends at ${v.time_s}; the road user continues straight at its speed.`,
  },
});
