// What became of the files that were brought in.
import type { ComponentChildren } from 'preact';
import type { FileVerdict } from '../../edit/importing';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';

export function ImportReport({ verdicts }: { verdicts: readonly FileVerdict[] }) {
  const { importing } = useApp();
  const close = () => importing.close();
  const bad = verdicts.filter((v) => !v.ok);
  const first = bad[0];
  return (
    <Modal label="Import" class="import" close={close}>
      <header>
        <span class={bad.length ? 't-collision' : ''}>
          <Icon name={bad.length ? 'warn' : 'check'} size={22} />
        </span>
        <h2>{titleOf(verdicts, bad.length)}</h2>
      </header>
      <div class="body">
        {verdicts.map((v, i) => (
          <FileRow key={i} verdict={v} />
        ))}
        {first ? <Explanation verdict={first} /> : null}
      </div>
      <Foot first={first} allBad={bad.length === verdicts.length} close={close} />
    </Modal>
  );
}

function titleOf(verdicts: readonly FileVerdict[], bad: number): string {
  const all = verdicts.length;
  const good = all - bad;
  if (!bad) return all === 1 ? `${verdicts[0].scenes.length} scenes imported` : `All ${all} files are in`;
  if (good) return `${good} of ${all} files are in, ${bad} could not be read`;
  return bad === 1 ? 'This file could not be read' : `None of the ${bad} files could be read`;
}

/** The likeliest next step is drawn as such and has the focus. */
function Foot({ first, allBad, close }: { first: FileVerdict | undefined; allBad: boolean; close: () => void }) {
  const c = useApp();
  const chooseAnother = () => {
    close();
    c.chooseFiles();
  };
  return (
    <footer>
      {first?.details ? (
        <button type="button" class="btn line" onClick={() => void navigator.clipboard?.writeText(first.details!)}>
          Copy details
        </button>
      ) : null}
      <span class="grow" />
      <button
        type="button"
        class={`btn ${allBad ? 'line' : 'pri'}`}
        data-first={allBad ? undefined : ''}
        onClick={close}
      >
        Close
      </button>
      {first ? (
        <button
          type="button"
          class={`btn ${allBad ? 'pri' : 'line'}`}
          data-action="choose-files"
          data-first={allBad ? '' : undefined}
          onClick={chooseAnother}
        >
          Choose another file
        </button>
      ) : null}
    </footer>
  );
}

function FileRow({ verdict: v }: { verdict: FileVerdict }) {
  const n = v.scenes.length;
  const count = v.scenes[0]?.count;
  const done = n > 1 ? `${n} scenes` : count ? `Imported, ${count} road users` : 'Imported';
  return (
    <>
      <div class="filerow">
        <Icon name="file" />
        {v.file}
        {v.ok ? <span class="tag ok">{done}</span> : <span class="tag collision">Not imported</span>}
      </div>
      {v.ok && v.wrong ? <p class="note">{v.wrong}</p> : null}
      {n > 1 ? <ImportedScenes verdict={v} /> : null}
    </>
  );
}

function ImportedScenes({ verdict }: { verdict: FileVerdict }) {
  const { importing, library } = useApp();
  const open = (id: string) => {
    importing.close();
    void library.open(id);
  };
  return (
    <>
      {verdict.scenes.map((s) => (
        <div key={s.id} class="filerow">
          <button type="button" class="btn" onClick={() => open(s.id)}>
            {s.name}
          </button>
          {s.count ? <small class="mut">{s.count} road users</small> : null}
        </div>
      ))}
    </>
  );
}

function Explanation({ verdict: v }: { verdict: FileVerdict }) {
  const rows: [string, ComponentChildren][] = [
    ['What is wrong', v.wrong && <b>{v.wrong}</b>],
    ['Where', v.where],
    ['What to do', v.todo],
  ];
  return (
    <dl class="wh">
      {rows.flatMap(([what, words]) => (words ? [<dt key={what}>{what}</dt>, <dd key={`${what}:`}>{words}</dd>] : []))}
    </dl>
  );
}
