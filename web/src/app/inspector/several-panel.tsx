// The inspector of several: common values, and one value for all of them.
import { useComputed, useSignal, type ReadonlySignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { KIND_WORDS, kindsWords, PLACED_KINDS, type AgentType } from '../../model/base/kinds';
import { doing, hasGoal, touched, type Agent, type Others } from '../../model/document/scene';
import { metres, seconds, speedLabel } from '../../model/base/units';
import { perform } from '../../actions/registry';
import * as several from '../../edit/moves/several';
import { gapNow, timeToCollision } from '../../model/physics/proximity';
import { poseShown } from '../../edit/overlay/frame';
import { shownPose } from '../../edit/moves/moves';
import { OTHERS_DO } from '../parts/others';
import { useApp } from '../parts/app-context';
import { ActionButton, IconButton, Segments } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Nearest } from './nearest';
import { SharedField, sharedFields, type FieldOfSeveral } from './shared-field';
import { inSentence } from '../../texts/language';
import { TEXTS } from '../../texts/panels/several-panel';

const GROUPS: readonly (readonly [AgentType, string])[] = [
  ['pedestrian', TEXTS.onFoot],
  ['cyclist', TEXTS.cycling],
  ['vehicle', TEXTS.driving],
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
          {TEXTS.allSelected}
          <small>{TEXTS.editsApplyToAll}</small>
        </h3>
        <Filter all={all} only={only} />
        {locked ? <p class="note">{TEXTS.lockedAreNotChanged(locked)}</p> : null}
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
  const count = useComputed(() => TEXTS.roadUsers(all.value.length));
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

/** Limits edits to one type. */
function Filter({ all, only }: { all: Live; only: { value: AgentType | null } }) {
  const rows = GROUPS.flatMap(([type, word]) => {
    const n = all.value.filter((a) => a.type === type).length;
    return n ? [[type, word, n] as const] : [];
  });
  if (rows.length < 2) return null;
  return (
    <div class="seg wide" role="radiogroup" aria-label={TEXTS.applyChangesTo}>
      {[[null, TEXTS.all, all.value.length] as const, ...rows].map(([type, word, n]) => (
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

interface SharedRowProps {
  shared: FieldOfSeveral;
  those: Live;
  /** The field that each of them has fixed or free. */
  fixes?: readonly ['start' | 'goal', 'heading' | 'speed'];
}

function Row({ shared, those, fixes }: SharedRowProps) {
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

/** Number with a fixed field; a click fixes it for all at their own values, or frees it for all. */
function FixedOf({ those, part, field }: { those: Live; part: 'start' | 'goal'; field: 'heading' | 'speed' }) {
  const { editor } = useApp();
  const fixed = useComputed(() => those.value.filter((a) => a[part][field] !== null).length).value;
  const all = those.value.length;
  const toggle = () => {
    const shown = (a: Agent): number | null => shownPose(editor, a, part)?.[field] ?? null;
    const command = several.fixAll(several.movable(those.peek()), part, field, shown);
    if (command) editor.commits.run(command);
  };
  const word = inSentence(field === 'heading' ? TEXTS.heading : TEXTS.speed);
  return (
    <button
      type="button"
      class="fx"
      role="switch"
      aria-checked={fixed === all ? 'true' : fixed ? 'mixed' : 'false'}
      aria-label={part === 'goal' ? TEXTS.goalFixedFor(word, fixed, all) : TEXTS.startFixedFor(word, fixed, all)}
      title={fixed === all ? TEXTS.fixedForAllClick : TEXTS.clickToFixIt}
      onClick={toggle}
    >
      {fixed === all ? (
        <>
          <Icon name="lock" size={11} />
          {TEXTS.fixed}
        </>
      ) : fixed ? (
        TEXTS.of(fixed, all)
      ) : (
        TEXTS.free
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
      <section class="sect" aria-label={TEXTS.start}>
        <h3>
          <span class="mkr" />
          {TEXTS.start}
          <small>{TEXTS.at00S}</small>
        </h3>
        <Row shared={fields.heading} those={those} fixes={['start', 'heading']} />
        <Row shared={fields.speed} those={those} fixes={['start', 'speed']} />
        <Row shared={fields.length} those={those} />
        <Row shared={fields.width} those={those} />
        <Labelled label={TEXTS.type}>
          <Kinds those={those} />
        </Labelled>
      </section>
      <section class="sect goalsec" aria-label={TEXTS.goal}>
        <h3>
          <span class="mk">
            <Icon name="flag" size={15} />
          </span>
          {TEXTS.goal}
          <small>{goals ? TEXTS.setForOf(goals, those.value.length) : TEXTS.notSet}</small>
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
    <div class="kinds" role="group" aria-label={TEXTS.type}>
      {PLACED_KINDS.map((kind) => (
        <button
          key={kind}
          type="button"
          class={`btn i ${those.value.every((a) => a.kind === kind) ? 'on' : ''}`}
          title={TEXTS.changeAllTo(KIND_WORDS[kind])}
          aria-label={TEXTS.changeAllTo(KIND_WORDS[kind])}
          aria-pressed={those.value.every((a) => a.kind === kind)}
          onClick={() => {
            const command = several.setKind(several.movable(those.peek()), kind);
            if (command) editor.commits.run(command);
          }}
        >
          <Icon name={kind} size={18} />
        </button>
      ))}
    </div>
  );
}

const DOES: readonly (readonly [string, string])[] = [
  ['does-react', TEXTS.react],
  ['does-log', TEXTS.replayLog],
  ['does-still', TEXTS.holdStill],
];
const DO: Record<Others, readonly [string, string]> = {
  react: [TEXTS.reacts, TEXTS.reactWithin],
  log: [TEXTS.replaysItsLog, TEXTS.replayTheirLog],
  still: [TEXTS.holdsStill, TEXTS.holdStillWithin],
};

/** It applies to road users without conditions: the others follow theirs. */
function Rule({ all: chosen }: { all: Live }) {
  const { editor } = useApp();
  const all = useComputed(() => chosen.value.filter((a) => !touched(a)));
  const any = useComputed(() => all.value.length > 0).value;
  const words = useComputed(() => {
    const scene = editor.scene.value!;
    const count = (does: Others): number => all.value.filter((a) => doing(scene, a) === does).length;
    const parts = (['react', 'log', 'still'] as const)
      .filter(count)
      .map((d) => `${count(d)} ${DO[d][count(d) > 1 ? 1 : 0]}`);
    return parts.length > 1
      ? TEXTS.mixed(parts.join(', '))
      : OTHERS_DO[parts.length ? firstOf(scene, all.value) : 'react'];
  });
  if (!any) return null;
  return (
    <section class="sect">
      <h3>
        {TEXTS.whenOthersChange}
        <small>{TEXTS.forThese(all.value.length)}</small>
      </h3>
      <Segments label={TEXTS.behaviour} items={DOES} />
      <p class="note">{words}</p>
    </section>
  );
}

const firstOf = (scene: Parameters<typeof doing>[0], all: readonly Agent[]): Others => doing(scene, all[0]);

const LISTED = 8;

function Who({ those }: { those: Live }) {
  const c = useApp();
  const { editor } = c;
  // During a drag nothing is compared.
  const now = useComputed(() => {
    if (editor.drag.active.value) return '';
    const boxes = those.value.flatMap((a) => {
      const pose = poseShown(editor, a);
      return pose ? [{ pose, length: a.length, width: a.width }] : [];
    });
    const gap = gapNow(boxes);
    const left = boxes.length === 2 ? timeToCollision(boxes[0], boxes[1]) : null;
    if (gap === null) return '';
    return left === null ? TEXTS.smallestGap(metres(gap, 1)) : TEXTS.gapAndTtc(metres(gap, 1), seconds(left));
  }).value;
  const shown = those.value.slice(0, LISTED);
  const more = those.value.length - shown.length;
  return (
    <section class="sect last">
      <h3>
        {TEXTS.roadUsersTitle}
        <small>{now}</small>
      </h3>
      <Nearest those={those} />
      {shown.map((a) => (
        <button
          key={a.id}
          type="button"
          class="whorow"
          title={TEXTS.selectThisOne}
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
          <SpeedNow agent={a} />
        </button>
      ))}
      {more > 0 ? (
        <button type="button" class="whorow mut" onClick={() => perform(c, 'zoom-selection')}>
          {TEXTS.andMore(more)}
        </button>
      ) : null}
    </section>
  );
}

/** Displayed speed of a road user at the playhead. */
function SpeedNow({ agent }: { agent: Agent }) {
  const { editor } = useApp();
  const words = useComputed(() => {
    // From the current document: the given object may be older than a change.
    const a = editor.scene.value?.agents.get(agent.id);
    const p = a && poseShown(editor, a);
    return p ? speedLabel(p.speed, editor.view.unitOf(a)) : '';
  });
  return <span class="mut">{words}</span>;
}
