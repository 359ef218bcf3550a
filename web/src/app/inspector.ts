// The inspector of one road user: verdict on the goal, start, goal, six futures, who changed.
import type { Context } from '../actions/context';
import { canChange, hasGoal, touched, startPose, type Agent } from '../model/scene';
import { deg, rad, wrapAngle, type Vec } from '../model/geometry';
import { LETTERS, isSettled, reachWords } from '../model/futures';
import { endPose, endsBefore, poseAt } from '../model/motion';
import { topSpeed } from '../model/domain';
import { nearestLanes } from '../model/lanemap';
import { comparedWithLog } from '../model/changes';
import { fromUnit, metres, num, seconds, speedText, toUnit } from '../model/units';
import {
  pickFuture,
  remedies,
  resize,
  shownPose,
  snapToNearest,
  toggleField,
  withField,
  goalTime,
} from '../edit/moves';
import { laneWords } from '../edit/snap';
import type { Field, Part } from '../edit/editor';
import { actionButton, iconButton } from './buttons';
import { h, swap, type Child } from './dom';
import { icon } from './icons';
import { numberField } from './numberfield';

export function agentPanel(c: Context, id: string): HTMLElement {
  const { editor } = c;
  const first = editor.scene.peek()!.agents.get(id)!;
  const agent = (): Agent => editor.scene.value?.agents.get(id) ?? first;
  const type = first.parked ? 'parked' : first.type;
  const where = () => {
    const a = agent(),
      p = startPose(a);
    if (!p) return `Appears at ${seconds(a.log.valid[0] ? a.log.valid[0][0] / 10 : 0)}`;
    return `${a.parked ? 'Parked' : sentenceCase(laneWords(editor.scene.value!.map, a, p.x, p.y, p.heading))} · id ${a.id}`;
  };
  return h(
    'div',
    { class: 'swap' },
    h(
      'div',
      { class: 'ih' },
      h('div', { class: `ag t-${type}` }, icon(first.kind, 22)),
      h('div', { class: 'grow' }, h('h2', null, first.name), h('p', null, where)),
      iconButton(c, 'follow'),
      iconButton(c, 'zoom-selection'),
    ),
    canChange(first)
      ? [
          h(
            'div',
            { class: 'swap' },
            swap(
              () => hintKey(c, agent()),
              () => hint(c, agent()),
            ),
          ),
          swap(
            () => c.editor.motion.value.warnings?.get(id)?.join('|') ?? '',
            () => warnings(c, id),
          ),
          startSection(c, agent),
          goalSection(c, agent),
          futuresSection(c, agent),
          changesSection(c),
          h('div', { class: 'grow' }),
          h(
            'div',
            { class: 'sect foot' },
            swap(
              () => hasGoal(agent().goal),
              () =>
                hasGoal(agent().goal)
                  ? actionButton(c, 'clear-goal', { class: 'line', icon: 'flag', size: 15 })
                  : actionButton(c, 'set-goal', { class: 'goal', size: 15, key: true }),
            ),
            swap(
              () => touched(agent()),
              () => (touched(agent()) ? actionButton(c, 'reset-agent', { class: 'line', icon: '', size: 15 }) : null),
            ),
          ),
        ]
      : h(
          'div',
          { class: 'sect last' },
          h(
            'p',
            { class: 'sec' },
            first.type === 'other'
              ? 'Objects of this kind are shown but not changed.'
              : `Only road users that are there at 0.0 s can be changed. This one appears at ${seconds((first.log.valid[0]?.[0] ?? 0) / 10)}.`,
          ),
        ),
  );
}

function warnings(c: Context, id: string): HTMLElement | null {
  const list = c.editor.motion.peek().warnings?.get(id);
  return list?.length
    ? h(
        'div',
        { class: 'sect' },
        list.map((w) => h('div', { class: 'hint plain' }, icon('warn', 17), h('div', { class: 'tx' }, w))),
      )
    : null;
}

const sentenceCase = (s: string): string => s.charAt(0).toUpperCase() + s.slice(1);

// ---------------------------------------------------------------- the verdict

interface Verdict {
  kind: 'ok' | 'near' | 'plain';
  icon: string;
  title: string;
  words: string;
  remedies: boolean;
  snap?: boolean;
}

