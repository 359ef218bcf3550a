// Kinds of export: the server's formats, and local ones of the screen.
import { deg } from '../../model/base/geometry';
import { num, seconds } from '../../model/base/units';
import type { Context } from '../../actions/context';
import { exported, exportedJson, slug, type ExportedFile } from '../../edit/tools/outward/download';
import { eventsTable } from '../../edit/tools/outward/events-table';
import type { Findable } from '../../edit/tools/outward/finding';
import { film, filmEnding, filmKind } from '../../edit/tools/outward/film';
import { movingPicture } from '../../edit/tools/outward/moving-picture';
import { outFormats, type ExportPurpose } from '../../edit/tools/outward/formats';
import { reportPage } from '../../edit/tools/outward/report-page';
import type { WholeCard } from '../../edit/tools/variants/cards';
import { paintLegend } from '../../draw/legend';
import { opaquePen, paintOn } from '../../draw/recording/replay';
import { SvgPen } from '../../draw/svg-pen';
import type { FormatInfo } from '../../net/types';
import { TEXTS } from '../../texts/files/export';

export interface ExportKind extends Findable {
  readonly id: string;
  readonly wish: ExportPurpose;
  readonly icon: string;
  /** In place of losses, for media. */
  readonly tag?: string;
  make(c: Context, progress: (share: number) => void, stop: AbortSignal): Promise<ExportedFile | null>;
}

const FINE = 2;
/** The server's formats, for the shown scene. */
export const ofServer = (formats: readonly FormatInfo[]): ExportKind[] =>
  outFormats(formats).map((f) => ({ ...f, make: (c) => exported(c, f.id) }));

const named = (c: Context, blob: Blob, ending: string, what = ''): ExportedFile => ({
  blob,
  name: `${slug([c.editor.scene.peek()?.name, what].filter(Boolean).join(' '))}.${ending}`,
  losses: [],
});

function pictureOf({ editor, stage }: Context): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  stage.paintOn(canvas, ['map', 'agents', 'overlay'], FINE);
  const g = opaquePen(canvas);
  g.setTransform(FINE, 0, 0, FINE, 0, 0);
  paintOn(g, (pen) => paintLegend(pen, stage.view, editor.playhead.time.peek()));
  return canvas;
}

/** Local exports: events, pictures and a report of the screen. */
export function ofScreen(c: Context): ExportKind[] {
  const { editor, stage } = c;
  const time = editor.playhead.time.peek();
  const scene = editor.scene.peek()!;
  const view = TEXTS.thisViewAtS(num(time, 1));
  const moving = filmKind();
  return [
    {
      id: 'events',
      wish: 'table',
      says: TEXTS.oneRowPerEvent,
      label: TEXTS.eventsAsATable,
      ending: '.csv',
      icon: 'warn',
      name: TEXTS.eventsTableNames,
      tag: TEXTS.eventsInIt(editor.reading.events.peek().length),
      make: () => {
        const rows = eventsTable(editor.reading.events.peek());
        return Promise.resolve(named(c, new Blob([rows], { type: 'text/csv' }), 'csv', TEXTS.eventsName));
      },
    },
    {
      id: 'report',
      wish: 'show',
      says: TEXTS.aShortSummary,
      label: TEXTS.reportPage,
      ending: '.html',
      icon: 'report',
      tag: TEXTS.readOnly,
      make: async () => {
        const picture = pictureOf(c).toDataURL('image/png');
        const page = reportPage({
          scene,
          motion: editor.answers.motion.peek(),
          events: editor.reading.events.peek(),
          variant: c.variants.card(c.variants.shown.peek())?.name ?? null,
          unit: editor.view.speedUnit.peek(),
          picture,
          time,
          origin: originOf(c),
        });
        return named(c, new Blob([page], { type: 'text/html' }), 'html', TEXTS.report);
      },
    },
    {
      id: 'png',
      wish: 'show',
      says: TEXTS.viewForSlides,
      label: TEXTS.image,
      ending: '.png',
      icon: 'image',
      name: TEXTS.imageNames,
      tag: view,
      make: async () => {
        const canvas = pictureOf(c);
        const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, 'image/png'));
        return blob && named(c, blob, 'png');
      },
    },
    {
      id: 'svg',
      wish: 'show',
      says: TEXTS.viewAsVectors,
      label: TEXTS.drawing,
      ending: '.svg',
      icon: 'image',
      name: TEXTS.drawingNames,
      tag: view,
      make: async () => {
        const pen = new SvgPen();
        stage.paintWith(pen, ['map', 'agents', 'overlay']);
        pen.setTransform(1, 0, 0, 1, 0, 0);
        paintLegend(pen, stage.view, time);
        const { w, h, z, turn } = stage.view;
        const turned = turn ? TEXTS.turnedCounterClockwise(num(deg(turn), 1)) : '';
        const about = TEXTS.pxPerMetre(num(z, 2)) + turned;
        const drawing = pen.file(w, h, `${scene.name}, ${seconds(time)}`, about);
        return named(c, new Blob([drawing], { type: 'image/svg+xml' }), 'svg');
      },
    },
    {
      id: 'gif',
      wish: 'show',
      says: TEXTS.viewAsLoop,
      label: TEXTS.animation,
      ending: '.gif',
      icon: 'film',
      // Without film support the animation stands in for a film.
      name: moving ? TEXTS.animationNames : `${TEXTS.animationNames}, ${TEXTS.videoNames}`,
      tag: TEXTS.sAt10Fps(num(scene.duration, 1)),
      make: async (_, progress, stop) => {
        const blob = await movingPicture(editor, stage, progress, stop);
        return blob && named(c, blob, 'gif');
      },
    },
    ...(moving
      ? [
          {
            id: 'film',
            wish: 'show' as const,
            says: TEXTS.viewPlayedOnce,
            label: TEXTS.video,
            ending: `.${filmEnding(moving)}`,
            icon: 'film',
            name: TEXTS.videoNames,
            tag: TEXTS.sAt30Fps(num(scene.duration, 1)),
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
  if (!o?.x_m && !o?.y_m) return TEXTS.theOriginIsThat;
  return TEXTS.originIsAt(String(o.x_m ?? 0), String(o.y_m ?? 0), o.crs ?? TEXTS.theRecording);
}

/** Several variants in one format: a file for each. A file of records contains all of them. */
export const ofVariants = (kinds: readonly ExportKind[], cards: readonly WholeCard[]): ExportKind[] =>
  kinds.map((kind) => ({
    ...kind,
    make: async ({ client, editor, file }, progress, stop) => {
      const files: ExportedFile[] = [];
      const { name } = editor.scene.peek()!;
      for (const card of cards) {
        if (stop.aborted) return null;
        const alone = { ...card.scene, name: `${name}, ${card.id} ${card.name}`, variants: [], variantStates: {} };
        const json = file.completeOf(alone, card.set);
        if (json) files.push(await exportedJson(client, json, alone, kind.id));
        progress(files.length / cards.length);
      }
      const losses = [...new Map(files.flatMap((f) => f.losses).map((l) => [l.what, l])).values()];
      if (kind.id !== 'womd') return { ...files[0], losses, others: files.slice(1) };
      // Records are concatenated in a file.
      return { blob: new Blob(files.map((f) => f.blob)), name: `${slug(name)}-variants${kind.ending}`, losses };
    },
  }));
