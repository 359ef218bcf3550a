// What a new map can start from: eight small maps, drawn as they are.
import { useEffect, useRef } from 'preact/hooks';
import { readScene } from '../../model/document/scene-reader';
import { TEMPLATES, TEMPLATE_TITLES } from '../../model/document/layouts';
import { MapPicture } from '../../draw/paint-map';
import { paintOn } from '../../draw/replay';
import { View } from '../../draw/view';
import type { LayoutMaker } from '../../edit/layout-maker';
import type { TemplateName } from '../../net/types';
import { useApp } from '../parts/app-context';
import { useLiveEffect } from '../parts/hooks';
import { Icon } from '../parts/icons';
import '../../styles/layouts.css';
import { TEXTS } from '../../texts/panels/layouts';

const SIZE = { width: 112, height: 88 };
const PX_PER_PX = 2;
/** A junction is shown as large as its middle, metres from its centre. */
const SHOWN_M = 48;

const pictures = new Map<TemplateName, Promise<MapPicture>>();
const boxes = new Map<TemplateName, { x0: number; y0: number; x1: number; y1: number }>();

function pictureOf(maker: LayoutMaker, template: TemplateName): Promise<MapPicture> {
  const known = pictures.get(template);
  if (known) return known;
  const loading = maker.preview(template).then((json) => {
    const { map } = readScene(json);
    const { x0, y0, x1, y1 } = map.box;
    const near = (v: number): number => Math.min(SHOWN_M, Math.max(-SHOWN_M, v));
    const long = x1 - x0 > 4 * (y1 - y0);
    boxes.set(
      template,
      long ? { x0: -SHOWN_M * 2, y0, x1: SHOWN_M * 2, y1 } : { x0: near(x0), y0: near(y0), x1: near(x1), y1: near(y1) },
    );
    return new MapPicture(map, false);
  });
  loading.catch(() => pictures.delete(template));
  pictures.set(template, loading);
  return loading;
}

function Small({ template }: { template: TemplateName }) {
  const { maker, ui } = useApp();
  const canvas = useRef<HTMLCanvasElement>(null);
  const draw = () =>
    void pictureOf(maker, template)
      .then((map) => {
        if (!canvas.current) return;
        const v = new View();
        Object.assign(v, { w: SIZE.width, h: SIZE.height, dpr: PX_PER_PX });
        v.fit(boxes.get(template)!, 4, 0.3);
        paintOn(canvas.current.getContext('2d')!, (pen) => map.paint(pen, v, false));
      })
      .catch(() => undefined);
  useEffect(draw, []);
  useLiveEffect(() => {
    void ui.theme.value;
    draw();
  });
  return <canvas ref={canvas} width={SIZE.width * PX_PER_PX} height={SIZE.height * PX_PER_PX} aria-hidden="true" />;
}

export default function Templates() {
  const { editor, maker } = useApp();
  const { layouts } = editor;
  const now = layouts.wish.value?.template;
  return (
    <section class="card templates" aria-label={TEXTS.startFrom}>
      <h2>
        {TEXTS.startFrom}
        <button type="button" class="btn i" aria-label={TEXTS.close} onClick={() => maker.leave()}>
          <Icon name="x" size={16} />
        </button>
      </h2>
      <div class="all">
        {TEMPLATES.map((t) => (
          <button
            key={t}
            type="button"
            data-template={t}
            aria-pressed={t === now}
            class={t === now ? 'on' : ''}
            onClick={() => maker.choose(t)}
          >
            <Small template={t} />
            <b>{TEMPLATE_TITLES[t]}</b>
          </button>
        ))}
      </div>
    </section>
  );
}
