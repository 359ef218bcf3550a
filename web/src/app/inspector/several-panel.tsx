// The inspector of several: what they have in common, and one value for all of them.
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { KIND_NAMES, kindsWords, PLACED_KINDS } from '../../model/kinds';
import { doing, hasGoal, startPose, type Agent, type AgentType, type Others } from '../../model/scene';
import { num, seconds, speedLabel } from '../../model/units';
import { actionOf, perform } from '../../actions/registry';
import * as several from '../../edit/several';
import { closestOf, gapNow } from '../../model/closest';
import { poseShown } from '../../edit/frame';
import { shownPose } from '../../edit/moves';
import { useApp } from '../parts/app-context';
import { ActionButton, IconButton, Segments } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { SharedField, sharedFields, type Shared } from './shared-field';

const GROUPS: readonly (readonly [AgentType, string])[] = [
  ['pedestrian', 'On foot'],
  ['cyclist', 'Cycling'],
  ['vehicle', 'Driving'],
];

type Live = ReadonlySignal<readonly Agent[]>;

export function SeveralPanel() {
  const { editor } = useApp();
  const only = useSignal<AgentType | null>(null);
  const all = useComputed(() => editor.chosenOnes);
  const those = useComputed(() => {
    const some = all.value.filter((a) => only.value === null || a.type === only.value);
    return some.length ? some : all.value;
  });
  const locked = useComputed(() => all.value.filter((a) => a.locked).length).value;
  return (
    <>
      <Head all={all} />
      <section class="sect">
        <h3>
          All of them
          <small>typing writes to all, +5 adds</small>
        </h3>
        <Filter all={all} only={only} />
        {locked ? (
          <p class="note">
            {locked} locked {locked > 1 ? 'stay as they are' : 'stays as it is'}.
          </p>
        ) : null}
      </section>
      <Values those={those} />
      <Rule all={all} />
      <Who those={those} />
      <div class="grow" />
      <div class="sect foot">
        <ActionButton id="duplicate" class="line" icon="" size={15} />
        <ActionButton id="delete" class="line" size={15} />
      </div>
    </>
  );
}

function Head({ all }: { all: Live }) {
  const count = useComputed(() => `${all.value.length} road users`);
  const kinds = useComputed(() => kindsWords(all.value.map((a) => a.kind)));
  return (
    <div class="ih">
      <div class="ag t-ink">
        <Icon name="lasso" size={20} />
      </div>
      <div class="grow">
        <h2>{count}</h2>
        <p>{kinds}</p>
      </div>
      <IconButton id="zoom-selection" />
      <IconButton id="menu" icon="more" />
    </div>
  );
}

/** Narrows whom typing hits. */
function Filter({ all, only }: { all: Live; only: { value: AgentType | null } }) {
  const rows = GROUPS.flatMap(([type, word]) => {
    const n = all.value.filter((a) => a.type === type).length;
    return n ? [[type, word, n] as const] : [];
  });
  if (rows.length < 2) return null;
  return (
    <div class="seg wide" role="radiogroup" aria-label="Who is changed">
      {[[null, 'All', all.value.length] as const, ...rows].map(([type, word, n]) => (
        <button
          key={word}
          type="button"
          class={`btn ${only.value === type ? 'on' : ''}`}
          role="radio"
          aria-checked={only.value === type}
          onClick={() => {
            only.value = type;
          }}
        >
          {word} {n}
        </button>
      ))}
    </div>
  );
}

interface RowProps {
  shared: Shared;
  those: Live;
  /** The field that each of them has fixed or free. */
  fixes?: readonly ['start' | 'goal', 'heading' | 'speed'];
}

function Row({ shared, those, fixes }: RowProps) {
  return (
    <div class={`pr ${fixes ? '' : 'wide'}`}>
      <span class="lab">{shared.word}</span>
      <div class="fs">
        <SharedField shared={shared} those={those} />
      </div>
      {fixes ? <FixedOf those={those} part={fixes[0]} field={fixes[1]} /> : null}
    </div>
  );
}

/** How many have a field fixed; a click fixes it for all at what each one has, or frees it for all. */
function FixedOf({ those, part, field }: { those: Live; part: 'start' | 'goal'; field: 'heading' | 'speed' }) {
  const { editor } = useApp();
  const fixed = useComputed(() => those.value.filter((a) => a[part][field] !== null).length).value;
  const all = those.value.length;
  const toggle = () => {
    const shown = (a: Agent): number | null => shownPose(editor, a, part)?.[field] ?? null;
    const command = several.fixAll(several.movable(those.peek()), part, field, shown);
    if (command) editor.run(command);
  };
  return (
    <button
      type="button"
      class="fx"
      role="switch"
      aria-checked={fixed === all ? 'true' : fixed ? 'mixed' : 'false'}
      aria-label={`${part === 'goal' ? 'Goal' : 'Start'} ${field} fixed for ${fixed} of ${all}`}
      title={
        fixed === all ? 'Fixed for all. Click to let the generator decide' : 'Click to fix it for all, each as it is'
      }
      onClick={toggle}
    >
      {fixed === all ? (
        <>
          <Icon name="lock" size={11} />
          Fixed
        </>
      ) : fixed ? (
        `${fixed} of ${all}`
      ) : (
        'Free'
      )}
    </button>
  );
}

