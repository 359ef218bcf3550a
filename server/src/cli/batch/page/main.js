// The page as a whole: parts, filters, and the case that is shown.
'use strict';

/** Address at which a server of this machine answers. */
const SERVER = 'http://127.0.0.1:8080';

/** Seconds; the case plays; time of the last frame. */
const player = { time: 0, isPlaying: false, before: 0 };

/** @param {string} name */
function showPart(name) {
  for (const part of ['cases', 'coverage']) {
    el(part).hidden = part !== name;
    el(`tab-${part}`).setAttribute('aria-selected', String(part === name));
  }
  if (name === 'coverage' && !el('coverage').firstChild) makeCoverage();
  if (name === 'cases') showRows();
}

function makeFilters() {
  const selects = el('selects');
  DIMENSIONS.forEach((of, place) => {
    const choice = make('select', { 'aria-label': titleOf(of), 'data-dimension': of.name });
    choice.append(make('option', { value: '' }, `${wordOf(of.name)}: all`));
    of.buckets.forEach((_, at) => choice.append(make('option', { value: String(at) }, bucketTitle(of, at))));
    choice.addEventListener('change', () => {
      filters.buckets[place] = choice.value === '' ? null : Number(choice.value);
      choice.classList.toggle('set', choice.value !== '');
      listCases();
    });
    selects.append(choice);
  });
  el('search').addEventListener('input', () => {
    filters.text = el('search').value;
    listCases();
  });
  el('clear').addEventListener('click', () => setFilters([]));
  el('filters').addEventListener('submit', (/** @type {Event} */ event) => event.preventDefault());
}

/** Sets the filters to these buckets alone. @param {[number, number][]} buckets */
function setFilters(buckets) {
  filters.text = el('search').value = '';
  filters.buckets = DIMENSIONS.map((_, place) => buckets.find(([of]) => of === place)?.[1] ?? null);
  el('selects')
    .querySelectorAll('select')
    .forEach((/** @type {HTMLSelectElement} */ choice, /** @type {number} */ place) => {
      choice.value = String(filters.buckets[place] ?? '');
      choice.classList.toggle('set', choice.value !== '');
    });
  listCases();
}

/** @param {Case | null} of */
function showCase(of) {
  el('detail').hidden = !of;
  player.isPlaying = false;
  if (!of) return;
  el('title').textContent = `${of.code}: ${bucketWord(of, 'situation')}, ${sceneName(of)}`;
  el('what').textContent = of.what;
  const motion = motionOf(of.index);
  player.time = motion ? motion.moment * PICTURE_S : 0;
  el('time').max = String(motion ? lengthOf(motion) : 0);
  el('facts').replaceChildren(...factsOf(of));
  const file = `cases/${of.code}.json`;
  el('commands').textContent = `dragtraffic replay OUT ${of.code} -o ${file}\ndragtraffic serve --data cases/`;
  el('editor').href = `${SERVER}/?scene=file-${of.code}-0`;
  showTime();
}

/** @param {Case} of */
function factsOf(of) {
  const [ttc, pet, gap, actorSpeed, otherSpeed, time] = of.numbers;
  /** @param {number | null} value @param {string} unit */
  const shown = (value, unit) => (value === null ? '–' : `${value.toFixed(2)} ${unit}`);
  const facts = [
    ['Actor', `${of.actor} (${bucketWord(of, 'actor_type')}), ${shown(actorSpeed, 'm/s')}`],
    ['Other', of.other ? `${of.other} (${bucketWord(of, 'other_type')}), ${shown(otherSpeed, 'm/s')}` : 'nobody'],
    ['Meeting', `${bucketWord(of, 'meeting')}, ${bucketWord(of, 'layout')}, at ${shown(time, 's')}`],
    ['First', bucketWord(of, 'first')],
    ['Signal', bucketWord(of, 'signal')],
    ['TTC', shown(ttc, 's')],
    ['PET', shown(pet, 's')],
    ['Gap', shown(gap, 'm')],
    ['Seed', String(of.seed)],
    ['Unit', of.unit],
  ];
  return facts.flatMap(([name, value]) => [make('dt', {}, name), make('dd', {}, value)]);
}

function showTime() {
  const most = Number(el('time').max);
  player.time = Math.min(Math.max(player.time, 0), most);
  el('time').value = String(player.time);
  el('clock').value = `${player.time.toFixed(1)} / ${most.toFixed(1)} s`;
  el('play').textContent = player.isPlaying ? 'Pause' : 'Play';
  if (selected) drawCase(el('view'), selected, player.time);
}

/** @param {boolean} on */
function play(on) {
  player.isPlaying = on && Number(el('time').max) > 0;
  if (player.isPlaying && player.time >= Number(el('time').max)) player.time = 0;
  player.before = performance.now();
  showTime();
  if (player.isPlaying) requestAnimationFrame(tick);
}

/** @param {number} now */
function tick(now) {
  if (!player.isPlaying) return;
  player.time += Math.max(0, now - player.before) / 1000;
  player.before = now;
  if (player.time >= Number(el('time').max)) player.isPlaying = false;
  showTime();
  if (player.isPlaying) requestAnimationFrame(tick);
}

function connect() {
  for (const part of ['cases', 'coverage']) el(`tab-${part}`).addEventListener('click', () => showPart(part));
  onSelect = showCase;
  onBuckets = (buckets) => {
    showPart('cases');
    setFilters(buckets);
  };
  el('table').addEventListener('scroll', showRows, { passive: true });
  el('table').addEventListener('keydown', (/** @type {KeyboardEvent} */ event) => {
    const page = Math.max(1, Math.floor(el('table').clientHeight / ROW_PX) - 1);
    const moves = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    const by = /** @type {Record<string, number>} */ (moves)[event.key];
    if (by === undefined && event.key !== ' ' && event.key !== 'Enter') return;
    if (event.target !== el('table')) return;
    event.preventDefault();
    if (by === undefined) play(!player.isPlaying);
    else moveSelection(by);
  });
  el('play').addEventListener('click', () => play(!player.isPlaying));
  el('time').addEventListener('input', () => {
    player.isPlaying = false;
    player.time = Number(el('time').value);
    showTime();
  });
  el('copy').addEventListener('click', () => void navigator.clipboard?.writeText(el('commands').textContent));
  new ResizeObserver(() => {
    showRows();
    redrawRows();
    showTime();
  }).observe(el('cases'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    colours = {};
    redrawRows();
    showTime();
  });
}

function about() {
  const { units, kept, scenes } = data;
  /** @param {number} count */
  const number = (count) => count.toLocaleString('en');
  const left = CASES.length < kept ? `; the ${number(CASES.length)} with the least times to collision are here` : '';
  el('about').textContent = `${number(kept)} kept of ${number(units)} units, ${number(scenes.length)} scenes${left}`;
}

about();
makeFilters();
makeHead();
connect();
listCases();
