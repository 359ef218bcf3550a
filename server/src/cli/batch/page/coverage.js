// The coverage: buckets of each dimension, two dimensions against each other, the space before and after generation.
'use strict';

/** Words of the states of buckets. */
const STATES = {
  full: 'full',
  thin: 'thin',
  'left-out': 'hole: tried, left out',
  'never-tried': 'hole: never tried',
  nothing: '',
};
/** Most squares of the picture of the space. */
const MOST_SQUARES = 4000;

/** What a click on a bucket does: buckets by the places of their dimensions. */
/** @type {(buckets: [number, number][]) => void} */
let onBuckets = () => {};

/**
 * A bucket is the last of its dimension and has the cases without the fact.
 * @param {Dimension} of
 * @param {number} bucket
 */
const isNothing = (of, bucket) => of.buckets[bucket].state === 'nothing';

/** @param {{ kept: number, tried: number }} of */
function stateOf(of) {
  if (of.kept >= data.coverage.full) return 'full';
  if (of.kept > 0) return 'thin';
  return of.tried > 0 ? 'left-out' : 'never-tried';
}

/** @param {string} state */
const stateWord = (state) => /** @type {Record<string, string>} */ (STATES)[state] ?? state;

/** @param {Dimension} of @param {number} bucket */
function bucketTitle(of, bucket) {
  const { name } = of.buckets[bucket];
  return of.unit && !isNothing(of, bucket) ? `${name} ${of.unit}` : name;
}

function makeCoverage() {
  const whole = el('coverage');
  const { complete, full } = data.coverage;
  const about = `A bucket with ${full} kept cases or more is full, one with fewer is thin, and one without is a hole.`;
  const open = complete ? '' : ' The batch is not complete: some chunks are missing.';
  const note = make('p', { class: 'note' }, about + open);
  whole.replaceChildren(makeSpace(), note, makeKey(), makePairs(), makeDimensions());
}

function makeKey() {
  const key = make('p', { class: 'key' });
  for (const state of ['full', 'thin', 'left-out', 'never-tried'])
    key.append(make('span', { class: `state ${state}` }, stateWord(state)), ' ');
  return key;
}

/** The two numbers before and after generation, with a square for each cell of the space. */
function makeSpace() {
  const { recorded, kept, both, new_cells: added, dimensions } = data.coverage.diversity;
  const section = make('section', { 'aria-label': 'Diversity' });
  section.append(make('h2', {}, 'Diversity before and after generation'));
  const table = make('table', { class: 'numbers' });
  const head = make('tr');
  head.append(make('td'));
  for (const title of ['Cases', 'Cells reached', 'Entropy, bits']) head.append(make('th', { scope: 'col' }, title));
  table.append(head);
  const rows = /** @type {[string, Diversity][]} */ ([
    ['Recorded', recorded],
    ['Generated and kept', kept],
    ['Both', both],
  ]);
  for (const [name, of] of rows) {
    const row = make('tr');
    row.append(make('th', { scope: 'row' }, name));
    for (const value of [of.cases.toLocaleString('en'), of.cells.toLocaleString('en'), of.entropy_bits.toFixed(2)])
      row.append(make('td', {}, value));
    table.append(row);
  }
  const words = dimensions.map(wordOf).join(', ').toLowerCase();
  const news = `${added.toLocaleString('en')} cells have a kept case and no recording.`;
  const cells = `A cell is one bucket of each of: ${words}. ${news}`;
  section.append(table, make('p', { class: 'note' }, cells), makeSquares());
  return section;
}

/** Each square is a cell: recorded alone, generated alone, or both. */
function makeSquares() {
  const shown = [...data.space].filter(([a, b]) => a + b > 0);
  /** @param {[number, number]} of */
  const group = ([recorded, kept]) => (recorded && kept ? 1 : recorded ? 0 : 2);
  shown.sort((a, b) => group(a) - group(b) || b[0] + b[1] - a[0] - a[1]);
  const squares = make('div', { class: 'squares', role: 'img', 'aria-label': 'Cells of the space' });
  const names = ['recorded', 'in-both', 'generated'];
  for (const of of shown.slice(0, MOST_SQUARES))
    squares.append(make('i', { class: names[group(of)], title: `${of[0]} recorded, ${of[1]} kept` }));
  const key = make('p', { class: 'key' });
  for (const [name, word] of [
    ['recorded', 'recorded'],
    ['in-both', 'recorded and generated'],
    ['generated', 'generated'],
  ])
    key.append(make('i', { class: name }), ` ${word}  `);
  const both = make('div');
  both.append(squares, key);
  return both;
}

