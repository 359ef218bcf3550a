// The warnings of the readers of files, by their codes: see `messages.ts`.
import type { Values } from './messages';
import { table } from './table';

export const TEXTS = table('file-messages', {
  lists: { subject: { 'road-users': 'road users', 'map-features': 'map features', tracks: 'tracks' } },
  sentences: {
    'agents-near-ego': (v: Values) => `${v.found} road users; the ${v.kept} nearest to the ego are kept`,
    'agents-near-centre': (v: Values) =>
      `${v.found} road users; the ${v.kept} nearest to their centre are kept, within ${v.within_m} of the origin`,
    'agents-with-used-id': (v: Values) => `${v.count} obstacles with the id of another obstacle are left out`,
    'agents-outside-network': (v: Values) =>
      `${v.count} of ${v.found} road users lie outside the network: it belongs to another recording, or positions are degrees (fcd-output.geo) rather than metres`,
    'areas-too-far': (v: Values) =>
      `${v.count} drivable areas reach farther than ${v.within_m} from the centre and are left out`,
    'crossing-areas': 'Drivable areas overlap too often to find the edges of the road',
    'crossing-lanelets': 'Lanelets overlap too often to find the edges of the road',
    'crossing-roads': 'Roads overlap too often to find their edges',
    'cut-in-scenes': (v: Values) => `The recording is longer than a scene: it is cut in scenes of ${v.each_s}`,
    'elements-unread': (v: Values) => `${v.count} elements have no place in a scene and are left out`,
    'features-unread': (v: Values) => `${v.count} map features of unknown kind or with too few points are left out`,
    'futures-unread': (v: Values) =>
      `${v.count} possible motions are empty, impossible or beyond the limit, and are left out`,
    'goals-beyond-first': (v: Values) => `${v.count} further goals of the same road users are left out`,
    'goals-are-regions': (v: Values) => `${v.count} goals are regions; their centres are taken`,
    'headings-derived': 'Headings are derived from the motion; a standing road user keeps its last heading',
    'headings-in-degrees': 'Headings are in degrees and were converted to radians',
    'ids-renumbered': "Lanes and junctions have numbers instead of SUMO's ids",
    'ids-replaced': (v: Values) =>
      `${v.count} ${v.subject} got other ids: an id occurs once and has letters, digits and _ . : - alone`,
    'ids-respelled': (v: Values) => `${v.count} ids were respelled or got a suffix`,
    'ids-suffixed': (v: Values) => `${v.count} ${v.subject} repeat an id and got a suffix`,
    'identities-joined': (v: Values) =>
      `${v.count} road users had a second id and are joined: ${v.pairs} (and ${v.more} more)`,
    'identities-joined-all': (v: Values) => `${v.count} road users had a second id and are joined: ${v.pairs}`,
    jumps: (v: Values) => `Road users were moved elsewhere ${v.count} times; these gaps stay gaps`,
    'lanelets-unusable': (v: Values) => `${v.count} lanelets without two sides, or not for traffic, are left out`,
    'lanelets-with-used-id': (v: Values) => `${v.count} lanelets with the id of another lanelet are left out`,
    'lanes-closed': (v: Values) => `${v.count} lanes open to no road user (rails, strips) are left out`,
    'lane-links-derived': 'The file does not link its lanes: a lane that ends where another one begins is linked to it',
    'lane-segments-unusable': (v: Values) => `${v.count} lane segments without two sides are left out`,
    'left-hand': 'Traffic keeps to the left, as it does in this region',
    'left-hand-as-right': 'Traffic keeps to the left; kerbs and middle lines are drawn as for traffic on the right',
    'lines-approximated': (v: Values) => `${v.count} painted lines have a sort or colour without a word of its own`,
    'map-fault': (v: Values) => `${v.first}`,
    'map-faults': (v: Values) => `${v.first} (and ${v.more} more)`,
    'map-heights-dropped': 'The network has heights; the map is flat',
    'map-lacks-lanelets': 'The file has no lanelets: the scene has no map',
    'map-missing': 'No map came with the scenario (log_map_archive_*.json): the scene has no lanes',
    'moved-by-metadrive': 'MetaDrive moved and turned the file; the place of the recording is unknown',
    'network-missing': 'No network came with the recording: the scene has no lanes and no signals',
    'now-step-moved': (v: Values) => `The current step is ${v.now} of ${v.steps}: the last step is taken`,
    'obstacles-absent': (v: Values) => `${v.count} obstacles are absent at all steps that are kept`,
    'obstacles-are-sets': (v: Values) =>
      `${v.count} obstacles have possible areas instead of motion: their first state is kept`,
    'obstacles-uncertain': (v: Values) => `${v.count} obstacles have uncertain states; the centres are taken`,
    'obstacles-unplaced': (v: Values) =>
      `${v.count} obstacles without a place, or without a size of at most 60 m, are left out`,
    'parts-left-out': (v: Values) => `Left out: ${v.parts}`,
    'passengers-left-out': (v: Values) => `${v.count} containers and passengers are left out so far`,
    'programs-beyond-last': 'A signal has several programs; the last one is shown',
    'projection-dropped': 'Positions stay in the frame of the network; its projection is not kept',
    'recording-heights-dropped': 'The recording has heights; the scene is flat',
    'shapes-boxed': (v: Values) => `${v.count} obstacles are no boxes: boxes around them are taken`,
    'signal-links-unprogrammed': (v: Values) => `${v.count} links of signals have no program and are left out`,
    'signals-empty': (v: Values) => `${v.count} signals without a lane or without states are left out`,
    'signals-held': (v: Values) => `${v.count} signals respond to traffic; they keep the times of their plan`,
    'signals-made': (v: Values) =>
      `${v.count} signal heads at ${v.junctions} junctions have no program; they got fixed times`,
    'signals-made-near': (v: Values) =>
      `${v.count} signal heads at ${v.junctions} junctions have no program; they got fixed times, and the ${v.kept} nearest to the centre are kept`,
    'signals-near-centre': (v: Values) => `${v.found} signals; the ${v.kept} nearest to the centre are kept`,
    'signals-over-limit': (v: Values) => `${v.count} signals beyond the limit of ${v.kept} are left out`,
    'signals-without-lane': (v: Values) => `${v.count} signals control no lane of the map and are left out`,
    'sizes-assumed': (v: Values) => `${v.count} road users have the default size of their type`,
    'sizes-assumed-by-name': (v: Values) => `${v.count} road users have the default size for the name of their type`,
    'sizes-assumed-car': (v: Values) => `${v.count} planning problems have no size: that of a car is taken`,
    'sizes-vary-median': (v: Values) => `${v.count} road users change size; the median is kept`,
    'sizes-vary-now': (v: Values) => `${v.count} road users change size; the size at the current step is kept`,
    'steps-beyond-limit': (v: Values) => `The file lasts ${v.length_s}; the first ${v.kept} steps of 0.1 s are kept`,
    'steps-coarse': (v: Values) => `Time steps are ${v.apart_s} apart; gaps longer than ${v.filled_s} stay gaps`,
    'stop-points-vary': 'A signal has several stop points; its first one is kept',
    'time-resampled': (v: Values) => `Rows are ${v.apart_s} apart; states are computed every ${v.step_s}`,
    'time-interpolated': (v: Values) => `Steps are ${v.apart_s} apart; states every 0.1 s are interpolated linearly`,
    'times-ignored': (v: Values) =>
      `${v.found} times for ${v.steps} steps, or a time is not finite; steps of 0.1 s are assumed`,
    'times-incomplete': 'Some steps have no time; steps of 0.1 s are assumed',
    'times-irregular': 'Steps are not 0.1 s apart; they are read as if they were',
    'types-assumed': 'The table has no types; all road users count as vehicles',
    'types-unknown': (v: Values) => `${v.count} road users have an unknown type; they are shown and never generated`,
    'velocities-derived': 'Velocities are derived from positions and times',
  },
});
