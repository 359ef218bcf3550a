// Files out of the scene: each with what it loses, before it is chosen.
import { useEffect, useRef } from 'preact/hooks';
import { useSignal, type Signal } from '@preact/signals';
import type { Context } from '../../actions/context';
import { exported, exportedJson, saveAll, slug, whyNot, type ExportedFile } from '../../edit/download';
import type { WholeCard } from '../../edit/variants/cards';
import type { Scope } from '../../edit/variants/variants';
import { film, filmEnding, filmKind } from '../../edit/outward/film';
import { reportPage } from '../../edit/outward/report-page';
import { SvgPen } from '../../draw/svg-pen';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Flyout } from './flyout';
import '../../styles/outward.css';

interface Kind {
  readonly id: string;
  readonly label: string;
  readonly ending: string;
  readonly icon: string;
  /** In place of a loss, for what is to be looked at. */
  readonly tag?: string;
  make(c: Context, progress: (share: number) => void, stop: AbortSignal): Promise<ExportedFile | null>;
}

const FINE = 2;
const ofServer = (id: string, label: string, ending: string, icon: string): Kind => ({
  id,
  label,
  ending,
  icon,
  make: (c) => exported(c, id),
});

const named = (c: Context, blob: Blob, ending: string): ExportedFile => ({
  blob,
  name: `${slug(c.editor.scene.peek()?.name)}.${ending}`,
  losses: [],
});

function pictureOf({ stage }: Context): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  stage.paintOn(canvas, ['map', 'agents', 'overlay'], FINE);
  return canvas;
}

const FORMATS: Kind[] = [
  ofServer('dragtraffic', 'Saved scene', '.json', 'layers'),
  ofServer('womd', 'Scenario record', '.tfrecord', 'file'),
  ofServer('csv', 'Table of motion', '.csv', 'table'),
  ofServer('parquet', 'Table of motion', '.parquet', 'table'),
  ofServer('html', 'Page that plays', '.html', 'film'),
  ofServer('geojson', 'GeoJSON', '.geojson', 'layers'),
  ofServer('av2', 'Argoverse scenario', '.av2.parquet', 'file'),
  ofServer('mcap', 'Foxglove log', '.mcap', 'file'),
];

function kindsFor(c: Context): Kind[] {
  const { editor, stage } = c;
  const time = editor.time.peek();
  const scene = editor.scene.peek()!;
  const view = `this view at ${time.toFixed(1)} s`;
  const moving = filmKind();
  return [
    ...FORMATS,
    {
      id: 'report',
      label: 'Report page',
      ending: '.html',
      icon: 'report',
      tag: 'to read, not to edit',
      make: async () => {
        const picture = pictureOf(c).toDataURL('image/png');
        const page = reportPage({
          scene,
          motion: editor.motion.peek(),
          events: editor.events.peek(),
          unit: editor.speedUnit.peek(),
          picture,
          time,
          origin: originOf(c),
        });
        return named(c, new Blob([page], { type: 'text/html' }), 'html');
      },
    },
    {
      id: 'png',
      label: 'Image',
      ending: '.png',
      icon: 'image',
      tag: view,
      make: async () => {
        const canvas = pictureOf(c);
        const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, 'image/png'));
        return blob && named(c, blob, 'png');
      },
    },
    {
      id: 'svg',
      label: 'Drawing',
      ending: '.svg',
      icon: 'image',
      tag: view,
      make: async () => {
        const pen = new SvgPen();
        stage.paintWith(pen, ['map', 'agents', 'overlay']);
        const { w, h, z } = stage.view;
        const about = `${z.toFixed(2)} px a metre; x east, y north`;
        const drawing = pen.file(w, h, `${scene.name}, ${time.toFixed(1)} s`, about);
        return named(c, new Blob([drawing], { type: 'image/svg+xml' }), 'svg');
      },
    },
    ...(moving
      ? [
          {
            id: 'film',
            label: 'Film',
            ending: `.${filmEnding(moving)}`,
            icon: 'film',
            tag: `${scene.duration.toFixed(1)} s, 30 a second`,
            make: async (_: Context, progress: (share: number) => void, stop: AbortSignal) => {
              const blob = await film(editor, stage, moving, progress, stop);
              return blob && named(c, blob, filmEnding(moving));
            },
          },
        ]
      : []),
  ];
}

function originOf({ file }: Context): string {
  const o = file.raw?.meta?.origin as { x_m?: number; y_m?: number; crs?: string | null } | undefined;
  if (!o?.x_m && !o?.y_m) return 'The origin is that of the scene.';
  return `The origin lies at ${o.x_m ?? 0}, ${o.y_m ?? 0} m of ${o.crs ?? 'the recording'}.`;
}

const SCOPES: readonly (readonly [Scope, string])[] = [
  ['present', 'This scene'],
  ['pair', 'Both'],
  ['kept', 'Kept'],
  ['starred', 'Starred'],
  ['all', 'All variants'],
];