function verdict(c: Context, a: Agent): Verdict | null {
  const { editor: e } = c;
  if (e.away.value && e.motion.value.stale)
    return {
      kind: 'near',
      icon: 'warn',
      title: 'Futures are out of date',
      words: 'They will be worked out again when the generator answers.',
      remedies: false,
    };
  const live =
    e.liveReach.value?.id === a.id
      ? e.liveReach.value.reach
      : !e.drag.value && !e.motion.value.stale
        ? (e.motion.value.reach.get(a.id) ?? null)
        : null;
  const local = e.localReach.value;
  if (a.goal.pos && (live ? live.status === 'unreachable' : local && local.kind !== 'ok')) {
    return {
      kind: 'near',
      icon: 'warn',
      remedies: true,
      ...(live ? reachWords(live, a.goal.time) : { title: local!.title, words: local!.words }),
    };
  }
  if (e.drag.value)
    return local && a.goal.pos
      ? { kind: 'ok', icon: 'check', title: local.title, words: local.words, remedies: false }
      : null;
  if (
    a.goal.pos &&
    a.type === 'vehicle' &&
    !nearestLanes(
      e.scene.value!.map,
      a.goal.pos[0],
      a.goal.pos[1],
      null,
      4,
      (l) => l.kind === 'road' || l.kind === 'other',
    ).length
  )
    return {
      kind: 'plain',
      icon: 'warn',
      title: 'There is no lane here.',
      words: 'Cars may still be put here, but the futures will be rough.',
      remedies: false,
      snap: true,
    };
  const log = e.layers.value.log ? comparedWithLog(a, e.motionFor(a), e.scene.value!.duration) : null;
  if (log)
    return {
      kind: 'plain',
      icon: 'eye',
      title: 'Compared with the log',
      words: `${log.words} Furthest apart: ${metres(log.d, 1)} at ${seconds(log.t)}.`,
      remedies: false,
    };
  const f = e.futures.value;
  if (a.goal.pos && f && isSettled(f) && !f.sketch && !e.motion.value.stale) return goalReached(a, c);
  return null;
}

function goalReached(a: Agent, c: Context): Verdict {
  const f = c.editor.futures.value!;
  const pos = a.goal.pos!;
  const miss = f.modes.flatMap((m, i) => {
    const p = poseAt(m.motion, a.goal.time) ?? endPose(m.motion);
    // Of a goal later than 9 s only the future that goes on can say anything.
    return endsBefore(m.motion, a.goal.time) ? [] : [{ letter: LETTERS[i], d: Math.hypot(p.x - pos[0], p.y - pos[1]) }];
  });
  const good = miss.filter((m) => m.d <= 2),
    bad = miss.filter((m) => m.d > 2);
  if (!good.length)
    return {
      kind: 'near',
      icon: 'warn',
      title: 'No future reaches the goal',
      words: `The closest, ${bad.sort((p, q) => p.d - q.d)[0].letter}, ends ${metres(bad[0].d, 1)} away.`,
      remedies: false,
    };
  const words = !bad.length
    ? `${miss.length === 1 ? 'Within' : 'All within'} ${metres(Math.max(0.1, ...miss.map((m) => m.d)), 1)} at ${seconds(a.goal.time)}.`
    : bad.length === 1
      ? `${bad[0].letter} ends ${metres(bad[0].d, 1)} short.`
      : `${bad.map((m) => m.letter).join(', ')} end up to ${metres(Math.max(...bad.map((m) => m.d)), 1)} away.`;
  return {
    kind: 'ok',
    icon: 'check',
    title:
      bad.length || miss.length === 1
        ? `Goal reached in ${good.map((m) => m.letter).join(', ')}`
        : `Goal reached in all ${miss.length === 6 ? 'six' : miss.length}`,
    words,
    remedies: false,
  };
}

const hintKey = (c: Context, a: Agent): string => {
  const v = verdict(c, a);
  return v ? JSON.stringify([v, v.remedies && remedies(c.editor, a).map((r) => [r.label, r.note])]) : '';
};

