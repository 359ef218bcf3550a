// Sentences of refused files and scenes by code: see `messages.ts`.
import { plural, table, type Values } from '../table';

export const SENTENCES = table('refusal-messages', {
  lists: {},
  sentences: {
    'appears-twice': (v: Values) => `${v.what} "${v.id}" appears twice`,
    'at-most': (v: Values) => `${v.found} ${v.what} found, at most ${v.most} expected`,
    expected: (v: Values) => `${v.expected} expected`,
    'found-expected': (v: Values) => `${v.found} found, ${v.expected} expected`,
    'map-over-limit': (v: Values) =>
      `${v.lines} polylines with ${v.points} points; at most ${v.most_lines} with ${v.most_points}`,
    'more-than': (v: Values) => `more than ${v.most} ${v.what}`,
    outside: (v: Values) => `${v.found} found, ${v.least} to ${v.most} expected`,
    'relation-ring': (v: Values) => `the goals are relative to each other in a circle: ${v.row}`,
    'relation-row': (v: Values) => `more than ${v.most} goals are relative to each other in a chain`,
    'relation-to-itself': 'the goal is relative to the same road user',
    'relation-unknown': (v: Values) => `the goal is relative to "${v.id}", which is not in the scene`,
    'state-expected': (v: Values) => `state ${v.step}: ${v.expected} expected`,
    'track-beyond-scene': (v: Values) => `track ends after step ${v.end}, the scene has ${v.steps}`,
    'both-or-neither': (v: Values) => `${v.first} is fixed, ${v.second} is not; fix both or neither`,
    'cannot-decompress': (v: Values) => `cannot decompress or read: ${v.words}`,
    'challenge-start': (v: Values) =>
      `the challenge begins at step ${v.begin} (1.0 s), this scene at step ${v.found} (${v.found_s}): generate its futures with --start-time 1.0`,
    'checksum-differs': (v: Values) => `the checksum of ${v.what} does not match`,
    contradiction: (v: Values) => `cannot be read as ${v.format}: the file contradicts itself`,
    'element-lacks-attribute': (v: Values) => `<${v.element}> has no attribute "${v.attribute}"`,
    'element-lacks-child': (v: Values) => `<${v.element}> has no <${v.child}>`,
    'file-ends-after': (v: Values) => `the file ends after ${v.found} of ${v.expected} bytes of a record`,
    'file-ends-inside': (v: Values) => `the file ends inside ${v.what}`,
    'file-has-no': (v: Values) => `the file has no ${v.what}`,
    'file-needs': (v: Values) => `a file of format ${v.format} needs at least one ${v.what}; the scene has none`,
    'file-too-long': (v: Values) => `the file has ${v.bytes} bytes or more; at most ${v.most}`,
    'found-in-element': (v: Values) => `"${v.found}" found in <${v.element}>, ${v.expected} expected`,
    'found-one-of': (v: Values) => `"${v.found}" found, one of ${v.list} expected`,
    'index-beyond': (v: Values) => `${v.index} found, a number from 0 and below ${v.below} expected`,
    'inflates-too-much': (v: Values) => `decompresses to more than ${v.most} times its size`,
    'lane-outside': (v: Values) => `lane "${v.lane}", ${v.what}: ${v.found} found, ${v.least} to ${v.most} expected`,
    'lanelets-in-extract': 'it has lanelets: a Lanelet2 map, which is read as lanelet2',
    'map-too-wide': (v: Values) => `${v.width_m} x ${v.height_m}; a map reaches ${v.most_m} from its middle`,
    needs: (v: Values) => `${v.what} needs ${v.expected}`,
    'nested-deeper': (v: Values) => `nested deeper than ${v.most} levels`,
    'netconvert-failed': (v: Values) => `netconvert could not make a network from the file: ${v.words}`,
    'netconvert-missing':
      "an extract of OpenStreetMap is read with SUMO's netconvert, which is not installed: run `pip install eclipse-sumo` and start again",
    'near-a-place':
      '--around X,Y,RADIUS (in a call: around) reads the part within RADIUS metres of X,Y in the coordinates of the file',
    'network-too-large': (v: Values) => `more than ${v.most} ${v.what}`,
    'nothing-around': (v: Values) =>
      `no lane lies within ${v.radius_m} of ${v.x}, ${v.y}; the file has x ${v.x_range} and y ${v.y_range}`,
    'no-column': (v: Values) => `no column "${v.column}"; the table has ${v.columns}`,
    'no-lanelets': 'no lanelets: if it is an extract of OpenStreetMap, it is read as osm',
    'no-open-lanelets': 'no lanelets with two sides that a road user may use: subtypes and participants decide',
    'no-roads-with-lanes': (v: Values) => `no roads with lanes: ${v.words}`,
    'no-projection': (v: Values) => `the projection is unknown: ${v.key} of the map names no UTM zone`,
    'no-table': (v: Values) => `the database has no table ${v.table}`,
    'not-both': (v: Values) => `give either ${v.first} or ${v.second}, not both`,
    'not-read': (v: Values) => `${v.what} is not read`,
    'not-utf8': (v: Values) => `${v.what} is not UTF-8`,
    'one-of': (v: Values) => `one of ${v.list} expected`,
    'one-scene-a-file': 'a file of this format holds one scene',
    'only-read': (v: Values) => `${v.format} is read, not written`,
    'only-written': (v: Values) => `${v.format} is written, not read`,
    'other-kind': (v: Values) => `${v.file} is not read; ${v.instead}`,
    'other-kind-named': (v: Values) =>
      `${v.file} is not read; ${v.instead} (its name ends in .${v.end}, its content is something else)`,
    'parser-words': (v: Values) => `${v.words}`,
    'pickle-calls': (v: Values) =>
      `byte ${v.byte}: the pickle asks for ${v.name}; numbers, texts, lists and arrays are read, nothing is called`,
    'pickle-holds': (v: Values) => `byte ${v.byte}: ${v.what} found; numbers, texts, lists and arrays are read`,
    'positions-over-limit': (v: Values) =>
      `more than ${v.most} ${v.what} within ${v.within_s}; record fewer (fcd-output.filter-edges.input-file, device.fcd.probability)`,
    'range-outside': (v: Values) => `${v.what}: ${v.found} found, ${v.least} to ${v.most} expected`,
    'road-over-limit': (v: Values) => `road "${v.road}" has ${v.records} records, too many for its length`,
    'roads-over-memory': (v: Values) =>
      `${v.lanes_m} of lanes and ${v.elements} elements would take more memory than a file of this size may`,
    'roads-too-far': (v: Values) => `roads over ${v.reach_km} km; a map spans a few kilometres`,
    'too-far-from-start': (v: Values) =>
      `the ${v.what} is ${v.distance_m} from the start, at most ${v.most_m} expected`,
    'unequal-columns': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} value, ${v.expected} expected, as in ${v.like}`,
        other: `${v.count} values, ${v.expected} expected, as in ${v.like}`,
      }),
    'unknown-map': 'the server has no map with this hash; send the map itself',
    unreadable: (v: Values) => `cannot be read as ${v.format}: ${v.words}`,
    'unsupported-version': (v: Values) => `version ${v.found} found, versions up to ${v.known} are supported`,
    'zip-without': (v: Values) => `a zip without a file whose name ends in ${v.first} or ${v.second}`,
  },
});
