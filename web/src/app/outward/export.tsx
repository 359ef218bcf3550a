// Exports of the scene: each with its losses, before the choice.
import { num } from '../../model/base/units';
import { useEffect, useRef } from 'preact/hooks';
import { useSignal, type Signal } from '@preact/signals';
import { saveAll, whyNot, type ExportedFile } from '../../edit/tools/outward/download';
import { found, meant } from '../../edit/tools/outward/finding';
import { WISHES } from '../../edit/tools/outward/formats';
import { stays, type Loss } from '../../edit/tools/outward/losses';
import type { VariantScope } from '../../edit/tools/variants/variants';
import type { FormatInfo } from '../../net/types';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Flyout } from './flyout';
import { ofScreen, ofServer, ofVariants, type ExportKind } from './kinds';
import '../../styles/outward.css';
import { resultCode } from '../../model/document/result-code';
import { TEXTS } from '../../texts/files/export';
import { TEXTS as CODE } from '../../texts/files/result-code';
import { inSentence } from '../../texts/language';

const SCOPES: readonly (readonly [VariantScope, string])[] = [
  ['present', TEXTS.thisScene],
  ['pair', TEXTS.both],
  ['kept', TEXTS.kept],
  ['starred', TEXTS.starred],
  ['all', TEXTS.allVariants],
];

export default function Export() {
  const { variants } = useApp();
  const scope = variants.scope.value;
  const offered = SCOPES.filter(([id]) => id === 'present' || variants.within(id).length);
  const now = offered.some(([id]) => id === scope) ? scope : 'present';
  return (
    <Flyout label={TEXTS.export} under="export" class="export">
      <div class="pad">
        <h2>{TEXTS.export}</h2>
        {offered.length > 1 ? (
          <div class="seg" role="radiogroup" aria-label={TEXTS.whatToExport}>
            {offered.map(([id, text]) => (
              <button
                key={id}
                type="button"
                role="radio"
                data-scope={id}
                aria-checked={id === now}
                class={`btn ${id === now ? 'on' : ''}`}
                onClick={() => variants.setScope(id)}
              >
                {id === 'present' ? text : `${text} ${variants.within(id).length}`}
              </button>
            ))}
          </div>
        ) : null}
      </div>
      <Kinds key={now} scope={now} />
    </Flyout>
  );
}

/** Beyond this number a search field is shown. */
const MANY = 8;

/** Kinds of export, once the server's formats are known. */
function Kinds({ scope }: { scope: VariantScope }) {
  const c = useApp();
  const kinds = useSignal<readonly ExportKind[] | null>(null);
  useEffect(() => {
    const offer = (formats: readonly FormatInfo[]) => {
      const all = ofServer(formats);
      const some = scope === 'present' ? [...all, ...ofScreen(c)] : ofVariants(all, c.variants.within(scope));
      kinds.value = WISHES.flatMap(([wish]) => some.filter((k) => k.wish === wish));
    };
    // Local kinds need no server.
    void c.client.formats().then(offer, () => offer([]));
  }, []);
  if (!kinds.value) return <div class="kinds waiting" aria-busy="true" />;
  return kinds.value.length ? <Offer kinds={kinds.value} /> : <p class="pad mut">{TEXTS.theServerIsNot}</p>;
}

/** Makes each file in turn; the viewed one comes first. */
function useFiles(kinds: readonly ExportKind[], chosen: Signal<string>, stop: AbortSignal) {
  const c = useApp();
  const made = useSignal<ReadonlyMap<string, ExportedFile | string>>(new Map());
  useEffect(() => {
    const put = (id: string, is: ExportedFile | string) => {
      made.value = new Map(made.peek()).set(id, is);
    };
    const todo = new Set(kinds.filter((of) => of.tag === undefined));
    void (async () => {
      while (todo.size && !stop.aborted) {
        const next = [...todo].find((k) => k.id === chosen.peek()) ?? [...todo][0];
        todo.delete(next);
        const is = await next.make(c, () => undefined, stop).catch(whyNot);
        if (is && !stop.aborted) put(next.id, is);
      }
    })();
  }, []);
  return made;
}

function Offer({ kinds }: { kinds: readonly ExportKind[] }) {
  const chosen = useSignal(kinds[0].id);
  const sought = useSignal('');
  const progress = useSignal<number | null>(null);
  const stop = useRef(new AbortController());
  useEffect(() => () => stop.current.abort(), []);
  const made = useFiles(kinds, chosen, stop.current.signal);
  const shown = found(kinds, sought.value);
  const kind = kinds.find((k) => k.id === chosen.value)!;
  const { editor } = useApp();
  const code = CODE.codeIs(resultCode(editor.scene.peek()!, editor.answers.motion.peek()));
  // A choice by earlier letters no longer applies.
  const ready = shown.length ? made.value.get(kind.id) : TEXTS.noFormatOfThat;
  const choose = (step: number) => {
    if (!shown.length) return;
    const next = shown[(shown.indexOf(kind) + step + shown.length) % shown.length];
    chosen.value = next.id;
    document.querySelector(`.export [data-kind="${next.id}"]`)?.scrollIntoView({ block: 'nearest' });
  };
  return (
    <>
      {kinds.length > MANY ? (
        <label class="find">
          <Icon name="search" size={16} />
          <input
            type="search"
            placeholder={TEXTS.findAFormatExcel}
            aria-label={TEXTS.findAFormat}
            onInput={(e) => {
              sought.value = e.currentTarget.value;
              // The chosen one is visible, and the one that the last letter finds.
              const best = sought.value.trim() && meant(found(kinds, sought.value), sought.value);
              if (best) chosen.value = best.id;
            }}
          />
        </label>
      ) : null}
      <div
        class="kinds"
        role="radiogroup"
        aria-label={TEXTS.kindOfFile}
        onKeyDown={(e) => {
          if (e.key !== 'ArrowDown' && e.key !== 'ArrowUp') return;
          e.preventDefault();
          choose(e.key === 'ArrowDown' ? 1 : -1);
        }}
      >
        {WISHES.map(([wish, label]) => {
          const some = shown.filter((k) => k.wish === wish);
          if (!some.length) return null;
          return (
            <section key={wish} class="wish" role="group" aria-label={label}>
              <h3>{label}</h3>
              {some.map((k) => (
                <KindRow key={k.id} kind={k} made={made} chosen={chosen} />
              ))}
            </section>
          );
        })}
      </div>
      <div class="dfoot">
        <span class="grow">
          <span class="about">
            {TEXTS.metresXEastY} {code}
          </span>
          {typeof ready === 'object' ? fileWords(ready) : (ready ?? `${kind.label} ${kind.ending}`)}
        </span>
        <SaveButton kind={kind} ready={ready} progress={progress} stop={stop.current.signal} />
      </div>
    </>
  );
}