/** Two dimensions against each other. */
function makePairs() {
  const section = make('section', { 'aria-label': 'Two dimensions' });
  section.append(make('h2', {}, 'Two dimensions'));
  const chosen = /** @type {[number, number]} */ ([placeOf('layout'), placeOf('ttc_s')]);
  const selects = chosen.map((place, i) => {
    const choice = make('select', { 'aria-label': i ? 'Columns' : 'Rows', id: i ? 'columns' : 'lines' });
    DIMENSIONS.forEach((of, at) => choice.append(make('option', { value: String(at) }, titleOf(of))));
    choice.value = String(place);
    choice.addEventListener('change', () => {
      chosen[i] = Number(choice.value);
      show();
    });
    return choice;
  });
  const place = make('div', { class: 'wide' });
  const sum = make('p', { class: 'note' });
  function show() {
    const [a, b] = chosen;
    place.replaceChildren(a === b ? make('p', { class: 'note' }, 'Choose two dimensions.') : makeMatrix(a, b));
    const pair = pairOf(a, b)?.pair;
    sum.textContent = pair
      ? `${pair.full} full, ${pair.thin} thin, ${pair.left_out} holes left out, ${pair.never_tried} holes never tried.`
      : '';
  }
  const choices = make('p', { class: 'choices' });
  choices.append(selects[0], ' by ', selects[1]);
  section.append(choices, place, sum);
  show();
  return section;
}

/** @param {number} a @param {number} b */
function pairOf(a, b) {
  const names = [DIMENSIONS[a].name, DIMENSIONS[b].name];
  const swapped = a > b;
  const [first, second] = swapped ? [names[1], names[0]] : names;
  const pair = data.coverage.pairs.find(({ dimensions: [p, q] }) => p === first && q === second);
  return pair && { pair, swapped };
}

/**
 * The buckets of a dimension; that of cases without the fact only where there are some.
 * @param {Dimension} of
 */
const bucketsShown = (of) =>
  of.buckets.map((_, at) => at).filter((at) => !isNothing(of, at) || of.buckets[at].tried > 0);

/** @param {number} a @param {number} b */
function makeMatrix(a, b) {
  const [lines, columns] = [DIMENSIONS[a], DIMENSIONS[b]];
  const found = pairOf(a, b);
  /** @type {Map<string, Cell>} */
  const cells = new Map();
  for (const cell of found?.pair.cells ?? []) {
    const [p, q] = found?.swapped ? [cell.buckets[1], cell.buckets[0]] : cell.buckets;
    cells.set(`${p} ${q}`, cell);
  }
  const table = make('table', { class: 'matrix' });
  const head = make('tr');
  head.append(make('td'));
  const shown = bucketsShown(columns);
  for (const j of shown) head.append(make('th', { scope: 'col' }, bucketTitle(columns, j)));
  table.append(head);
  for (const i of bucketsShown(lines)) {
    const row = make('tr');
    row.append(make('th', { scope: 'row' }, bucketTitle(lines, i)));
    for (const j of shown) {
      const cell = cells.get(`${i} ${j}`) ?? { recorded: 0, tried: 0, kept: 0 };
      const nothing = isNothing(lines, i) || isNothing(columns, j);
      const state = nothing ? 'nothing' : stateOf(cell);
      const buckets = /** @type {[number, number][]} */ ([
        [a, i],
        [b, j],
      ]);
      row.append(makeCell(cell, state, buckets));
    }
    table.append(row);
  }
  return table;
}

/**
 * @param {{ recorded: number, tried: number, kept: number, left_out_by?: number }} cell
 * @param {string} state
 * @param {[number, number][]} buckets
 */
function makeCell(cell, state, buckets) {
  const made = make('td', { class: `cell ${state}` });
  const why = cell.left_out_by === undefined ? '' : ` by ${data.coverage.conditions[cell.left_out_by]}`;
  const title = `${stateWord(state)}${why}: ${cell.kept} kept, ${cell.tried} tried, ${cell.recorded} recorded`;
  made.title = title.replace(/^: /, '');
  if (cell.kept) {
    const button = make('button', { type: 'button', 'aria-label': `${title}. Show these cases` }, String(cell.kept));
    button.addEventListener('click', () => onBuckets(buckets));
    made.append(button);
  } else made.textContent = cell.tried ? '0' : state === 'nothing' ? '' : '–';
  return made;
}

/** All dimensions, each with its buckets. */
function makeDimensions() {
  const section = make('section', { 'aria-label': 'Dimensions' });
  section.append(make('h2', {}, 'Dimensions'));
  DIMENSIONS.forEach((of, place) => {
    const table = make('table', { class: 'buckets' });
    const head = make('tr');
    for (const title of [titleOf(of), 'Recorded', 'Tried', 'Kept', 'Kept, s', 'Kept, m', 'State'])
      head.append(make('th', { scope: 'col' }, title));
    table.append(head);
    of.buckets.forEach((bucket, at) => {
      const row = make('tr');
      row.append(make('th', { scope: 'row' }, bucketTitle(of, at)));
      for (const value of [bucket.recorded, bucket.tried]) row.append(make('td', {}, value.toLocaleString('en')));
      row.append(makeCell({ ...bucket, left_out_by: undefined }, bucket.state, [[place, at]]));
      for (const value of [bucket.kept_s, bucket.kept_m])
        row.append(make('td', {}, Math.round(value).toLocaleString('en')));
      const by = Object.entries(bucket.left_out_by ?? {}).sort((p, q) => q[1] - p[1]);
      const why = bucket.state === 'left-out' && by.length ? ` by ${by[0][0]} (${by[0][1]})` : '';
      row.append(make('td', { class: 'why' }, stateWord(bucket.state) + why));
      table.append(row);
    });
    section.append(table);
  });
  return section;
}
