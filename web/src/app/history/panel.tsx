// History of the scene, newest on top. A click goes to a step; abandoned branches are beside the line.
import { useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import type { Context } from '../../actions/context';
import { laneWords } from '../../edit/moves/snap';
import { metres } from '../../model/base/units';
import type { ReadonlyHistory, HistoryStep } from '../../model/document/history';
import { useApp } from '../parts/app-context';
import { KeyCaps } from '../parts/buttons';
import { DrawerTabs } from '../parts/drawer-tabs';
import { Icon } from '../parts/icons';
import { clock, dayAndTime } from '../scenes/dates';
import { TEXTS } from '../../texts/desk/history';

/** Rows drawn at first; older ones follow on demand. */
const SHOWN = 120;

/** A row of the list: a step of the current line, or of a branch beside it. */
interface HistoryRow {
  readonly step: HistoryStep;
  readonly branch: boolean;
  /** Last of its branch: the branch leads here. */
  readonly tip: boolean;
}

/** Newest first; a branch is above the step it comes from. */
export function rowsOf(h: ReadonlyHistory): HistoryRow[] {
  const line = h.line();
  const onLine = new Set(line.map((s) => s.id));
  const after = new Map<number | null, HistoryStep[]>();
  for (const s of h.kept().steps) after.set(s.parent, [...(after.get(s.parent) ?? []), s]);
  const branches = (parent: number | null): HistoryRow[] => {
    const out: HistoryRow[] = [];
    const open = (after.get(parent) ?? []).filter((s) => !onLine.has(s.id));
    for (let s = open.pop(); s; s = open.pop()) {
      const next: HistoryStep[] = after.get(s.id) ?? [];
      out.push({ step: s, branch: true, tip: !next.length });
      open.push(...next);
    }
    return out;
  };
  const rows = [...branches(null)];
  for (const step of line) rows.push({ step, branch: false, tip: false }, ...branches(step.id));
  return rows.reverse();
}

export function HistoryPanel() {
  const { editor } = useApp();
  const most = useSignal(SHOWN);
  const rows = useComputed(() => {
    void editor.document.historyTick.value;
    return editor.document.history ? rowsOf(editor.document.history) : [];
  }).value;
  const head = editor.document.history?.head ?? null;
  const line = editor.document.history?.line() ?? [];
  const at = line.findIndex((s) => s.id === head) + 1;
  return (
    <section class="drawer card history" aria-label={TEXTS.history} data-group="history">
      <DrawerTabs />
      <h2>
        <small class="mut">{line.length ? TEXTS.ofSteps(at, line.length) : TEXTS.noStepsYet}</small>
      </h2>
      <div class="scns">
        <ol class="past">
          {rows.slice(0, most.value).map((r) => (
            <Step key={`${r.step.id}:${r.step.name}`} row={r} now={r.step.id === head} />
          ))}
          {rows.length > most.value ? (
            <li>
              <button type="button" class="btn" onClick={() => (most.value += SHOWN)}>
                {TEXTS.olderSteps(rows.length - most.value)}
              </button>
            </li>
          ) : (
            <First now={head === null} />
          )}
        </ol>
      </div>
      <footer class="foot">
        <span class="mut">
          <KeyCaps of="Ctrl+Z" /> {TEXTS.oneBack}
        </span>
        <span class="grow" />
        <span class="mut">{TEXTS.keptOnThisComputer}</span>
      </footer>
    </section>
  );
}

function First({ now }: { now: boolean }) {
  const { editor } = useApp();
  return (
    <li class={`step ${now ? 'now' : ''}`} aria-current={now ? 'step' : undefined}>
      <button type="button" class="go" data-step="first" onClick={() => editor.commits.goTo(null)}>
        <i class="dot" />
        <b>{TEXTS.initialState}</b>
        <small>{now ? TEXTS.now : TEXTS.beforeTheFirst}</small>
      </button>
    </li>
  );
}

function Step({ row: { step, branch, tip }, now }: { row: HistoryRow; now: boolean }) {
  const { editor } = useApp();
  const naming = useSignal(false);
  const who = step.agent === null ? null : editor.scene.peek()?.agents.get(step.agent)?.name;
  const whose = who && !step.name.includes(who) ? who : null;
  const words = [now ? TEXTS.now : null, branch && tip ? TEXTS.goBackToThis : null, whose, placeOf(editor, step)]
    .filter(Boolean)
    .join(' · ');
  if (naming.value) return <StepTitle step={step} done={() => (naming.value = false)} />;
  return (
    <li
      class={`step ${now ? 'now' : ''} ${branch ? 'branch' : ''} ${step.title ? 'named' : ''}`}
      aria-current={now ? 'step' : undefined}
    >
      <button type="button" class="go" data-step={step.id} onClick={() => editor.commits.goTo(step.id)}>
        <i class="dot" />
        <b>{step.title ?? step.name}</b>
        <time title={dayAndTime(step.at)}>{clock(step.at)}</time>
        <small>
          {branch && tip ? <span class="tag">{TEXTS.branch}</span> : null}
          {step.title ? <span class="tag near">{TEXTS.named}</span> : null}
          {step.title ? step.name : words}
        </small>
      </button>
      <button
        type="button"
        class="btn i"
        title={TEXTS.nameThisStep}
        aria-label={TEXTS.nameTheStep(step.name)}
        onClick={() => (naming.value = true)}
      >
        <Icon name="pencil" size={14} />
      </button>
    </li>
  );
}

/** Where the goal or the start of its road user went, and how far: `E arm, inbound lane · 12.4 m`. */
function placeOf({ scene }: Context['editor'], { diff }: HistoryStep): string | null {
  const [one, ...more] = diff.agents;
  const now = scene.peek();
  const a = one && now?.agents.get(one.id);
  if (!a || more.length || !one.forth) return null;
  const to = one.forth.goal?.pos ?? one.forth.start?.pos;
  if (!to) return null;
  const from = one.back?.goal?.pos ?? one.back?.start?.pos;
  const far = from ? Math.hypot(to[0] - from[0], to[1] - from[1]) : 0;
  const heading = one.forth.goal?.heading ?? one.forth.start?.heading ?? null;
  return [laneWords(now!.map, a, to[0], to[1], heading), far > 0.05 ? metres(far, 1) : null]
    .filter(Boolean)
    .join(' · ');
}

function StepTitle({ step, done }: { step: HistoryStep; done: () => void }) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  const keep = () => {
    editor.document.entitle(step.id, input.current!.value.trim() || null);
    done();
  };
  return (
    <li class="step">
      <label class="field rename">
        <input
          ref={(el) => {
            input.current = el;
            el?.focus();
          }}
          type="text"
          aria-label={TEXTS.nameOfTheStep}
          maxlength={60}
          value={step.title ?? ''}
          placeholder={step.name}
          onKeyDown={(e) => {
            if (e.key === 'Enter') keep();
            if (e.key !== 'Escape') return;
            e.stopPropagation();
            done();
          }}
        />
      </label>
    </li>
  );
}
