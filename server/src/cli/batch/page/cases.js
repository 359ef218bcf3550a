// The data of the page, and which cases the filters leave in which order.
'use strict';

/**
 * @typedef {{ name: string, state: string, recorded: number, tried: number, kept: number,
 *   left_out_by?: Record<string, number>, recorded_s: number, recorded_m: number, kept_s: number,
 *   kept_m: number }} Bucket
 * @typedef {{ name: string, unit?: string, buckets: Bucket[] }} Dimension
 * @typedef {{ buckets: [number, number], recorded: number, tried: number, kept: number, left_out_by?: number }} Cell
 * @typedef {{ dimensions: [string, string], full: number, thin: number, left_out: number, never_tried: number,
 *   cells: Cell[] }} Pair
 * @typedef {{ cases: number, cells: number, entropy_bits: number }} Diversity
 * @typedef {{ complete: boolean, full: number, conditions: string[], dimensions: Dimension[], pairs: Pair[],
 *   diversity: { dimensions: string[], recorded: Diversity, kept: Diversity, both: Diversity, new_cells: number } }}
 *   Coverage
 * @typedef {[string | null, string | null, string | null, string | null, number, (number | null)[], (number | null)[]]}
 *   CaseBody
 * @typedef {{ units: number, kept: number, scenes: string[], cases: [number | null, string, CaseBody][],
 *   coverage: Coverage, space: [number, number][] }} PageData
 * @typedef {{ index: number, scene: number | null, unit: string, code: string, actor: string, other: string,
 *   what: string, seed: number, buckets: (number | null)[], numbers: (number | null)[] }} Case
 */

/**
 * An element of the page.
 * @param {string} id
 * @returns {any}
 */
const el = (id) => document.getElementById(id);

/** @type {PageData} */
const data = JSON.parse(el('data').textContent);
const DIMENSIONS = data.coverage.dimensions;
/** Numbers of a case by their places. */
const NUMBERS = ['ttc_s', 'pet_s', 'gap_m', 'actor_mps', 'other_mps', 'time_s'];

/** @type {Case[]} */
const CASES = data.cases.map(([scene, unit, body], index) => {
  const [code, actor, other, what, seed, buckets, numbers] = body;
  return {
    ...{ index, scene, unit, code: code ?? unit, actor: actor ?? '', other: other ?? '', what: what ?? '', seed },
    ...{ buckets, numbers },
  };
});

/** Words of the documents as the page shows them. */
const WORDS = {
  layout: 'Road',
  signal: 'Signal',
  situation: 'Situation',
  actor_type: 'Actor',
  other_type: 'Other',
  meeting: 'Meeting',
  first: 'First',
  ttc_s: 'TTC',
  pet_s: 'PET',
  gap_m: 'Gap',
  actor_mps: 'Actor speed',
  other_mps: 'Other speed',
};

/** @param {string} name */
const wordOf = (name) => /** @type {Record<string, string>} */ (WORDS)[name] ?? name;
/** @param {Dimension} of */
const titleOf = (of) => (of.unit ? `${wordOf(of.name)}, ${of.unit}` : wordOf(of.name));
/** @param {string} name */
const placeOf = (name) => DIMENSIONS.findIndex((of) => of.name === name);

/**
 * The word of a case in a dimension.
 * @param {Case} of
 * @param {string} name
 */
function bucketWord(of, name) {
  const place = placeOf(name);
  const bucket = of.buckets[place];
  return bucket == null ? '' : DIMENSIONS[place].buckets[bucket].name;
}

/** @param {Case} of */
const sceneName = (of) => (of.scene === null ? '' : data.scenes[of.scene]);

/** What the filters say: a text, and for each dimension a bucket or null. */
const filters = {
  text: '',
  /** @type {(number | null)[]} */
  buckets: DIMENSIONS.map(() => null),
};

/**
 * Columns of the table: title, width in pixels, what a cell shows, and what it is sorted by.
 * @type {{ name: string, title: string, width: number, isNumber: boolean, shown: (of: Case) => string,
 *   key: (of: Case) => string | number | null }[]}
 */
const COLUMNS = [
  textColumn('code', 'Code', 70, (of) => of.code),
  numberColumn('ttc', 'TTC s', 58, 0),
  numberColumn('pet', 'PET s', 58, 1),
  numberColumn('gap', 'Gap m', 62, 2),
  numberColumn('speed', 'm/s', 52, 3),
  textColumn('situation', 'Situation', 96, (of) => bucketWord(of, 'situation')),
  textColumn('road', 'Road', 76, (of) => bucketWord(of, 'layout')),
  textColumn('meeting', 'Meeting', 76, (of) => bucketWord(of, 'meeting')),
  textColumn('other', 'With', 78, (of) => bucketWord(of, 'other_type')),
  textColumn('first', 'First', 52, (of) => bucketWord(of, 'first')),
  textColumn('scene', 'Scene', 150, sceneName),
];

/**
 * @param {string} name
 * @param {string} title
 * @param {number} width
 * @param {(of: Case) => string} shown
 */
function textColumn(name, title, width, shown) {
  return { name, title, width, isNumber: false, shown, key: shown };
}

/**
 * @param {string} name
 * @param {string} title
 * @param {number} width
 * @param {number} place
 */
function numberColumn(name, title, width, place) {
  /** @param {Case} of */
  const key = (of) => of.numbers[place];
  /** @param {Case} of */
  const shown = (of) => key(of)?.toFixed(2) ?? '–';
  return { name, title, width, isNumber: true, shown, key };
}

/** Column and direction that the table is sorted by. */
const order = { column: 'ttc', rises: true };

/** All that a text is looked for in, made at the first search. */
const haystacks = /** @type {string[]} */ ([]);

/** @param {Case} of */
function haystack(of) {
  const texts = [of.code, of.unit, sceneName(of), of.actor, of.other, of.what];
  return (haystacks[of.index] ??= texts.join(' ').toLowerCase());
}

/** The cases that the filters leave, sorted. A case without a number stands last. */
function chosenCases() {
  const words = filters.text.toLowerCase().split(/\s+/).filter(Boolean);
  const asked = filters.buckets.map((bucket, i) => ({ bucket, i })).filter(({ bucket }) => bucket !== null);
  const chosen = CASES.filter(
    (of) =>
      asked.every(({ bucket, i }) => of.buckets[i] === bucket) && words.every((word) => haystack(of).includes(word)),
  );
  const column = COLUMNS.find(({ name }) => name === order.column) ?? COLUMNS[0];
  const way = order.rises ? 1 : -1;
  const keys = new Map(chosen.map((of) => [of, column.key(of)]));
  return chosen.sort((a, b) => {
    const [x, y] = [keys.get(a) ?? null, keys.get(b) ?? null];
    if (x === y) return a.index - b.index;
    if (x === null || y === null) return x === null ? 1 : -1;
    return (x < y ? -1 : 1) * way;
  });
}
