// The sheet of shortcuts, made from the actions; what the mouse does with modifiers is added.
import { useRef } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import { GROUPS, type Action, type Group } from '../../actions/action';
import { ACTIONS } from '../../actions/registry';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';

interface Line {
  readonly label: string;
  readonly keys: readonly string[];
  /** What is done with the mouse meanwhile. */
  readonly how?: string;
}

const POINTER_LINES: Partial<Record<Group, readonly Line[]>> = {
  'Select and look': [
    { label: 'Add one, or take it away', keys: ['Shift'], how: 'click' },
    { label: 'All in a frame', keys: [], how: 'drag over the ground' },
    { label: 'Add a frame, take it away', keys: ['Shift', 'Alt'], how: 'drag' },
    { label: 'Pan', keys: ['Space'], how: 'drag' },
    { label: 'Zoom', keys: [], how: 'wheel' },
  ],
  Edit: [
    { label: 'Copy away', keys: ['Alt'], how: 'drag from a road user' },
    { label: 'Menu', keys: [], how: 'right button, or a finger that rests' },
  ],
  Move: [
    { label: 'No snapping', keys: ['Alt'], how: 'drag' },
    { label: 'Along the lane only', keys: ['Shift'], how: 'drag' },
    { label: 'Start and goal together', keys: ['Ctrl'], how: 'drag' },
  ],
};

/** Families of keys on one line, as people think of them. */
const FAMILIES: readonly (Line & { readonly ids: RegExp })[] = [
  { ids: /^nudge-(left|right|up|down)$/, label: 'Nudge 0.1 m', keys: ['Left', 'Up', 'Down', 'Right'] },
  { ids: /^nudge-far-/, label: 'Nudge 1 m', keys: ['Shift+Left', 'Up', 'Down', 'Right'] },
  { ids: /^future-[a-f]$/, label: 'Choose future A to F', keys: ['Alt+1–6'] },
  { ids: /^along-/, label: 'Along the lane 1 m', keys: ['Ctrl+Up', 'Down'] },
  { ids: /^lane-(left|right)$/, label: 'To the next lane', keys: ['Ctrl+Left', 'Right'] },
  { ids: /^turn-(left|right)$/, label: 'Turn 1°', keys: ['[', ']'] },
  { ids: /^turn-(left|right)-far$/, label: 'Turn 15°', keys: ['Shift+[', ']'] },
  { ids: /^(slower|faster)$/, label: 'Slower, faster', keys: ['-', '+'] },
  { ids: /^(slower|faster)-far$/, label: 'Much slower, faster', keys: ['Shift+-', '+'] },
  { ids: /^goal-(earlier|later)$/, label: 'Goal time 0.1 s', keys: [';', "'"] },
  { ids: /^goal-(earlier|later)-far$/, label: 'Goal time 1 s', keys: ['Shift+;', "'"] },
  { ids: /^step-(back|on)$/, label: '0.1 s back, on', keys: [',', '.'] },
  { ids: /^to-(start|end)$/, label: 'To start, to end', keys: ['Home', 'End'] },
  { ids: /^(slower|faster)-playback$/, label: 'Slower, faster playback', keys: ['Shift+,', '.'] },
  {
    ids: /^tool-place-/,
    label: 'Place a car, truck, bus, motorcycle, cyclist, pedestrian',
    keys: ['1', '2', '3', '4', '5', '6'],
  },
  { ids: /^(next|previous)-agent$/, label: 'Next, previous road user', keys: ['Tab', 'Shift+Tab'] },
  { ids: /^(next|previous)-group$/, label: 'Next part of the page', keys: ['F6'] },
  { ids: /^round-card-/, label: 'Choose a card', keys: ['1', '6'] },
  { ids: /^round-(back|on)$/, label: 'Card before, after', keys: ['Left', 'Right'] },
  { ids: /^zoom-(in|out)$/, label: 'Zoom in, out', keys: ['PageUp', 'PageDown'] },
];

export function Shortcuts() {
  const { ui } = useApp();
  const query = useSignal('');
  const input = useRef<HTMLInputElement>(null);
  const close = () => ui.closeDialog();
  return (
    <Modal label="Shortcuts" class="keys" close={close}>
      <div class="dhead">
        <h2>Shortcuts</h2>
        <span class="grow" />
        <label class="field search">
          <Icon name="search" size={14} />
          <input
            ref={input}
            type="search"
            placeholder="Find a shortcut"
            aria-label="Find a shortcut"
            data-first=""
            onInput={() => {
              query.value = input.current!.value.trim().toLowerCase();
            }}
          />
        </label>
        <button type="button" class="btn i" aria-label="Close" onClick={close}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <div class="cols" tabIndex={0} role="group" aria-label="All keys">
        {GROUPS.map((g) => (
          <Sheet key={g} group={g} query={query.value} />
        ))}
      </div>
    </Modal>
  );
}

function Sheet({ group, query }: { group: Group; query: string }) {
  const lines = linesOf(group).filter((l) => l.label.toLowerCase().includes(query));
  if (!lines.length) return null;
  return (
    <section>
      <h3>{group}</h3>
      {lines.map(({ label, keys, how }) => (
        <div key={label} class="kr">
          <span>{label}</span>
          <span>
            {keys.map((k) => (
              <KeyCaps key={k} of={k} />
            ))}
            {how}
          </span>
        </div>
      ))}
    </section>
  );
}

function linesOf(group: Group): Line[] {
  const actions = ACTIONS.filter((a) => a.group === group && a.keys?.length);
  const lines = actions.map(lineOf);
  return [...new Set(lines), ...(POINTER_LINES[group] ?? [])];
}

/** The line of an action; the same one for all of a family. */
function lineOf(a: Action): Line {
  return (
    FAMILIES.find((f) => f.ids.test(a.id)) ?? {
      label: a.label,
      keys: [a.keys![0]],
      ...(a.whileDragging ? { how: 'while dragging' } : a.onOffer ? { how: 'while it is offered' } : {}),
    }
  );
}