function Values({ those }: { those: Live }) {
  const { editor } = useApp();
  const fields = sharedFields(editor);
  const goals = useComputed(() => those.value.filter((a) => hasGoal(a.goal)).length).value;
  return (
    <>
      <section class="sect" aria-label="Start">
        <h3>
          <span class="mkr" />
          Start
          <small>at 0.0 s</small>
        </h3>
        <Row shared={fields.heading} those={those} fixes={['start', 'heading']} />
        <Row shared={fields.speed} those={those} fixes={['start', 'speed']} />
        <Row shared={fields.length} those={those} />
        <Row shared={fields.width} those={those} />
        <Labelled label="Type">
          <Kinds those={those} />
        </Labelled>
      </section>
      <section class="sect goalsec" aria-label="Goal">
        <h3>
          <span class="mk">
            <Icon name="flag" size={15} />
          </span>
          Goal
          <small>{goals ? `${goals} of ${those.value.length} have one` : 'nobody has one'}</small>
        </h3>
        <Row shared={fields.goalSpeed} those={those} fixes={['goal', 'speed']} />
        <Row shared={fields.time} those={those} />
      </section>
    </>
  );
}

function Labelled({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class="pr wide">
      <span class="lab">{label}</span>
      {children}
    </div>
  );
}

function Kinds({ those }: { those: Live }) {
  const { editor } = useApp();
  return (
    <div class="kinds" role="group" aria-label="Type">
      {PLACED_KINDS.map((kind) => (
        <button
          key={kind}
          type="button"
          class={`btn i ${those.value.every((a) => a.kind === kind) ? 'on' : ''}`}
          title={`Each a ${KIND_NAMES[kind].toLowerCase()}`}
          aria-label={`Each a ${KIND_NAMES[kind].toLowerCase()}`}
          aria-pressed={those.value.every((a) => a.kind === kind)}
          onClick={() => {
            const command = several.setKind(several.movable(those.peek()), kind);
            if (command) editor.run(command);
          }}
        >
          <Icon name={kind} size={18} />
        </button>
      ))}
    </div>
  );
}

const DOES: readonly (readonly [string, string])[] = [
  ['does-react', 'React'],
  ['does-log', 'Replay log'],
  ['does-still', 'Hold still'],
];
const DO: Record<Others, readonly [string, string]> = {
  react: ['reacts', 'react'],
  log: ['replays its log', 'replay their log'],
  still: ['holds still', 'hold still'],
};

function Rule({ all }: { all: Live }) {
  const { editor } = useApp();
  const words = useComputed(() => {
    const scene = editor.scene.value!;
    const count = (does: Others): number => all.value.filter((a) => doing(scene, a) === does).length;
    const parts = (['react', 'log', 'still'] as const)
      .filter(count)
      .map((d) => `${count(d)} ${DO[d][count(d) > 1 ? 1 : 0]}`);
    return parts.length > 1
      ? `Mixed: ${parts.join(', ')}.`
      : `${actionOf(`others-${parts.length ? firstOf(scene, all.value) : 'react'}`).help}.`;
  });
  return (
    <section class="sect">
      <h3>
        Others’ rule
        <small>for these {all.value.length}</small>
      </h3>
      <Segments label="What they do while others change" items={DOES} />
      <p class="note">{words}</p>
    </section>
  );
}

const firstOf = (scene: Parameters<typeof doing>[0], all: readonly Agent[]): Others => doing(scene, all[0]);

/** When the two of them come closest that come closest; a click goes there. */
function ClosestLine({ those }: { those: Live }) {
  const { editor } = useApp();
  const found = useComputed(() => {
    const scene = editor.scene.value;
    if (!scene || editor.dragging.value || editor.motion.value.stale) return null;
    return closestOf(
      those.value.map((a) => [a, editor.motionFor(a)] as const),
      scene.duration,
    );
  }).value;
  if (!found) return null;
  const { a, b, gap, time } = found;
  return (
    <button
      type="button"
      class="closest"
      title="Go there"
      onClick={() => {
        editor.playhead.pause();
        editor.setTime(time);
      }}
    >
      <span class="grow">
        {a.name} and {b.name}: {gap > 0.005 ? `${num(gap, 1)} m` : 'they touch'}
      </span>
      <span class="mut">at {seconds(time)}</span>
    </button>
  );
}

const LISTED = 8;

function Who({ those }: { those: Live }) {
  const c = useApp();
  const { editor } = c;
  // While a hand moves them nothing is compared.
  const gap = useComputed(() =>
    editor.dragging.value
      ? null
      : gapNow(
          those.value.flatMap((a) => {
            const pose = poseShown(editor, a);
            return pose ? [{ pose, length: a.length, width: a.width }] : [];
          }),
        ),
  ).value;
  const shown = those.value.slice(0, LISTED);
  const more = those.value.length - shown.length;
  return (
    <section class="sect last">
      <h3>
        Who
        <small>{gap === null ? '' : `smallest gap ${num(gap, 1)} m now`}</small>
      </h3>
      <ClosestLine those={those} />
      {shown.map((a) => {
        const p = startPose(a);
        return (
          <button
            key={a.id}
            type="button"
            class="whorow"
            title="Select this one alone; with Shift take it away"
            onPointerEnter={() => editor.pointAt({ agent: a.id })}
            onPointerLeave={() => editor.pointAt({})}
            onClick={(e) => {
              if (e.shiftKey) editor.toggleSelected(a.id);
              else {
                editor.select(a.id);
                c.reveal([a.id]);
              }
            }}
          >
            <span class={`dot t-${a.parked ? 'parked' : a.type}`} />
            <span class="grow">{a.name}</span>
            {a.locked ? <Icon name="lock" size={12} /> : null}
            <span class="mut">{p ? speedLabel(p.speed, editor.unitOf(a)) : ''}</span>
          </button>
        );
      })}
      {more > 0 ? (
        <button type="button" class="whorow mut" onClick={() => perform(c, 'zoom-selection')}>
          and {more} more
        </button>
      ) : null}
    </section>
  );
}
