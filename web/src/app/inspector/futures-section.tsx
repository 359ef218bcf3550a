// The six futures of a road user: names, shares, and which one it takes.
import { useComputed } from '@preact/signals';
import { markOf, type Mark } from '../../model/document/future-facts';
import { isSettled, LETTERS, percents, type Future } from '../../model/document/futures';
import type { Command } from '../../model/document/commands';
import { takePin, unpin } from '../../model/document/pins';
import { endsBefore } from '../../model/base/motion';
import { goalTimeOf, hasGoal, nameIn, touched, type Agent, type Pin, type Scene } from '../../model/document/scene';
import { seconds } from '../../model/base/units';
import { placeWord } from '../../model/words/verdict-words';
import { perform } from '../../actions/registry';
import { verdictsHold } from '../../edit/goal-verdict';
import { takeFuture } from '../../edit/moves';
import { pinnedAt, pinsApart, togglePin, type ShownPin } from '../../edit/pins';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import type { LiveAgent } from './use-agent';
import { TEXTS } from '../../texts/panels/agent';
import { TEXTS as PINS } from '../../texts/editing/pins';

export function FuturesSection({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const note = useComputed(() => {
    const f = editor.toldFutures.value;
    const a = agent.value;
    if (!f) return editor.calm.read(() => editor.status.value).kind === 'refining' ? 'working' : '';
    if (f.sketch) return TEXTS.sketchGenerator;
    if (!isSettled(f)) return f.step ? TEXTS.stepOf(f.step, f.steps) : TEXTS.firstGuess;
    if (editor.outdated.value) return TEXTS.fromBeforeThe;
    if (a.chosen !== null) return TEXTS.chosen(LETTERS[a.chosen]);
    const n = f.modes.length === 6 ? TEXTS.six : f.modes.length;
    if (hasGoal(a.goal)) return TEXTS.of(n);
    return editor.replays.value ? TEXTS.nonePicked(n) : TEXTS.noGoalSet(n);
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
        {TEXTS.keepAndReject}
      </ActionButton>
    </section>
  );
}

/** Why another future is shown than the one that was bold in the drag. */
function Remark({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const words = useComputed(() => {
    const r = editor.answers.remark.value;
    return r?.id === agent.value.id ? r.words : '';
  }).value;
  return words ? <p class="note remark">{words}</p> : null;
}

function FutureList({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const count = useComputed(() => editor.toldFutures.value?.modes.length ?? 0).value;
  const sketch = useComputed(() => editor.toldFutures.value?.sketch ?? false).value;
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
    if (editor.away.value) return TEXTS.waitingForThe;
    return editor.status.value.kind === 'refused' ? TEXTS.noneSeeBelow : TEXTS.workingThemOut;
  });
  return <p class="mut">{words}</p>;
}

/** What was recorded, where it is what happens or would be again without the pick. */
function RecordedRow({ agent }: { agent: LiveAgent }) {
  const c = useApp();
  const replays = useComputed(() => c.editor.calm.read(() => c.editor.replays.value));
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
        title={TEXTS.itDoesWhatTheLog}
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
  const mode = useComputed(() => editor.toldFutures.value?.modes[index]);
  const name = useComputed(() => mode.value?.name ?? '');
  const percent = useComputed(() => `${percents(editor.toldFutures.value?.modes ?? [])[index] ?? 0}%`);
  const title = useComputed(() => inWords(editor.resting.value, mode.value));
  const checked = useComputed(() =>
    String(editor.toldChosen.value === index && !editor.calm.read(() => editor.replays.value)),
  );
  const pick = () => takeFuture(editor, agent.peek(), index);
  const point = () => editor.pointAt({ future: index });
  const leave = () => editor.pointAt({});
  const pin = useComputed(() => pinnedAt(editor, index)).value;
  const toggle = () => {
    const done = togglePin(editor, agent.peek(), index);
    if (typeof done === 'string') editor.notices.show({ text: done });
    else editor.run(done);
  };
  const label = (pin ? PINS.letGoLetter : PINS.pinLetter)(LETTERS[index]);
  return (
    <div class="furow" onPointerEnter={point} onPointerLeave={leave}>
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
        <span class="bar">
          <Share index={index} />
        </span>
        <span class="pc">{percent}</span>
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
    if (a && !a.locked) editor.run(make(a, pin));
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
        aria-label={PINS.letGo(pin.name)}
        title={PINS.letGo(pin.name)}
        onClick={on(unpin)}
      >
        <Icon name="x" size={14} />
      </button>
    </div>
  );
}

const MARK_WORDS: Readonly<Record<Mark, string>> = {
  collision: TEXTS.collision,
  rule: TEXTS.breaksARule,
  near: TEXTS.nearMiss,
  short: TEXTS.goalNotReached,
  ok: TEXTS.reached,
};

/** The worst of its verdicts. A tick belongs to a goal; where none is set, only what is wrong is marked. */
function MarkSign({ agent, index }: { agent: LiveAgent; index: number }) {
  const { editor } = useApp();
  const mark = useComputed(() => {
    const told = verdictsHold(editor) ? editor.toldFutures.value?.modes[index] : null;
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

/** A bar as long as the future is likely, beside the likeliest. It is pushed out of sight, which lays out nothing. */
function Share({ index }: { index: number }) {
  const { editor } = useApp();
  const missing = useComputed(() => {
    const modes = editor.toldFutures.value?.modes ?? [];
    const share = (modes[index]?.probability ?? 0) / Math.max(...modes.map((m) => m.probability), 1e-9);
    return `translate: ${((share - 1) * 100).toFixed(2)}%`;
  });
  return <i class={`m${index}`} style={missing} />;
}