function fileWords({ name, blob, others = [] }: ExportedFile): string {
  const size = [blob, ...others.map((f) => f.blob)].reduce((sum, b) => sum + b.size, 0);
  return `${others.length ? TEXTS.files(others.length + 1) : name} · ${sizeWords(size)}`;
}

const sizeWords = (bytes: number): string =>
  bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1000))} KB` : `${num(bytes / 1e6, 1)} MB`;

interface KindRowProps {
  kind: ExportKind;
  made: Signal<ReadonlyMap<string, ExportedFile | string>>;
  chosen: Signal<string>;
}

function KindRow({ kind: k, made, chosen }: KindRowProps) {
  const on = chosen.value === k.id;
  const is = made.value.get(k.id);
  const losses = typeof is === 'object' ? is.losses : null;
  return (
    <>
      <button
        type="button"
        class="kind"
        role="radio"
        aria-checked={on}
        data-kind={k.id}
        data-first={on ? '' : undefined}
        tabIndex={on ? 0 : -1}
        onClick={() => (chosen.value = k.id)}
      >
        <i class="radio" />
        <Icon name={k.icon} size={16} />
        <span class="name">
          <b>{k.label}</b> <small>{k.ending}</small>
          <span class="says">{k.says}</span>
        </span>
        {k.tag ? (
          <span class="tag">{k.tag}</span>
        ) : typeof is === 'string' ? (
          <span class="tag collision">{TEXTS.notPossible}</span>
        ) : losses === null ? (
          <span class="tag">…</span>
        ) : losses.length ? (
          <span class="tag near">{lossTag(losses)}</span>
        ) : (
          <span class="tag ok">{TEXTS.lossless}</span>
        )}
      </button>
      {on && typeof is === 'string' ? <div class="why">{is}</div> : null}
      {on && losses?.length ? <Losses of={losses} /> : null}
    </>
  );
}

/** Short lists are named, longer ones counted. */
const MOST_NAMED = 24;

function lossTag(losses: readonly Loss[]): string {
  const named = losses.map(({ what }) => inSentence(what)).join(', ');
  if (named.length <= MOST_NAMED) return TEXTS.loses(named);
  return TEXTS.lossesCount(losses.length);
}

/** A longer list is collapsed at first. */
const MOST_LOSSES = 6;

function Losses({ of }: { of: readonly Loss[] }) {
  const { editor } = useApp();
  const all = useSignal(of.length <= MOST_LOSSES);
  return (
    <>
      <div class="why">
        <b class="head">
          <Icon name="warn" size={15} /> {TEXTS.leftOut}
        </b>
        <dl>
          {of.slice(0, all.value ? of.length : MOST_LOSSES - 1).map(({ what, how }) => (
            <div key={what}>
              <dt>{what}</dt>
              <dd>{how}</dd>
            </div>
          ))}
        </dl>
        {all.value ? null : (
          <button type="button" class="more" onClick={() => (all.value = true)}>
            {TEXTS.all(of.length)}
          </button>
        )}
      </div>
      <p class="stays">{TEXTS.exported(stays(of, editor.scene.peek()!))}</p>
    </>
  );
}

interface SaveButtonProps {
  kind: ExportKind;
  ready: ExportedFile | string | undefined;
  progress: Signal<number | null>;
  stop: AbortSignal;
}

function SaveButton({ kind, ready, progress, stop }: SaveButtonProps) {
  const c = useApp();
  const n = typeof ready === 'object' ? ready.losses.length : 0;
  const off = typeof ready === 'string' || progress.value !== null;
  const go = async () => {
    if (off) return;
    try {
      progress.value = 0;
      const file = typeof ready === 'object' ? ready : await kind.make(c, (share) => (progress.value = share), stop);
      if (!file) return;
      saveAll(c.editor, [file, ...(file.others ?? [])]);
      c.ui.closeDialog();
    } catch (e) {
      c.editor.notices.show({ text: TEXTS.notExported(whyNot(e)) });
    } finally {
      progress.value = null;
    }
  };
  const words = n ? TEXTS.saveWithLosses(n) : TEXTS.save;
  return (
    <button
      type="button"
      class={`btn pri ${off ? 'off' : ''}`}
      aria-disabled={off}
      title={typeof ready === 'string' ? ready : undefined}
      onClick={() => void go()}
    >
      {progress.value === null ? words : progress.value > 0 ? `${Math.round(progress.value * 100)} %` : TEXTS.saving}
    </button>
  );
}
