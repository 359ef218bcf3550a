// The table: only the rows in view exist, so ten thousand cases scroll as fast as ten.
'use strict';

/** Height of a row, pixels, as the style has it. */
const ROW_PX = 60;
/** Rows beyond the view that exist, so that a step of the wheel shows no gap. */
const BEYOND = 4;

/** @type {Case[]} */
let listed = [];
/** @type {Case | null} */
let selected = null;
/** @type {(of: Case | null) => void} */
let onSelect = () => {};
/** @type {Map<number, HTMLElement>} */
const rowsShown = new Map();
/** Rows that have left the view. @type {HTMLElement[]} */
const spare = [];
/** @type {WeakMap<HTMLElement, Case>} */
const caseOfRow = new WeakMap();
/** Canvases whose picture is due. @type {Map<HTMLCanvasElement, Case>} */
const picturesDue = new Map();

/**
 * @param {string} tag
 * @param {Record<string, string>} [attributes]
 * @param {string} [text]
 * @returns {any}
 */
function make(tag, attributes = {}, text = '') {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text) made.textContent = text;
  return made;
}

function makeHead() {
  const head = el('head');
  head.replaceChildren(make('span', { role: 'columnheader', class: 'thumb' }, 'Picture'));
  for (const column of COLUMNS) {
    const cell = make('span', { role: 'columnheader', style: `width:${column.width}px` });
    if (column.name === order.column) cell.setAttribute('aria-sort', order.rises ? 'ascending' : 'descending');
    const arrow = column.name === order.column ? (order.rises ? ' ↑' : ' ↓') : '';
    const button = make('button', { type: 'button', class: column.isNumber ? 'number' : '' }, column.title + arrow);
    button.addEventListener('click', () => {
      order.rises = order.column === column.name ? !order.rises : true;
      order.column = column.name;
      makeHead();
      listCases();
    });
    cell.append(button);
    head.append(cell);
  }
}

/** Lists the cases that the filters leave, from the top. */
function listCases() {
  listed = chosenCases();
  const table = el('table');
  el('rows').style.height = `${listed.length * ROW_PX}px`;
  table.setAttribute('aria-rowcount', String(listed.length + 1));
  table.scrollTop = 0;
  spare.push(...rowsShown.values());
  rowsShown.clear();
  const all = CASES.length;
  const ofAll = listed.length === all ? '' : ` of ${all.toLocaleString('en')}`;
  el('count').value = `${listed.length.toLocaleString('en')}${ofAll} cases`;
  if (!selected || !listed.includes(selected)) select(listed[0] ?? null);
  showRows();
}

/** Fills the rows in view. Rows that have left the view are filled again: new pictures would make scrolling stutter. */
function showRows() {
  const table = el('table');
  const top = Math.max(0, table.scrollTop);
  const first = Math.max(0, Math.floor(top / ROW_PX) - BEYOND);
  const end = Math.min(listed.length, Math.ceil((top + table.clientHeight) / ROW_PX) + BEYOND);
  for (const [at, row] of rowsShown)
    if (at < first || at >= end) {
      spare.push(row);
      rowsShown.delete(at);
    }
  for (let at = first; at < end; at++)
    if (!rowsShown.has(at)) {
      const row = spare.pop() ?? makeRow();
      fillRow(row, listed[at], at);
      rowsShown.set(at, row);
    }
  spare.splice(0).forEach((row) => row.remove());
  drawSoon();
}

/** A row with a picture and a cell for each column. */
function makeRow() {
  const row = make('div', { role: 'row', class: 'row' });
  const thumb = make('span', { role: 'gridcell', class: 'thumb' });
  thumb.append(make('canvas', { 'aria-hidden': 'true' }));
  row.append(thumb);
  for (const { width, isNumber } of COLUMNS)
    row.append(make('span', { role: 'gridcell', style: `width:${width}px`, class: isNumber ? 'number' : '' }));
  row.addEventListener('click', () => select(caseOfRow.get(row) ?? null));
  el('rows').append(row);
  return row;
}

/**
 * @param {HTMLElement} row
 * @param {Case} of
 * @param {number} at
 */
function fillRow(row, of, at) {
  caseOfRow.set(row, of);
  row.id = `case-${of.index}`;
  row.style.transform = `translateY(${at * ROW_PX}px)`;
  row.setAttribute('aria-rowindex', String(at + 2));
  row.setAttribute('aria-selected', String(of === selected));
  COLUMNS.forEach((column, i) => {
    const cell = /** @type {HTMLElement} */ (row.children[i + 1]);
    cell.title = cell.textContent = column.shown(of);
  });
  const canvas = row.querySelector('canvas');
  if (canvas) picturesDue.set(canvas, of);
}

let isDrawing = false;
/** Draws the pictures of the rows in view, for a few milliseconds in each frame. */
function drawSoon() {
  if (isDrawing) return;
  isDrawing = true;
  requestAnimationFrame(() => {
    isDrawing = false;
    const until = performance.now() + 6;
    for (const [canvas, of] of picturesDue) {
      picturesDue.delete(canvas);
      if (canvas.isConnected) drawCase(canvas, of, null);
      if (performance.now() > until) break;
    }
    if (picturesDue.size) drawSoon();
  });
}

/** @param {Case | null} of */
function select(of) {
  selected = of;
  if (of) el('table').setAttribute('aria-activedescendant', `case-${of.index}`);
  for (const [at, row] of rowsShown) row.setAttribute('aria-selected', String(listed[at] === of));
  onSelect(of);
}

/** Moves the selection by so many rows and keeps it in view. @param {number} by */
function moveSelection(by) {
  if (!listed.length) return;
  const now = selected ? listed.indexOf(selected) : -1;
  const at = Math.min(Math.max(now + by, 0), listed.length - 1);
  const table = el('table');
  const head = el('head').offsetHeight;
  if (at * ROW_PX < table.scrollTop) table.scrollTop = at * ROW_PX;
  const below = (at + 1) * ROW_PX + head - table.clientHeight;
  if (below > table.scrollTop) table.scrollTop = below;
  select(listed[at]);
}

/** Draws all pictures in view again, as after a change of the theme. */
function redrawRows() {
  for (const [at, row] of rowsShown) {
    const canvas = row.querySelector('canvas');
    if (canvas) picturesDue.set(canvas, listed[at]);
  }
  drawSoon();
}
