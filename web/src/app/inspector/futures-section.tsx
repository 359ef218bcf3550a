// The six futures of a road user: names, ranks, and the followed one.
import { useComputed } from '@preact/signals';
import { markOf, type Mark } from '../../model/document/future-facts';
import { isSettled, LETTERS, rankOf, type Future } from '../../model/document/futures';
import type { Command } from '../../model/document/commands';
import { takePin, unpin } from '../../model/document/pins';
import { endsBefore } from '../../model/base/motion';
import { goalTimeOf, hasGoal, nameIn, touched, type Agent, type Pin, type Scene } from '../../model/document/scene';
import { seconds } from '../../model/base/units';
import { placeWord } from '../../model/words/verdict-words';
import { whyNotLikeliest } from '../../model/words/why-shown';
import { perform } from '../../actions/registry';
import { verdictsHold } from '../../edit/moves/goal-verdict';
import { takeFuture } from '../../edit/moves/moves';
import { pinnedAt, pinsApart, togglePin, type ShownPin } from '../../edit/moves/pins';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import type { LiveAgent } from './use-agent';
import { TEXTS } from '../../texts/panels/agent';
import { TEXTS as PINS } from '../../texts/editing/pins';

export function FuturesSection({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const note = useComputed(() => {
    const f = editor.reading.toldFutures.value;
    const a = agent.value;
    if (!f) return editor.reading.throttle.read(() => editor.answers.status.value).kind === 'refining' ? 'working' : '';
    if (f.sketch) return TEXTS.sketchGenerator;
    if (!isSettled(f)) return f.step ? TEXTS.stepOf(f.step, f.steps) : TEXTS.firstGuess;
    if (editor.reading.outdated.value) return TEXTS.beforeTheLastChange;
    if (a.chosen !== null) return TEXTS.chosen(LETTERS[a.chosen]);
    const n = f.modes.length === 6 ? TEXTS.six : f.modes.length;
    if (hasGoal(a.goal)) return TEXTS.byRank(n);
    return editor.reading.replays.value ? TEXTS.noneChosenYet(n) : TEXTS.noGoalSet(n);
  });
  return (
    <section class="sect last futsec" aria-label={TEXTS.futures}>
      <h3>
        {TEXTS.futures}
        <small>{note}</small>
      </h3>
      <FutureList agent={agent} />
      <Remark agent={agent} />
      <ActionButton id="rounds" class="line rounds" size={15} withKey>
        {TEXTS.keepOrReject}
      </ActionButton>
    </section>
  );
}

/** Why the shown future is not the one that was bold in the drag, or not the likeliest. */
function Remark({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const words = useComputed(() => {
    const a = agent.value;
    const r = editor.answers.remark.value;
    if (r?.id === a.id) return r.words;
    const f = editor.reading.toldFutures.value;
    const settled = f && isSettled(f) && !editor.drag.active.value && verdictsHold(editor);
    // A pick, a drawn curve or the recording needs no reason.
    if (!settled || a.chosen !== null || editor.reading.replays.value) return '';
    const why = whyNotLikeliest(f, editor.reading.toldChosen.value, nameIn(editor.scene.value!));
    return why === null ? '' : `${why}.`;
  }).value;
  return words ? <p class="note remark">{words}</p> : null;
}

function FutureList({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const count = useComputed(() => editor.reading.toldFutures.value?.modes.length ?? 0).value;
  const sketch = useComputed(() => editor.reading.toldFutures.value?.sketch ?? false).value;
  if (!count) return <Waiting />;
  if (sketch) return <p class="mut">{TEXTS.aPlainCurveIs}</p>;
  return (
    <div class="futures" role="radiogroup" aria-label={TEXTS.futures}>
      <RecordedRow agent={agent} />
      {[...LETTERS].slice(0, count).map((letter, i) => (
        <FutureRow key={letter} agent={agent} index={i} />
      ))}
      <PinnedRows />
    </div>
  );
}

function Waiting() {
  const { editor } = useApp();
  const words = useComputed(() => {
    if (editor.answers.away.value) return TEXTS.waitingForThe;
    return editor.answers.status.value.kind === 'refused' ? TEXTS.noneSeeBelow : TEXTS.computing;
  });
  return <p class="mut">{words}</p>;
}

/** The recorded motion, if it is followed or would be without the pick. */
function RecordedRow({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const replays = useComputed(() => c.editor.reading.throttle.read(() => c.editor.reading.replays.value));
  const checked = useComputed(() => String(replays.value));
  const shown = useComputed(() => {
    const a = agent.value;
    return replays.value || (a.chosen !== null && !touched({ ...a, chosen: null }));
  }).value;
  if (!shown) return null;
  return (
    <div class="furow">
      <button
        type="button"
        class="fu recorded"
        role="radio"
        aria-checked={checked as never}
        title={TEXTS.followsTheLog}
        onClick={() => {
          if (!replays.peek()) perform(c, 'reset-agent');
        }}
      >
        <span class="l" />
        <span class="nm">{TEXTS.asRecorded}</span>
      </button>
    </div>
  );
}

function FutureRow({ agent, index }: { agent: LiveAgent; index: number }) {
  const { editor } = useApp();
  const mode = useComputed(() => editor.reading.toldFutures.value?.modes[index]);
  const name = useComputed(() => mode.value?.name ?? '');
  const rank = useComputed(() => {
    const modes = editor.reading.toldFutures.value?.modes ?? [];
    return modes[index] ? TEXTS.rank(rankOf(modes, index)) : '';
  });
  const title = useComputed(() => inWords(editor.resting.value, mode.value));
  const checked = useComputed(() =>
    String(
      editor.reading.toldChosen.value === index && !editor.reading.throttle.read(() => editor.reading.replays.value),
    ),
  );
  const pick = () => takeFuture(editor, agent.peek(), index);
  const point = () => editor.pointAt({ future: index });
  const leave = () => editor.pointAt({});
  /** A row that comes under a resting pointer, because the verdict above it grew, is not pointed at. */
  const moved = (e: PointerEvent) => {
    if (e.movementX || e.movementY) point();
  };
  const pin = useComputed(() => pinnedAt(editor, index)).value;
  const toggle = () => {
    const done = togglePin(editor, agent.peek(), index);
    if (typeof done === 'string') editor.notices.show({ text: done });
    else editor.commits.run(done);
  };
  const label = (pin ? PINS.unpinLetter : PINS.pinLetter)(LETTERS[index]);
  return (
    <div class="furow" onPointerMove={moved} onPointerLeave={leave}>
      <button
        type="button"
        class="fu"
        role="radio"
        data-future={LETTERS[index]}
        aria-checked={checked as never}
        title={title}
        onClick={pick}
        onFocus={point}
        onBlur={leave}
      >
        <span class={`l m${index}`}>{LETTERS[index]}</span>
        <span class="nm">{name}</span>
        <MarkSign agent={agent} index={index} />
        <span class="rank">{rank}</span>
      </button>
      <button
        type="button"
        class="btn i pinb"
        aria-pressed={pin !== null}
        aria-label={label}
        title={label}
        onClick={toggle}
      >
        <Icon name="pin" size={15} />
      </button>
    </div>
  );
}

/** Pinned futures that are none of those above. */
function PinnedRows() {
  const { editor } = useApp();
  const shown = useComputed(() => pinsApart(editor)).value;
  return (
    <>
      {shown.map((p) => (
        <PinnedRow key={p.pin.key} {...p} />
      ))}
    </>
  );
}

function PinnedRow({ pin, why }: ShownPin) {
  const { editor } = useApp();
  const on = (make: (a: Agent, p: Pin) => Command) => () => {
    const a = editor.agent.peek();
    if (a && !a.locked) editor.commits.run(make(a, pin));
  };
  return (
    <div class="furow">
      <button
        type="button"
        class={why ? 'fu pinned misfit' : 'fu pinned'}
        role="radio"
        data-pin={pin.key}
        aria-checked="false"
        title={why ? PINS.noLongerFits(pin.name, why) : pin.name}
        onClick={on(takePin)}
      >
        <span class="l">
          <Icon name="pin" size={13} />
        </span>
        <span class="nm">{pin.name}</span>
        <span class="why">{why ?? PINS.pinnedSign}</span>
      </button>
      <button
        type="button"
        class="btn i pinb"
        aria-pressed="true"
        aria-label={PINS.unpin(pin.name)}
        title={PINS.unpin(pin.name)}
        onClick={on(unpin)}
      >
        <Icon name="x" size={14} />
      </button>
    </div>
  );
}

const MARK_WORDS: Readonly<Record<Mark, string>> = {
  collision: TEXTS.collision,
  rule: TEXTS.ruleViolation,
  near: TEXTS.nearMiss,
  short: TEXTS.goalNotReached,
  ok: TEXTS.reached,
};

/** The worst verdict. A tick requires a goal; without one only faults are marked. */
function MarkSign({ agent, index }: { agent: LiveAgent; index: number }) {
  const { editor } = useApp();
  const mark = useComputed(() => {
    // A road user that nothing was asked of has only possible futures: their faults are marked one at a time.
    const isDue = !editor.reading.replays.value || editor.hoverFuture.value === index;
    const told = isDue && verdictsHold(editor) ? editor.reading.toldFutures.value?.modes[index] : null;
    const m = told?.about ? markOf(told.about) : null;
    const due = goalTimeOf(agent.value);
    return m === 'ok' && (due === null || endsBefore(told!.motion, due)) ? null : m;
  }).value;
  return mark ? (
    <span class={`mk ${mark}`} role="img" aria-label={MARK_WORDS[mark]}>
      <Icon name={`mark-${mark}`} size={15} />
    </span>
  ) : (
    <span class="mk" />
  );
}

/** `Before Car 12: over the median at 3.2 s`. */
function inWords(scene: Scene | null, m: Future | undefined): string {
  const [worst] = m?.about?.faults ?? [];
  if (!scene || !m || !worst) return m?.name ?? '';
  return TEXTS.at(m.name, placeWord(worst, nameIn(scene)), seconds(worst.time));
}