function hint(c: Context, a: Agent): HTMLElement | null {
  const v = verdict(c, a);
  if (!v) return null;
  const ways = v.remedies ? remedies(c.editor, a) : [];
  return h(
    'div',
    { class: 'sect' },
    h(
      'div',
      { class: `hint ${v.kind}` },
      icon(v.icon, 17),
      h('div', null, h('b', null, v.title), h('div', { class: 'tx' }, v.words)),
    ),
    ways.length && !c.editor.drag.peek()
      ? h(
          'div',
          { class: 'stack' },
          ways.map((r) =>
            h(
              'button',
              { type: 'button', class: `opt ${r.primary ? 'pri' : ''}`, onclick: () => c.editor.run(r.command) },
              icon(r.icon, 15),
              r.label,
              h('small', null, r.note),
            ),
          ),
        )
      : null,
    v.snap
      ? h(
          'div',
          { class: 'stack' },
          h(
            'button',
            {
              type: 'button',
              class: 'opt',
              onclick: () => {
                const to = snapToNearest(c.editor, a, 'goal');
                if (to) c.editor.run(to);
              },
            },
            icon('fit', 15),
            'Snap to nearest lane',
          ),
        )
      : null,
  );
}

// ---------------------------------------------------------------- start and goal

function pill(c: Context, agent: () => Agent, part: Part, field: Field, label: string): HTMLElement {
  const fixed = () => (part === 'goal' ? agent().goal : agent().start)[field] !== null;
  return h(
    'button',
    {
      type: 'button',
      class: 'fx',
      role: 'switch',
      'aria-checked': () => String(fixed()),
      'aria-label': `${label} fixed`,
      title: () =>
        fixed()
          ? 'Fixed: you decide. Click to let the generator decide'
          : 'Free: the generator decides. Click to fix it here',
      onclick: () => {
        const cmd = toggleField(c.editor, agent(), part, field);
        if (cmd) c.editor.run(cmd);
      },
    },
    icon('lock', 11),
    () => (fixed() ? 'Fixed' : 'Free'),
  );
}

function fieldsFor(c: Context, agent: () => Agent, part: Part): Child[] {
  const { editor } = c;
  const spec = () => (part === 'goal' ? agent().goal : agent().start);
  const shown = () => shownPose(editor, agent(), part);
  const word = part === 'goal' ? 'Goal' : 'Start';
  const run = (patch: Parameters<typeof withField>[2]) => editor.run(withField(agent(), part, patch));
  const dragging = (handle: string) => {
    const d = editor.drag.value;
    return d?.grip.part === part && d.grip.handle === handle;
  };
  const focus = (field: Field) => () => {
    editor.activate(part);
    editor.touchField(part, field);
  };
  const shownText = (free: boolean, v: number | null, text: (v: number) => string) =>
    v === null ? '' : (free ? '≈ ' : '') + text(v);
  const coordinate = (axis: 0 | 1) =>
    numberField({
      label: `${word} ${axis ? 'y' : 'x'} in metres`,
      letter: axis ? 'y' : 'x',
      unit: '',
      quantity: () => 'length',
      step: 0.1,
      decimals: () => 1,
      field: `${part}-pos`,
      value: () => {
        const p = shown();
        return p ? (axis ? p.y : p.x) : null;
      },
      free: () => spec().pos === null,
      live: () => dragging('body'),
      onFocus: focus('pos'),
      text: () => {
        const p = shown();
        return shownText(spec().pos === null, p && (axis ? p.y : p.x), (v) => num(v, 1));
      },
      set: (v) => {
        const p = shown();
        if (p) run({ pos: Object.freeze(axis ? [p.x, v] : [v, p.y]) as Vec });
      },
    });
  const unit = () => editor.unitOf(agent());
  return [
    row('Position', [coordinate(0), coordinate(1)], pill(c, agent, part, 'pos', `${word} position`)),
    row(
      'Heading',
      [
        numberField({
          label: `${word} heading in degrees`,
          unit: '°',
          quantity: () => 'angle',
          step: 1,
          decimals: () => 0,
          field: `${part}-heading`,
          onFocus: focus('heading'),
          value: () => {
            const p = shown();
            return p ? Math.round(deg(p.heading)) : null;
          },
          free: () => spec().heading === null,
          live: () => dragging('heading'),
          text: () => {
            const p = shown();
            return shownText(spec().heading === null, p && p.heading, (v) => num(Math.round(deg(v)), 0));
          },
          set: (v) => {
            editor.setHeadingFollows(part, agent(), false);
            run({ heading: wrapAngle(rad(v)) });
          },
        }),
      ],
      pill(c, agent, part, 'heading', `${word} heading`),
    ),
    row(
      'Speed',
      [
        numberField({
          label: `${word} speed`,
          unit,
          quantity: unit,
          step: agent().type === 'pedestrian' ? 0.1 : 1,
          decimals: () => (unit() === 'm/s' ? 1 : 0),
          field: `${part}-speed`,
          onFocus: focus('speed'),
          value: () => {
            const p = shown();
            return p ? Number(toUnit(p.speed, unit()).toFixed(2)) : null;
          },
          free: () => spec().speed === null,
          live: () => dragging('speed'),
          text: () => {
            const p = shown();
            return shownText(spec().speed === null, p && p.speed, (v) => speedText(v, unit()));
          },
          set: (v) => run({ speed: Math.min(topSpeed(agent()), Math.max(0, fromUnit(v, unit()))) }),
          onUnit:
            agent().type === 'pedestrian'
              ? undefined
              : () => editor.setUnit(editor.speedUnit.peek() === 'km/h' ? 'mph' : 'km/h'),
        }),
      ],
      pill(c, agent, part, 'speed', `${word} speed`),
    ),
  ];
}

