// The shortcut sheet, made from the actions; mouse gestures with modifiers are added.
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

interface ShortcutLine {
  readonly label: string;
  readonly keys: readonly string[];
  /** The mouse gesture. */
  readonly how?: string;
}

const POINTER_LINES: Partial<Record<Group, readonly ShortcutLine[]>> = {
  select: [
    { label: TEXTS.addOneOrTake, keys: ['Shift'], how: TEXTS.click },
    { label: TEXTS.marqueeSelect, keys: [], how: TEXTS.dragOverTheGround },
    { label: TEXTS.addOrSubtractMarquee, keys: ['Shift', 'Alt'], how: TEXTS.drag },
  ],
  look: [
    { label: TEXTS.pan, keys: ['Space'], how: TEXTS.drag },
    { label: TEXTS.zoom, keys: [], how: TEXTS.wheel },
    { label: TEXTS.panZoomTurn, keys: [], how: TEXTS.twoFingers },
  ],
  edit: [
    { label: TEXTS.dragACopy, keys: ['Alt'], how: TEXTS.dragFromARoad },
    { label: TEXTS.menu, keys: [], how: TEXTS.rightButtonOr },
  ],
  move: [
    { label: TEXTS.noSnapping, keys: ['Alt'], how: TEXTS.drag },
    { label: TEXTS.alongTheLane, keys: ['Shift'], how: TEXTS.drag },
    { label: TEXTS.startAndGoal, keys: ['Ctrl'], how: TEXTS.drag },
    { label: TEXTS.whileDriving, keys: ['W', 'S', 'A', 'D'] },
  ],
};

/** Related keys on one line. */
const FAMILIES: readonly (ShortcutLine & { readonly ids: RegExp })[] = [
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
  { ids: /^step-(back|on)$/, label: TEXTS.at01SBackForward, keys: [',', '.'] },
  { ids: /^to-(start|end)$/, label: TEXTS.toStartToEnd, keys: ['Home', 'End'] },
  { ids: /^(slower|faster)-playback$/, label: TEXTS.slowerFasterPlayback, keys: ['Shift+,', '.'] },
  {
    ids: /^tool-place-/,
    label: TEXTS.placeACarTruck,
    keys: ['1', '2', '3', '4', '5', '6'],
  },
  { ids: /^(next|previous)-agent$/, label: TEXTS.nextPrevious, keys: ['Tab', 'Shift+Tab'] },
  { ids: /^(next|previous)-group$/, label: TEXTS.nextPartOfThe, keys: ['F6'] },
  { ids: /^round-card-/, label: TEXTS.chooseACard, keys: ['1–6'] },
  { ids: /^round-(back|on)$/, label: TEXTS.previousNextCard, keys: ['Left', 'Right'] },
  { ids: /^zoom-(in|out)$/, label: TEXTS.zoomInOut, keys: ['PageUp', 'PageDown'] },
  { ids: /^turn-picture-/, label: TEXTS.rotateView15, keys: ['Shift+PageUp', 'PageDown'] },
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
  const named = (l: ShortcutLine): boolean => l.label.toLowerCase().includes(query);
  const always = [...linesOf(group, false), ...(POINTER_LINES[group] ?? [])].filter(named);
  const offered = linesOf(group, true).filter(named);
  if (!always.length && !offered.length) return null;
  return (
    <section>
      <h3>{GROUP_TITLES[group]}</h3>
      <Lines of={always} />
      {offered.length ? <h4>{WHEN[group] ?? TEXTS.whenAvailable}</h4> : null}
      <Lines of={offered} />
    </section>
  );
}

function Lines({ of }: { of: readonly ShortcutLine[] }) {
  return (
    <>
      {of.map(({ label, keys, how }) => (
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
    </>
  );
}

/** When the keys of a group apply that do not always apply. */
const WHEN: Partial<Record<Group, string>> = {
  place: TEXTS.whilePlacing,
  goal: TEXTS.withAGoalOrVia,
  rounds: TEXTS.whileRounds,
  variants: TEXTS.whileVariants,
  scene: TEXTS.whileMap,
};

/** Lines of a group: of keys that always apply, or of those that apply in a context. */
function linesOf(group: Group, offered: boolean): ShortcutLine[] {
  const actions = ACTIONS.filter((a) => a.group === group && a.keys?.length && !!a.onOffer === offered);
  return [...new Set(actions.map(lineOf))];
}

/** The line of an action; shared by all of a family. */
function lineOf(a: Action): ShortcutLine {
  return (
    FAMILIES.find((f) => f.ids.test(a.id)) ?? {
      label: a.label,
      keys: [a.keys![0]],
      ...(a.whileDragging ? { how: TEXTS.whileDragging } : {}),
    }
  );
}
