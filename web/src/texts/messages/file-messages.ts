// Warnings of the file readers by code: see `messages.ts`.
import { plural, table, type Values } from '../table';

export const SENTENCES = table('file-messages', {
  lists: {
    fault: {
      'cut-off': 'the file is cut off',
      'no-value': 'a value is missing',
      'no-sign': 'a comma, colon or bracket is missing',
      comma: 'one comma too many',
      'text-after': 'text follows after the end',
      'no-quotes': 'a name has no quotes',
      number: 'a number is invalid',
      text: 'a text is invalid',
    },
    what: { lanes: 'lanes', roads: 'roads' },
    subject: { 'road-users': 'road users', 'map-features': 'map features', tracks: 'tracks' },
  },
  sentences: {
    'agents-near-ego': (v: Values) => `${v.found} road users; the ${v.kept} nearest to the ego are kept`,
    'agents-near-centre': (v: Values) =>
      `${v.found} road users; the ${v.kept} nearest to their centre are kept, within ${v.within_m} of the origin`,
    'agents-over-limit': (v: Values) => `The scene has ${v.agents} road users; at most ${v.most}.`,
    'agents-with-used-id': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} obstacle with the id of another obstacle is left out`,
        other: `${v.count} obstacles with the id of another obstacle are left out`,
      }),
    'agents-outside-network': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} of ${v.found} road users lies outside the network: it belongs to another recording, or positions are in degrees (fcd-output.geo) rather than metres`,
        other: `${v.count} of ${v.found} road users lie outside the network: it belongs to another recording, or positions are in degrees (fcd-output.geo) rather than metres`,
      }),
    'areas-too-far': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} drivable area reaches farther than ${v.within_m} from the centre and is left out`,
        other: `${v.count} drivable areas reach farther than ${v.within_m} from the centre and are left out`,
      }),
    'boxes-across': (v: Values) =>
      plural(Number(v.count), {
        one: `The long side of ${v.count} box lies across its motion: length and width may be swapped`,
        other: `The long sides of ${v.count} boxes lie across their motion: length and width may be swapped`,
      }),
    'columns-recognised': (v: Values) =>
      `The columns are read as those of the data set ${v.sets}; --columns names others`,
    'agents-table-missing': 'The table of road users, which gives their types, is missing',
    'recording-table-missing': 'The table of the recording, which gives frame rate, speed limit and place, is missing',
    'rows-in-part': (v: Values) =>
      `The table has ${v.found} rows, more than are read at once: the ${v.kept} rows before ${v.before_s} s are read. "only" in a file of columns chooses another part by time_s or agent_id`,
    'files-beside': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} file from the same folder is read with the table: ${v.names}`,
        other: `${v.count} files from the same folder are read with the table: ${v.names}`,
      }),
    'map-unread': (v: Values) => `The map ${v.name} cannot be read: ${v.why}`,
    'map-chosen': (v: Values) => `Of ${v.maps} maps, that of ${v.name} has the most vehicles on its lanes`,
    'speed-limit-of-recording': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane without a speed limit has that of the recording, ${v.limit_mps} m/s`,
        other: `${v.count} lanes without a speed limit have that of the recording, ${v.limit_mps} m/s`,
      }),
    'columns-missing': (v: Values) =>
      `No column ${v.missing}; the table has ${v.columns}. A file of columns can name them.`,
    'crossing-areas': 'Drivable areas overlap too often to find the edges of the road',
    'crossing-lanelets': 'Lanelets overlap too often to find the edges of the road',
    'crossing-roads': 'Roads overlap too often to find their edges',
    'cut-around': (v: Values) =>
      `within ${v.radius_m} of ${v.x}, ${v.y}: lanes kept ${v.kept}, of these ending at the circle ${v.ended}; ${v.what} outside ${v.outside}`,
    'cut-in-scenes': (v: Values) => `The recording is longer than a scene: it is cut into scenes of ${v.each_s}`,
    'unread-by-place': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} element is not read: ${v.places}`,
        other: `${v.count} elements are not read: ${v.places}`,
      }),
    'unread-places': (v: Values) => `${v.all} elements are not read: ${v.places} and ${v.more} more`,
    'elements-unread': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} element that a scene cannot hold is left out`,
        other: `${v.count} elements that a scene cannot hold are left out`,
      }),
    'empty-file': 'The file is empty',
    'features-unread': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} map feature of unknown kind or with too few points is left out`,
        other: `${v.count} map features of unknown kind or with too few points are left out`,
      }),
    'futures-unread': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} future is empty, impossible or beyond the limit, and is left out`,
        other: `${v.count} futures are empty, impossible or beyond the limit, and are left out`,
      }),
    'goals-beyond-first': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} further goal of the same road user is left out`,
        other: `${v.count} further goals of the same road users are left out`,
      }),
    'goals-are-regions': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} goal is a region; its centre is used`,
        other: `${v.count} goals are regions; their centres are used`,
      }),
    'headings-derived': 'Headings are derived from the motion; a standing road user keeps its last heading',
    'headings-along-degrees': (v: Values) =>
      `Headings are in degrees and were converted to radians: ${v.agree} of ${v.moving} moving road users move along them`,
    'headings-along-radians': (v: Values) =>
      `Headings are in radians where degrees are usual: ${v.agree} of ${v.moving} moving road users move along them`,
    'headings-in-degrees': (v: Values) =>
      `Headings are converted from degrees: as radians, those of ${v.outside} of ${v.found} road users would exceed a full turn, or the format has degrees`,
    'headings-wrapped': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} heading exceeds a full turn and was wrapped`,
        other: `${v.count} headings exceed a full turn and were wrapped`,
      }),
    'ids-renumbered': "Lanes and junctions have numbers instead of SUMO's ids",
    'ids-replaced': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} id of ${v.subject} was replaced: an id is unique and consists of letters, digits and _ . : -`,
        other: `${v.count} ids of ${v.subject} were replaced: an id is unique and consists of letters, digits and _ . : -`,
      }),
    'ids-respelled': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} id was respelled or got a suffix`,
        other: `${v.count} ids were respelled or got a suffix`,
      }),
    'ids-suffixed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} repeated id of ${v.subject} got a suffix`,
        other: `${v.count} repeated ids of ${v.subject} got a suffix`,
      }),
    'identities-joined': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user had a second id and is merged: ${v.pairs} (and ${v.more} more)`,
        other: `${v.count} road users had a second id and are merged: ${v.pairs} (and ${v.more} more)`,
      }),
    'identities-joined-all': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user had a second id and is merged: ${v.pairs}`,
        other: `${v.count} road users had a second id and are merged: ${v.pairs}`,
      }),
    jumps: (v: Values) =>
      plural(Number(v.count), {
        one: `A road user was teleported ${v.count} time; this gap remains`,
        other: `Road users were teleported ${v.count} times; these gaps remain`,
      }),
    'json-array': 'The file is a JSON array; a scene is a JSON object with the format dragtraffic.scene',
    'lanelets-unusable': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lanelet without two sides, or not for traffic, is left out`,
        other: `${v.count} lanelets without two sides, or not for traffic, are left out`,
      }),
    'lanelets-with-used-id': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lanelet with the id of another lanelet is left out`,
        other: `${v.count} lanelets with the id of another lanelet are left out`,
      }),
    'lanes-bordered': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane (${Math.round(Number(v.length_m))} m) has borders in a section with widths, which the standard prefers: its borders are left out`,
        other: `${v.count} lanes (${Math.round(Number(v.length_m))} m) have borders in sections with widths, which the standard prefers: their borders are left out`,
      }),
    'lanes-closed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane open to no road user (rails, strips) is left out`,
        other: `${v.count} lanes open to no road user (rails, strips) are left out`,
      }),
    'json-syntax': (v: Values) => `Not valid JSON: ${v.fault}.`,
    'lane-links-derived': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane link is not in the file: a lane that ends where another one begins is linked to it`,
        other: `${v.count} lane links are not in the file: a lane that ends where another one begins is linked to it`,
      }),
    'lane-segments-unusable': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane segment without two sides is left out`,
        other: `${v.count} lane segments without two sides are left out`,
      }),
    'lanes-shared': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} two-way road is one lane wide: both directions share its middle`,
        other: `${v.count} two-way roads are one lane wide: both directions share their middle`,
      }),
    'lanes-without-line': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane without a centre line is left out`,
        other: `${v.count} lanes without a centre line are left out`,
      }),
    'left-hand': 'Traffic keeps to the left, as in this region',
    'left-hand-network': 'Traffic keeps to the left, as the network states',
    'lines-thinned': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} line has more points than a scene holds and is thinned`,
        other: `${v.count} lines have more points than a scene holds and are thinned`,
      }),
    'links-apart': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane link is dropped: the ends lie more than a lane's width apart`,
        other: `${v.count} lane links are dropped: the ends lie more than a lane's width apart`,
      }),
    'links-turned': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} lane link leads backwards: it is turned, as its lanes meet the other way round`,
        other: `${v.count} lane links lead backwards: they are turned, as their lanes meet the other way round`,
      }),
    'lines-approximated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} painted line has a type or colour that a scene does not support`,
        other: `${v.count} painted lines have a type or colour that a scene does not support`,
      }),
    'loss-lane-lines': (v: Values) =>
      plural(Number(v.count), {
        one: `lanes are polylines within ${v.off_mm} mm, and ${v.count} has its start as a connecting road`,
        other: `lanes are polylines within ${v.off_mm} mm, and ${v.count} have their start as a connecting road`,
      }),
    'loss-lane-points': (v: Values) =>
      `lanes are within ${v.off_mm} mm of their lines when their points are set again; stop lines and stop signs are where lanes begin and end`,
    'loss-lanes-without-length': (v: Values) =>
      plural(Number(v.count), { one: `${v.count} lane of no length`, other: `${v.count} lanes of no length` }),
    'loss-lights-over-room': (v: Values) => `a record has room for ${v.most} signals per step`,
    'loss-lines-sampled': (v: Values) => `lines as points ${v.apart_m} apart, without lane graph and speed limits`,
    'loss-longer': (v: Values) => `nothing is cut: ${v.steps} steps, where the scene has ${v.known}`,
    'loss-motion-extrapolated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} motion ends early and continues straight`,
        other: `${v.count} motions end early and continue straight`,
      }),
    'loss-points-over-room': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} map point; a record has room for ${v.most}`,
        other: `${v.count} map points; a record has room for ${v.most}`,
      }),
    'loss-rollouts': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} of the ${v.most} rollouts that the challenge takes: generate that many samples`,
        other: `${v.count} of the ${v.most} rollouts that the challenge takes: generate that many samples`,
      }),
    'loss-single-precision': (v: Values) => `numbers are in single precision: off by up to ${v.off_um} µm`,
    'loss-steps-over-room': (v: Values) =>
      `states more than ${v.past} steps before the current one or ${v.future} after it`,
    'loss-users-off-lanes': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user without a lane of its own is only in the recording`,
        other: `${v.count} road users without a lane of their own are only in the recording`,
      }),
    'loss-users-over-room': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user; a record has room for ${v.most}`,
        other: `${v.count} road users; a record has room for ${v.most}`,
      }),
    'map-fault': (v: Values) => `${v.first}`,
    'map-faults': (v: Values) => `${v.first} (and ${v.more} more)`,
    'map-heights-dropped': 'The network has heights; the map is flat',
    'map-lacks-lanelets': 'The file has no lanelets: the scene has no map',
    'map-missing': 'The scenario has no map file (log_map_archive_*.json): the scene has no lanes',
    'map-elsewhere': (v: Values) =>
      `Only ${v.percent}% of the vehicle positions are on lanes of the map: it belongs to another place or frame of reference`,
    'map-laid': (v: Values) => `${v.percent}% of the vehicle positions are on lanes of the map`,
    'moved-by-metadrive': 'MetaDrive moved and turned the file; the place of the recording is unknown',
    'network-missing': 'The recording has no network file: the scene has no lanes and no signals',
    'not-a-known-format': (v: Values) => `Not a file of a known format (${v.formats}).`,
    'now-step-moved': (v: Values) => `The current step is ${v.now} of ${v.steps}: the last step is used`,
    'obstacles-absent': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} obstacle is absent at all steps that are kept`,
        other: `${v.count} obstacles are absent at all steps that are kept`,
      }),
    'obstacles-are-sets': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} obstacle has possible areas instead of a trajectory: its first state is kept`,
        other: `${v.count} obstacles have possible areas instead of a trajectory: their first state is kept`,
      }),
    'obstacles-uncertain': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} obstacle has uncertain states; the centres are used`,
        other: `${v.count} obstacles have uncertain states; the centres are used`,
      }),
    'obstacles-unplaced': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} obstacle without a place, or without a size of at most 60 m, is left out`,
        other: `${v.count} obstacles without a place, or without a size of at most 60 m, are left out`,
      }),
    'parts-left-out': (v: Values) => `Left out: ${v.parts}`,
    'passengers-left-out': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} container or passenger is left out`,
        other: `${v.count} containers and passengers are left out`,
      }),
    'points-out-of-range': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} point; ${v.least} to ${v.most} expected`,
        other: `${v.count} points; ${v.least} to ${v.most} expected`,
      }),
    'programs-beyond-last': 'A signal has several programs; the last one is shown',
    'recording-heights-dropped': 'The recording has heights; the scene is flat',
    'rows-repeated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} row repeats a road user at the same time; one row of each time is kept`,
        other: `${v.count} rows repeat a road user at the same time; one row of each time is kept`,
      }),
    'shapes-boxed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} obstacle is not rectangular: its bounding box is used`,
        other: `${v.count} obstacles are not rectangular: their bounding boxes are used`,
      }),
    'signal-links-unprogrammed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} link of a signal has no program and is left out`,
        other: `${v.count} links of signals have no program and are left out`,
      }),
    'signals-empty': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} signal without a lane or without phases is left out`,
        other: `${v.count} signals without a lane or without phases are left out`,
      }),
    'signals-held': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} signal responds to traffic; it keeps the times of its plan`,
        other: `${v.count} signals respond to traffic; they keep the times of their plan`,
      }),
    'signals-made': (v: Values) =>
      plural(Number(v.junctions), {
        one: `The signal heads of ${v.junctions} junction (${v.count}) have no program; they got fixed times`,
        other: `The signal heads of ${v.junctions} junctions (${v.count}) have no program; they got fixed times`,
      }),
    'signals-made-near': (v: Values) =>
      plural(Number(v.junctions), {
        one: `The signal heads of ${v.junctions} junction (${v.count}) have no program; they got fixed times, and the ${v.kept} nearest to the centre are kept`,
        other: `The signal heads of ${v.junctions} junctions (${v.count}) have no program; they got fixed times, and the ${v.kept} nearest to the centre are kept`,
      }),
    'signals-near-centre': (v: Values) => `${v.found} signals; the ${v.kept} nearest to the centre are kept`,
    'signals-over-limit': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} signal beyond the limit of ${v.kept} is left out`,
        other: `${v.count} signals beyond the limit of ${v.kept} are left out`,
      }),
    'signals-without-lane': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} signal controls no lane of the map and is left out`,
        other: `${v.count} signals control no lane of the map and are left out`,
      }),
    'sizes-assumed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user has the default size of its type`,
        other: `${v.count} road users have the default size of their type`,
      }),
    'sizes-assumed-by-name': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user has the default size for the name of its type`,
        other: `${v.count} road users have the default size for the name of their type`,
      }),
    'sizes-assumed-car': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} planning problem has no size: the size of a car is used`,
        other: `${v.count} planning problems have no size: the size of a car is used`,
      }),
    'sizes-vary-median': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user changes size; the median is kept`,
        other: `${v.count} road users change size; the median is kept`,
      }),
    'sizes-vary-now': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user changes size; the size at the current step is kept`,
        other: `${v.count} road users change size; the size at the current step is kept`,
      }),
    'steps-beyond-limit': (v: Values) => `The file lasts ${v.length_s}; the first ${v.kept} steps of 0.1 s are kept`,
    'steps-coarse': (v: Values) => `Time steps are ${v.apart_s} apart; gaps longer than ${v.filled_s} remain`,
    'stop-points-vary': 'A signal has several stop points; its first one is kept',
    'time-resampled': (v: Values) => `Rows are ${v.apart_s} apart; states are computed every ${v.step_s}`,
    'time-interpolated': (v: Values) => `Steps are ${v.apart_s} apart; states every 0.1 s are interpolated linearly`,
    'times-ignored': (v: Values) =>
      `${v.found} times for ${v.steps} steps, or a time is not finite; steps of 0.1 s are assumed`,
    'times-incomplete': 'Some steps have no time; steps of 0.1 s are assumed',
    'times-irregular': 'Steps are not 0.1 s apart; they are read as if they were',
    'types-assumed': 'The table has no types; all road users count as vehicles',
    'types-unknown': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} road user has an unknown type; it is shown but not generated`,
        other: `${v.count} road users have an unknown type; they are shown but not generated`,
      }),
    'velocities-derived': 'Velocities are derived from positions and times',
  },
});