export default function Export() {
  const { variants } = useApp();
  const scope = variants.scope.value;
  const offered = SCOPES.filter(([id]) => id === 'present' || variants.within(id).length);
  const now = offered.some(([id]) => id === scope) ? scope : 'present';
  return (
    <Flyout label="Export" under="export" class="export">
      <div class="pad">
        <h2>Export</h2>
        {offered.length > 1 ? (
          <div class="seg" role="radiogroup" aria-label="What goes out">
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

/** Several variants in one format: a file each. A file of records has room for all of them. */
function ofVariants(kind: Kind, cards: readonly WholeCard[]): Kind {
  return {
    ...kind,
    make: async ({ client, editor, file }, progress, stop) => {
      const files: ExportedFile[] = [];
      const { name } = editor.scene.peek()!;
      for (const card of cards) {
        if (stop.aborted) return null;
        const alone = { ...card.scene, name: `${name}, ${card.id} ${card.name}`, variants: [], variantStates: {} };
        const json = file.completeOf(alone, card.set);
        if (json) files.push(await exportedJson(client, json, kind.id));
        progress(files.length / cards.length);
      }
      const losses = [...new Set(files.flatMap((f) => f.losses))];
      if (kind.id !== 'womd') return { ...files[0], losses, others: files.slice(1) };
      // Records follow each other in a file.
      return { blob: new Blob(files.map((f) => f.blob)), name: `${slug(name)}-variants${kind.ending}`, losses };
    },
  };
}

function Kinds({ scope }: { scope: Scope }) {
  const c = useApp();
  const kinds = useRef(
    scope === 'present' ? kindsFor(c) : FORMATS.map((k) => ofVariants(k, c.variants.within(scope))),
  ).current;
  const made = useSignal<ReadonlyMap<string, ExportedFile | string>>(new Map());
  const chosen = useSignal(kinds[0].id);
  const progress = useSignal<number | null>(null);
  const stop = useRef(new AbortController());
  useEffect(() => {
    let open = true;
    const put = (id: string, is: ExportedFile | string) => {
      if (open) made.value = new Map(made.peek()).set(id, is);
    };
    void (async () => {
      // One after the other: the generator has other things to do.
      for (const k of kinds.filter((of) => of.tag === undefined))
        await k
          .make(c, () => undefined, stop.current.signal)
          .then(
            (f) => f && put(k.id, f),
            (e: unknown) => put(k.id, whyNot(e)),
          );
    })();
    return () => {
      open = false;
      stop.current.abort();
    };
  }, []);
  const kind = kinds.find((k) => k.id === chosen.value)!;
  const ready = made.value.get(kind.id);
  const choose = (step: number) => {
    const at = kinds.indexOf(kind);
    chosen.value = kinds[(at + step + kinds.length) % kinds.length].id;
  };
  return (
    <>
      <div
        class="kinds"
        role="radiogroup"
        aria-label="Kind of file"
        onKeyDown={(e) => {
          if (e.key !== 'ArrowDown' && e.key !== 'ArrowUp') return;
          e.preventDefault();
          choose(e.key === 'ArrowDown' ? 1 : -1);
        }}
      >
        {kinds.map((k) => (
          <KindRow key={k.id} kind={k} made={made} chosen={chosen} />
        ))}
      </div>
      <div class="dfoot">
        <span>
          <span class="about">Metres, x east, y north, 0 s = first step. Written into the file.</span>
          {typeof ready === 'object' ? fileWords(ready) : (ready ?? `${kind.label} ${kind.ending}`)}
        </span>
        <span class="grow" />
        <SaveButton kind={kind} ready={ready} progress={progress} stop={stop.current.signal} />
      </div>
    </>
  );
}

function fileWords({ name, blob, others = [] }: ExportedFile): string {
  const size = [blob, ...others.map((f) => f.blob)].reduce((sum, b) => sum + b.size, 0);
  return `${others.length ? `${others.length + 1} files` : name} · ${sizeWords(size)}`;
}

const sizeWords = (bytes: number): string =>
  bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1000))} KB` : `${(bytes / 1e6).toFixed(1)} MB`;

interface KindRowProps {
  kind: Kind;
  made: Signal<ReadonlyMap<string, ExportedFile | string>>;
  chosen: Signal<string>;
}

function KindRow({ kind: k, made, chosen }: KindRowProps) {
  const on = chosen.value === k.id;
  const is = made.value.get(k.id);
  const losses = typeof is === 'object' ? is.losses : null;
  const n = losses?.length ?? 0;
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
        <b>{k.label}</b>
        <small>{k.ending}</small>
        {k.tag ? (
          <span class="tag">{k.tag}</span>
        ) : typeof is === 'string' ? (
          <span class="tag collision">not possible</span>
        ) : losses === null ? (
          <span class="tag">…</span>
        ) : n ? (
          <span class="tag near">{`${n} thing${n > 1 ? 's' : ''} lost`}</span>
        ) : (
          <span class="tag ok">nothing lost</span>
        )}
      </button>
      {on && typeof is === 'string' ? <div class="why">{is}</div> : null}
      {on && n ? (
        <div class="why">
          <b>What will not be in the file</b>
          <Losses of={losses!} />
        </div>
      ) : null}
    </>
  );
}

/** A list that is longer is opened by hand. */
const MOST_LOSSES = 5;

function Losses({ of }: { of: readonly string[] }) {
  const all = useSignal(of.length <= MOST_LOSSES);
  return (
    <ul>
      {of.slice(0, all.value ? of.length : MOST_LOSSES - 1).map((l) => (
        <li key={l}>{l}</li>
      ))}
      {all.value ? null : (
        <li>
          <button type="button" class="more" onClick={() => (all.value = true)}>
            all {of.length}
          </button>
        </li>
      )}
    </ul>
  );
}

interface SaveButtonProps {
  kind: Kind;
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
      c.editor.notices.show({ text: `Not exported: ${whyNot(e)}` });
    } finally {
      progress.value = null;
    }
  };
  const words = n ? `Save, losing ${n} thing${n > 1 ? 's' : ''}` : 'Save';
  return (
    <button type="button" class={`btn pri ${off ? 'off' : ''}`} aria-disabled={off} onClick={() => void go()}>
      {progress.value === null ? words : kind.id === 'film' ? `${Math.round(progress.value * 100)} %` : 'Saving …'}
    </button>
  );
}