const row = (label: string, fields: Child[], end: Child): HTMLElement =>
  h('div', { class: 'pr' }, h('span', { class: 'lab' }, label), h('div', { class: 'fs' }, fields), end ?? h('span'));

function startSection(c: Context, agent: () => Agent): HTMLElement {
  const size = (name: 'length' | 'width', letter: string) =>
    numberField({
      label: `${name} in metres`,
      letter,
      unit: 'm',
      quantity: () => 'length',
      step: 0.1,
      decimals: () => 1,
      free: () => false,
      value: () => agent()[name],
      text: () => num(agent()[name], 1),
      set: (v) => {
        const a = agent(),
          w = Math.max(0.2, v);
        c.editor.run(name === 'length' ? resize(a, w, a.width) : resize(a, a.length, w));
      },
    });
  return h(
    'section',
    { class: 'sect', 'aria-label': 'Start' },
    h('h3', null, h('span', { class: 'mkr' }), 'Start', h('small', null, 'at 0.0 s')),
    fieldsFor(c, agent, 'start'),
    row('Size', [size('length', 'L'), size('width', 'W')], null),
  );
}

function goalSection(c: Context, agent: () => Agent): HTMLElement {
  const { editor } = c;
  const note = () => {
    const a = agent();
    const lane = editor.drag.value?.grip.part === 'goal' ? editor.drag.value.laneName : null;
    if (lane) return `on ${lane}`.replace('on off', 'off').replace('on on', 'on').replace('on inside', 'inside');
    if (a.goal.pos) return laneWords(editor.scene.value!.map, a, a.goal.pos[0], a.goal.pos[1], a.goal.heading);
    return hasGoal(a.goal) ? 'partly free' : 'free: the generator decides';
  };
  return h(
    'section',
    { class: 'sect goalsec', 'aria-label': 'Goal' },
    h('h3', null, h('span', { class: 'mk' }, icon('flag', 15)), 'Goal', h('small', null, note)),
    fieldsFor(c, agent, 'goal'),
    row(
      'Time',
      [
        numberField({
          label: 'Time at the goal in seconds',
          unit: 's',
          quantity: () => 'time',
          step: 0.1,
          decimals: () => 1,
          field: 'goal-time',
          free: () => false,
          live: () => editor.drag.value?.grip.handle === 'time',
          value: () => agent().goal.time,
          text: () => num(agent().goal.time, 1),
          set: (v) =>
            editor.run(withField(agent(), 'goal', { time: Math.round(goalTime(editor.scene.peek(), v) * 10) / 10 })),
        }),
      ],
      null,
    ),
  );
}

// ---------------------------------------------------------------- futures

