// Sentences of refused requests by code: see `messages.ts`.
import { plural, table, type Values } from '../table';

export const SENTENCES = table('problem-messages', {
  lists: {},
  sentences: {
    'unknown-agent': (v: Values) => `the scene has no road user \"${v.id}\"`,
    'not-asked': (v: Values) =>
      `road user \"${v.id}\" is not in agents: add \"${v.id}\" to agents, or leave this condition out`,
    'no-agents-named': 'expected \"all\", at least one id, or at least one road user that reacts',
    'too-many-regenerated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user to regenerate; at most ${v.most}`,
        other: `${v.count} road users to regenerate; at most ${v.most}`,
      }),
    'too-many-points': (v: Values) => `the reply would have ${v.points} points; at most ${v.most}`,
    'too-much-work': (v: Values) => `the call would take about ${v.seconds} s of a core; at most ${v.most}`,
    'no-future-kept': 'the scene keeps no future of this road user from the start on',
    'replan-interval': (v: Values) => `${v.got} s; null, 3, 6 or 9 expected`,
    'more-than-a-turn': (v: Values) => `${v.got} rad is more than a turn; ${v.got} degrees are ${v.radians} rad`,
    'one-scene': 'exactly one of scene and scene_id is needed',
    'changed-scene': 'The stored scene has changed since it was read.',
    'no-network': (v: Values) => `a file of format ${v.format} takes no network file`,
    'no-part': (v: Values) =>
      `a file of format ${v.format} is read whole; maps of SUMO, OpenDRIVE, Lanelet2 and OpenStreetMap are read in part`,
    'no-columns': (v: Values) => `a file of format ${v.format} has no columns to name`,
    'unknown-format': (v: Values) => `No format is named \"${v.format}\"; the formats are ${v.formats}.`,
    'ego-absent': (v: Values) => `\"${v.id}\" is not in the scene at the start`,
    'ego-once': (v: Values) => `\"${v.id}\" must be named exactly once`,
    'not-an-ego': (v: Values) => `\"${v.id}\" is not an ego`,
    'no-ego-state': (v: Values) => `\"${v.id}\", state ${v.at}: the position or the speed is out of range`,
    'step-order': (v: Values) => `step ${v.got} found, step ${v.next} expected`,
    'setting-of-snapshot': (v: Values) => `the snapshot has its own ${v.member}`,
    'snapshot-of-another-scene': 'the snapshot belongs to another scene',
    'snapshot-broken': (v: Values) => `not a snapshot: byte ${v.at} is wrong`,
    'too-many-runs': 'no room for another run; delete one, or wait',
    'too-many-requests': (v: Values) =>
      plural(Number(v.most), {
        one: `more than ${v.most} request a second from this caller`,
        other: `more than ${v.most} requests a second from this caller`,
      }),
    defect: 'The server failed; see its log.',
    'exactly-one': (v: Values) => `exactly one of ${v.first} and ${v.second} is needed`,
    'share-sum': (v: Values) => `the shares sum to ${v.sum}; 1 expected`,
    'empty-map': 'the map is empty: it has no place for a region',
  },
});
