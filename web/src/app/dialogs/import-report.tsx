// Results of the import: one row for each file, faults below, and next steps.
import { Fragment, type ComponentChild } from 'preact';
import { useSignal } from '@preact/signals';
import type { FileVerdict } from '../../edit/tools/importing/file-verdict';
import { messageText } from '../../model/words/message-text';
import { SENTENCES } from '../../texts/messages/file-messages';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';
import { Columns } from './columns';
import MapPart from './map-part';
import { TEXTS } from '../../texts/files/imports';

/** Further rows are shown on demand. */
const MOST_ROWS = 12;

interface Rows<T> {
  readonly of: readonly T[];
  /** Rows that need attention come before the others. */
  readonly matters?: (row: T) => boolean;
  readonly row: (row: T) => ComponentChild;
}

/** Rows in order, limited until all are requested. */
function Few<T>({ of, matters = () => false, row }: Rows<T>) {
  const all = useSignal(false);
  const first = [...of.filter(matters), ...of.filter((r) => !matters(r))].slice(0, MOST_ROWS);
  const shown = all.value ? of : of.filter((r) => first.includes(r));
  return (
    <>
      {shown.map(row)}
      {of.length > shown.length ? (
        <button type="button" class="btn all" onClick={() => (all.value = true)}>
          {TEXTS.showAll(of.length)}
        </button>
      ) : null}
    </>
  );
}

export function ImportReport() {
  const { importing } = useApp();
  const verdicts = importing.verdicts.value ?? [];
  const close = () => importing.close();
  const bad = verdicts.filter((v) => !v.ok);
  const wrong = bad.some((v) => !v.columns && !v.map);
  return (
    <Modal label={TEXTS.import} class="import" close={close}>
      <div class="dhead">
        <span class={wrong ? 't-collision' : ''}>
          <Icon name={wrong ? 'warn' : bad.length ? 'table' : 'check'} size={22} />
        </span>
        <h2>{titleOf(verdicts)}</h2>
      </div>
      <div class="body">
        <Few
          of={verdicts}
          matters={(v) => !v.ok}
          row={(v) => <FileRow key={verdicts.indexOf(v)} verdict={v} open={bad.length === 1} />}
        />
      </div>
      <Foot bad={bad} allBad={bad.length === verdicts.length} close={close} />
    </Modal>
  );
}

/** `4 files: 2 imported, 1 readable in part, 1 not readable` */
function titleOf(verdicts: readonly FileVerdict[]): string {
  const part = verdicts.filter((v) => !v.ok && (v.without || v.columns || v.map)).length;
  const asked = verdicts.filter((v) => v.columns || v.map).length;
  const bad = verdicts.filter((v) => !v.ok).length - part;
  const good = verdicts.length - bad - part;
  const all = verdicts.length;
  if (all === 1) {
    if (good) {
      const n = verdicts[0].scenes.length;
      return TEXTS.scenesImported(n);
    }
    if (asked) return verdicts[0].map ? TEXTS.partOfMap : TEXTS.oneQuestionAbout;
    return part ? TEXTS.aPartOfThisFile : TEXTS.thisFileCould;
  }
  const counts = [
    good && TEXTS.good(good),
    part - asked && TEXTS.inPart(part - asked),
    asked && TEXTS.withAQuestion(asked),
    bad && TEXTS.notReadable(bad),
  ].filter(Boolean);
  return TEXTS.files(all, counts.join(', '));
}

/** The likeliest next step is the primary button and has the focus. */
function Foot({ bad, allBad, close }: { bad: readonly FileVerdict[]; allBad: boolean; close: () => void }) {
  const c = useApp();
  const details = bad.map((v) => v.details).filter(Boolean);
  const chooseAnother = () => {
    close();
    c.chooseFiles();
  };
  const mendable = bad.some((v) => v.without ?? v.columns ?? v.map ?? v.again);
  return (
    <div class="dfoot">
      <span class="mut">{TEXTS.yourFilesWere}</span>
      <span class="grow" />
      {details.length ? (
        <button type="button" class="btn" onClick={() => void navigator.clipboard?.writeText(details.join('\n'))}>
          {TEXTS.copyDetails}
        </button>
      ) : null}
      {bad.length ? (
        <button
          type="button"
          class={`btn ${allBad && !mendable ? 'pri' : 'line'}`}
          data-action="choose-files"
          data-first={allBad && !mendable ? '' : undefined}
          onClick={chooseAnother}
        >
          {TEXTS.chooseAnother}
        </button>
      ) : null}
      <button
        type="button"
        class={`btn ${allBad ? 'line' : 'pri'}`}
        data-first={allBad ? undefined : ''}
        onClick={close}
      >
        {TEXTS.close}
      </button>
    </div>
  );
}