function futuresSection(c: Context, agent: () => Agent): HTMLElement {
  const { editor } = c;
  const note = () => {
    const f = editor.futures.value,
      a = agent();
    if (!f) return editor.status.value.kind === 'refining' ? 'working' : '';
    if (f.sketch) return 'sketch, generator away';
    if (!isSettled(f)) return f.step ? `step ${f.step} of ${f.steps}` : 'first guess';
    if (editor.outdated.value) return 'from before the last change';
    if (a.chosen !== null) return `chosen: ${LETTERS[a.chosen]}`;
    return hasGoal(a.goal)
      ? `of ${f.modes.length === 6 ? 'six' : f.modes.length}`
      : `${f.modes.length === 6 ? 'six' : f.modes.length}, no goal set`;
  };
  const key = () => {
    const f = editor.futures.value;
    return f ? `${f.modes.length}${f.sketch ? 's' : ''}` : '';
  };
  return h(
    'section',
    { class: 'sect last', 'aria-label': 'Futures' },
    h('h3', null, 'Futures', h('small', null, note)),
    swap(key, () => {
      const f = editor.futures.peek();
      if (!f)
        return h('p', { class: 'mut' }, () =>
          editor.away.value
            ? 'Waiting for the generator.'
            : editor.status.value.kind === 'refused'
              ? 'None: see below the picture.'
              : 'Working them out …',
        );
      if (f.sketch) return h('p', { class: 'mut' }, 'A plain curve is shown until the generator answers.');
      return h(
        'div',
        { role: 'radiogroup', 'aria-label': 'Futures' },
        f.modes.map((_, i) => futureRow(c, agent, i)),
      );
    }),
  );
}

function futureRow(c: Context, agent: () => Agent, i: number): HTMLElement {
  const { editor } = c;
  const mode = () => editor.futures.value?.modes[i];
  const share = () => {
    const f = editor.futures.value;
    return f ? (mode()?.probability ?? 0) / Math.max(...f.modes.map((m) => m.probability), 1e-9) : 0;
  };
  return h(
    'button',
    {
      type: 'button',
      class: 'fu',
      role: 'radio',
      'data-future': LETTERS[i],
      'aria-checked': () => String(editor.chosen.value === i),
      title: () => mode()?.name ?? '',
      onclick: () => {
        const cmd = agent().chosen === i ? null : pickFuture(editor, agent(), i);
        if (cmd) editor.run(cmd);
      },
      onpointerenter: () => {
        editor.pointAt({ future: i });
      },
      onpointerleave: () => {
        editor.pointAt({ future: null });
      },
      onfocus: () => {
        editor.pointAt({ future: i });
      },
      onblur: () => {
        editor.pointAt({ future: null });
      },
    },
    h('span', { class: `l m${i}` }, LETTERS[i]),
    h('span', { class: 'nm' }, () => mode()?.name ?? ''),
    h('span', { class: 'bar' }, h('i', { class: `m${i}`, css: { width: () => `${share() * 100}%` } })),
    h('span', { class: 'pc' }, () => `${Math.round((mode()?.probability ?? 0) * 100)}%`),
  );
}

// ---------------------------------------------------------------- who changed

function changesSection(c: Context): Node {
  const { editor } = c;
  return swap(
    () => editor.changes.value,
    () => {
      const list = editor.changes.peek();
      if (!list.length) return null;
      const scene = editor.scene.peek()!;
      return h(
        'section',
        { class: 'sect', 'aria-label': 'Others that changed' },
        h(
          'h3',
          null,
          `${list.length} other${list.length > 1 ? 's' : ''} changed`,
          h(
            'button',
            {
              type: 'button',
              'aria-pressed': () => String(editor.showBefore.value),
              onclick: () => {
                editor.toggleBefore();
              },
            },
            'show before / after',
          ),
        ),
        list.slice(0, 8).map((ch) => {
          const a = scene.agents.get(ch.id)!;
          return h(
            'button',
            {
              type: 'button',
              class: 'ch',
              title: `${ch.name} ${ch.words}`,
              onclick: () => editor.setTime(ch.at),
              onpointerenter: () => {
                editor.pointAt({ agent: ch.id });
              },
              onpointerleave: () => {
                editor.pointAt({ agent: null });
              },
            },
            h('i', { class: `b-${a.type}` }),
            h('b', null, ch.name),
            h('span', null, ch.words),
          );
        }),
        list.length > 8 ? h('p', { class: 'note' }, `and ${list.length - 8} more`) : null,
      );
    },
  );
}
