// What can go out: the server's formats, and what is made here of what is on screen.
import { deg } from '../../model/base/geometry';
import { num, seconds } from '../../model/base/units';
import type { Context } from '../../actions/context';
import { exported, exportedJson, slug, type ExportedFile } from '../../edit/download';
import { eventsTable } from '../../edit/outward/events-table';
import type { Findable } from '../../edit/outward/finding';
import { film, filmEnding, filmKind } from '../../edit/outward/film';
import { movingPicture } from '../../edit/outward/moving-picture';
import { outFormats, type Wish } from '../../edit/outward/formats';
import { reportPage } from '../../edit/outward/report-page';
import type { WholeCard } from '../../edit/variants/cards';
import { paintLegend } from '../../draw/legend';
import { opaquePen, paintOn } from '../../draw/replay';
import { SvgPen } from '../../draw/svg-pen';
import type { FormatInfo } from '../../net/types';
import { TEXTS } from '../../texts/files/export';

export interface Kind extends Findable {
  readonly id: string;
  readonly wish: Wish;
  readonly icon: string;
  /** In place of a loss, for what is to be looked at. */
  readonly tag?: string;
  make(c: Context, progress: (share: number) => void, stop: AbortSignal): Promise<ExportedFile | null>;
}

const FINE = 2;
/** The server's formats, for the scene on screen. */
export const ofServer = (formats: readonly FormatInfo[]): Kind[] =>
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
  paintOn(g, (pen) => paintLegend(pen, stage.view, editor.time.peek()));
  return canvas;
}

/** What is made here: events, pictures and a report of what is on screen. */
export function ofScreen(c: Context): Kind[] {
  const { editor, stage } = c;
  const time = editor.time.peek();
  const scene = editor.scene.peek()!;
  const view = TEXTS.thisViewAtS(num(time, 1));
  const moving = filmKind();
  return [
    {
      id: 'events',
      wish: 'table',
      says: TEXTS.whenWhoMeets,
      label: TEXTS.eventsAsATable,
      ending: '.csv',
      icon: 'warn',
      name: TEXTS.eventsTableNames,
      tag: TEXTS.eventsInIt(editor.events.peek().length),
      make: () => {
        const rows = eventsTable(editor.events.peek());
        return Promise.resolve(named(c, new Blob([rows], { type: 'text/csv' }), 'csv', TEXTS.eventsName));
      },
    },
    {
      id: 'report',
      wish: 'show',
      says: TEXTS.whatHappensIn,
      label: TEXTS.reportPage,
      ending: '.html',
      icon: 'report',
      tag: TEXTS.toReadNotToEdit,
      make: async () => {
        const picture = pictureOf(c).toDataURL('image/png');
        const page = reportPage({
          scene,
          motion: editor.motion.peek(),
          events: editor.events.peek(),
          variant: c.variants.card(c.variants.shown.peek())?.name ?? null,
          unit: editor.speedUnit.peek(),
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
      says: TEXTS.whatYouSeeFor,
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
      says: TEXTS.theSameAsLines,
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
        const about = TEXTS.pxAMetreXEast(num(z, 2)) + turned;
        const drawing = pen.file(w, h, `${scene.name}, ${seconds(time)}`, about);
        return named(c, new Blob([drawing], { type: 'image/svg+xml' }), 'svg');
      },
    },
    {
      id: 'gif',
      wish: 'show',
      says: TEXTS.whatYouSeeAgain,
      label: TEXTS.movingImage,
      ending: '.gif',
      icon: 'film',
      // Where no film can be made it is what comes nearest to one.
      name: moving ? TEXTS.movingImageNames : `${TEXTS.movingImageNames}, ${TEXTS.filmNames}`,
      tag: TEXTS.s10ASecond(num(scene.duration, 1)),
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
            says: TEXTS.whatYouSeePlayed,
            label: TEXTS.film,
            ending: `.${filmEnding(moving)}`,
            icon: 'film',
            name: TEXTS.filmNames,
            tag: TEXTS.s30ASecond(num(scene.duration, 1)),
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
  return TEXTS.theOriginLies(String(o.x_m ?? 0), String(o.y_m ?? 0), o.crs ?? TEXTS.theRecording);
}

/** Several variants in one format: a file each. A file of records has room for all of them. */
export const ofVariants = (kinds: readonly Kind[], cards: readonly WholeCard[]): Kind[] =>
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
      // Records follow each other in a file.
      return { blob: new Blob(files.map((f) => f.blob)), name: `${slug(name)}-variants${kind.ending}`, losses };
    },
  }));