function FileRow({ verdict: v, open }: { verdict: FileVerdict; open: boolean }) {
  const n = v.scenes.length;
  const count = v.scenes[0]?.count;
  const done = n > 1 ? TEXTS.scenes(n) : count ? TEXTS.roadUsers(count) : TEXTS.imported;
  return (
    <section class="filepart">
      <div class="filerow">
        <Icon name="file" />
        <b>{v.file}</b>
        <small class="mut">{v.kind}</small>
        {v.ok ? (
          <span class="tag ok">{done}</span>
        ) : v.columns ? (
          <span class="tag near">{TEXTS.assignColumns}</span>
        ) : v.map ? (
          <span class="tag near">{TEXTS.partTag}</span>
        ) : v.without ? (
          <span class="tag near">{TEXTS.inPartTag}</span>
        ) : (
          <span class="tag collision">{TEXTS.notAScene}</span>
        )}
      </div>
      {v.wrong ? <Wrong verdict={v} open={open} /> : null}
      {v.notes?.length ? (
        <ul class="notes">
          {v.notes.map(({ message, detail }) => (
            <li key={detail}>{messageText(message, detail, SENTENCES)}.</li>
          ))}
        </ul>
      ) : null}
      {n > 1 ? <ImportedScenes verdict={v} /> : null}
    </section>
  );
}

/** `open`: the place in the file is shown at once. */
function Wrong({ verdict: v, open }: { verdict: FileVerdict; open: boolean }) {
  const { importing } = useApp();
  const shown = useSignal(open);
  return (
    <div class="wrong">
      <Words verdict={v} />
      {v.columns ? <Columns verdict={v} of={v.columns} /> : null}
      {v.map ? <MapPart key={v.file} verdict={v} map={v.map} /> : null}
      {v.without || v.excerpt || v.again ? (
        <div class="ways">
          {v.without ? (
            <button type="button" class="btn pri" data-first="" onClick={() => void importing.reader?.takeRest(v)}>
              {TEXTS.importWithout(v.without.join(', '))}
            </button>
          ) : null}
          {v.again ? (
            <button type="button" class="btn pri" data-first="" onClick={() => void importing.reader?.tryAgain(v)}>
              {TEXTS.tryAgain}
            </button>
          ) : null}
          {v.excerpt ? (
            <button
              type="button"
              class="btn line"
              aria-expanded={shown.value}
              onClick={() => (shown.value = !shown.value)}
            >
              {shown.value ? TEXTS.hideLine(v.excerpt.line) : TEXTS.showLine(v.excerpt.line)}
            </button>
          ) : null}
        </div>
      ) : null}
      {shown.value && v.excerpt ? <Excerpt of={v.excerpt} /> : null}
    </div>
  );
}

/** The fault, its place, and the remedy. */
function Words({ verdict: v }: { verdict: FileVerdict }) {
  if (v.ok) return <p>{v.wrong}</p>;
  const rest = v.without ? TEXTS.fixItOrWithout(v.without.join(', ')) : v.todo;
  const rows = [
    [TEXTS.problem, v.wrong],
    [TEXTS.where, v.where],
    [TEXTS.whatToDo, rest],
  ] as const;
  return (
    <dl class="wh">
      {rows.map(([name, words], i) =>
        words ? (
          <Fragment key={name}>
            <dt>{name}</dt>
            <dd>{i ? words : <b>{words}</b>}</dd>
          </Fragment>
        ) : null,
      )}
    </dl>
  );
}

function Excerpt({ of }: { of: NonNullable<FileVerdict['excerpt']> }) {
  return (
    <pre>
      {of.lines.map((l, i) => (
        <span key={i} class={of.from + i === of.line ? 'here' : ''}>
          <i>{of.from + i}</i>
          {l}
          {'\n'}
        </span>
      ))}
    </pre>
  );
}

function ImportedScenes({ verdict }: { verdict: FileVerdict }) {
  const { importing, library } = useApp();
  const open = (id: string) => {
    importing.close();
    void library.open(id);
  };
  return (
    <Few
      of={verdict.scenes}
      row={(s) => (
        <div key={s.id} class="filerow">
          <button type="button" class="btn" onClick={() => open(s.id)}>
            {s.name}
          </button>
          {s.count ? <small class="mut">{TEXTS.roadUsers(s.count)}</small> : null}
        </div>
      )}
    />
  );
}
