// The sheet of shortcuts, made from the actions; what the mouse does with modifiers is added.
import { useRef } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import { GROUPS, type Action, type Group } from '../../actions/action';
import { ACTIONS } from '../../actions/registry';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';
import { GROUP_TITLES } from '../../texts/desk/groups';
import { TEXTS } from '../../texts/desk/shortcuts';

interface Line {
  readonly label: string;
  readonly keys: readonly string[];
  /** What is done with the mouse meanwhile. */
  readonly how?: string;
}

const POINTER_LINES: Partial<Record<Group, readonly Line[]>> = {
  look: [
    { label: TEXTS.addOneOrTake, keys: ['Shift'], how: TEXTS.click },
    { label: TEXTS.allInAFrame, keys: [], how: TEXTS.dragOverTheGround },
    { label: TEXTS.addAFrameTake, keys: ['Shift', 'Alt'], how: TEXTS.drag },
    { label: TEXTS.pan, keys: ['Space'], how: TEXTS.drag },
    { label: TEXTS.zoom, keys: [], how: TEXTS.wheel },
    { label: TEXTS.panZoomTurn, keys: [], how: TEXTS.twoFingers },
  ],
  edit: [
    { label: TEXTS.copyAway, keys: ['Alt'], how: TEXTS.dragFromARoad },
    { label: TEXTS.menu, keys: [], how: TEXTS.rightButtonOr },
  ],
  move: [
    { label: TEXTS.noSnapping, keys: ['Alt'], how: TEXTS.drag },
    { label: TEXTS.alongTheLane, keys: ['Shift'], how: TEXTS.drag },
    { label: TEXTS.startAndGoal, keys: ['Ctrl'], how: TEXTS.drag },
  ],
};

/** Families of keys on one line, as people think of them. */
const FAMILIES: readonly (Line & { readonly ids: RegExp })[] = [
  { ids: /^nudge-(left|right|up|down)$/, label: TEXTS.nudge01M, keys: ['Left', 'Up', 'Down', 'Right'] },
  { ids: /^nudge-far-/, label: TEXTS.nudge1M, keys: ['Shift+Left', 'Up', 'Down', 'Right'] },
  { ids: /^future-[a-f]$/, label: TEXTS.chooseFuture, keys: ['Alt+1–6'] },
  { ids: /^along-/, label: TEXTS.alongTheLane1, keys: ['Ctrl+Up', 'Down'] },
  { ids: /^lane-(left|right)$/, label: TEXTS.toTheNextLane, keys: ['Ctrl+Left', 'Right'] },
  { ids: /^turn-(left|right)$/, label: TEXTS.turn1, keys: ['[', ']'] },
  { ids: /^turn-(left|right)-far$/, label: TEXTS.turn15, keys: ['Shift+[', ']'] },
  { ids: /^(slower|faster)$/, label: TEXTS.slowerFaster, keys: ['-', '+'] },
  { ids: /^(slower|faster)-far$/, label: TEXTS.muchSlowerFaster, keys: ['Shift+-', '+'] },
  { ids: /^goal-(earlier|later)$/, label: TEXTS.goalTime01S, keys: [';', "'"] },
  { ids: /^goal-(earlier|later)-far$/, label: TEXTS.goalTime1S, keys: ['Shift+;', "'"] },
  { ids: /^step-(back|on)$/, label: TEXTS.at01SBackOn, keys: [',', '.'] },
  { ids: /^to-(start|end)$/, label: TEXTS.toStartToEnd, keys: ['Home', 'End'] },
  { ids: /^(slower|faster)-playback$/, label: TEXTS.slowerFasterPlayback, keys: ['Shift+,', '.'] },
  {
    ids: /^tool-place-/,
    label: TEXTS.placeACarTruck,
    keys: ['1', '2', '3', '4', '5', '6'],
  },
  { ids: /^(next|previous)-agent$/, label: TEXTS.nextPrevious, keys: ['Tab', 'Shift+Tab'] },
  { ids: /^(next|previous)-group$/, label: TEXTS.nextPartOfThe, keys: ['F6'] },
  { ids: /^round-card-/, label: TEXTS.chooseACard, keys: ['1', '6'] },
  { ids: /^round-(back|on)$/, label: TEXTS.cardBeforeAfter, keys: ['Left', 'Right'] },
  { ids: /^zoom-(in|out)$/, label: TEXTS.zoomInOut, keys: ['PageUp', 'PageDown'] },
  { ids: /^turn-picture-/, label: TEXTS.turnThePicture, keys: ['Shift+PageUp', 'PageDown'] },
];

export function Shortcuts() {
  const { ui } = useApp();
  const query = useSignal('');
  const input = useRef<HTMLInputElement>(null);
  const close = () => ui.closeDialog();
  return (
    <Modal label={TEXTS.shortcuts} class="keys" close={close}>
      <div class="dhead">
        <h2>{TEXTS.shortcuts}</h2>
        <span class="grow" />
        <label class="field search">
          <Icon name="search" size={14} />
          <input
            ref={input}
            type="search"
            placeholder={TEXTS.findAShortcut}
            aria-label={TEXTS.findAShortcut}
            data-first=""
            onInput={() => {
              query.value = input.current!.value.trim().toLowerCase();
            }}
          />
        </label>
        <button type="button" class="btn i" aria-label={TEXTS.close} onClick={close}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <div class="cols" tabIndex={0} role="group" aria-label={TEXTS.allKeys}>
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
      <h3>{GROUP_TITLES[group]}</h3>
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
      ...(a.whileDragging ? { how: TEXTS.whileDragging } : a.onOffer ? { how: TEXTS.whileItIsOffered } : {}),
    }
  );
}
