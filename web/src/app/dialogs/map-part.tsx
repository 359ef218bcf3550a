// The part of a map to import: a circle, drawn on a small picture of the map or typed.
import { useEffect, useRef } from 'preact/hooks';
import { useComputed, useSignal } from '@preact/signals';
import type { FileVerdict } from '../../edit/tools/importing/file-verdict';
import { outlineOf, type MapOutline } from '../../edit/tools/importing/map-outline';
import { clamp, type Box } from '../../model/base/geometry';
import { lengthUnit, fromLength, toLength } from '../../model/base/units';
import { extentOf, RADIUS_M, type MapCircle } from '../../net/imports';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/files/imports';

/** Metres of a degree of latitude. */
const DEGREE_M = 111_320;
/** Share of the map's smaller side that the first circle has as its radius, and most, metres. */
const FIRST = { share: 0.1, most_m: 500 };
/** Margin of the picture, as a share of the map. */
const MARGIN = 0.04;
/** Decimals of a coordinate. */
const DECIMALS = { degrees: 6, metres: 1 };

/** The plane of the picture, in metres to the right and down from a corner of the map. */
class Plane {
  readonly width: number;
  readonly height: number;
  readonly #east: number;
  readonly #north: number;

  constructor(private readonly of: MapOutline) {
    const { x0, x1, y0, y1 } = of.box;
    this.#north = of.degrees ? DEGREE_M : 1;
    this.#east = this.#north * (of.degrees ? Math.cos(((y0 + y1) / 2) * (Math.PI / 180)) : 1);
    this.width = Math.max(1, (x1 - x0) * this.#east);
    this.height = Math.max(1, (y1 - y0) * this.#north);
  }

  to = (x: number, y: number): readonly [number, number] => [
    (x - this.of.box.x0) * this.#east,
    (this.of.box.y1 - y) * this.#north,
  ];

  from = (right: number, down: number): readonly [number, number] => [
    this.of.box.x0 + right / this.#east,
    this.of.box.y1 - down / this.#north,
  ];
}

/** Only the extent is known: its outline is the picture. */
const ofBox = (box: Box): MapOutline => {
  const { x0, x1, y0, y1 } = box;
  const corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]] as const; // prettier-ignore
  const degrees = Math.abs(x0) <= 180 && Math.abs(x1) <= 180 && Math.max(x1 - x0, y1 - y0) < 2;
  return { box, degrees, lines: corners.slice(1).map((b, i) => [corners[i], b] as const) };
};

export default function MapPart({ verdict, map }: { verdict: FileVerdict; map: NonNullable<FileVerdict['map']> }) {
  const { client, importing } = useApp();
  const outline = useSignal<MapOutline | 'coming' | null>('coming');
  const circle = useSignal<MapCircle | null>(map.around);
  const busy = useSignal(false);
  const off = useComputed(() => circle.value === null || busy.value).value;
  useEffect(() => {
    let wanted = true;
    const show = (found: MapOutline | null): void => {
      if (!wanted) return;
      outline.value = found;
      if (found) circle.value ??= firstCircle(found);
    };
    void outlineOf(map.file)
      .then(async (found) => found ?? (await extentOf(client, verdict.file, map.file).then((b) => b && ofBox(b))))
      .then(show, () => show(null));
    return () => void (wanted = false);
  }, []);
  const found = outline.value;
  return (
    <form
      class="mappart"
      aria-label={TEXTS.partOfMap}
      aria-busy={found === 'coming' || busy.value}
      onSubmit={(e) => {
        e.preventDefault();
        if (off) return;
        busy.value = true;
        void importing.reader?.readPart(verdict, circle.value!).finally(() => (busy.value = false));
      }}
    >
      {found === 'coming' ? (
        <p class="mut">{TEXTS.readingMap}</p>
      ) : found ? (
        <Picture of={found} circle={circle.value} draw={(c) => (circle.value = c)} />
      ) : (
        <p class="mut">{TEXTS.noPicture}</p>
      )}
      {found === 'coming' ? null : <Fields circle={circle} degrees={found?.degrees ?? false} />}
      <div class="ways">
        <button type="submit" class={`btn pri ${off ? 'off' : ''}`} aria-disabled={off}>
          {TEXTS.importPart}
        </button>
      </div>
    </form>
  );
}

function firstCircle(of: MapOutline): MapCircle {
  const { x0, x1, y0, y1 } = of.box;
  const { width, height } = new Plane(of);
  const radius = clamp(Math.round(Math.min(FIRST.most_m, FIRST.share * Math.min(width, height))), ...RADIUS_M);
  return rounded({ x: (x0 + x1) / 2, y: (y0 + y1) / 2, radius }, of.degrees);
}

const rounded = ({ x, y, radius }: MapCircle, degrees: boolean): MapCircle => {
  const places = degrees ? DECIMALS.degrees : DECIMALS.metres;
  const [rx, ry] = [x, y].map((v) => Number(v.toFixed(places)));
  return { x: rx, y: ry, radius: Math.round(clamp(radius, ...RADIUS_M)) };
};

interface PictureProps {
  readonly of: MapOutline;
  readonly circle: MapCircle | null;
  draw(circle: MapCircle): void;
}

function Picture({ of, circle, draw }: PictureProps) {
  const svg = useRef<SVGSVGElement>(null);
  const plane = new Plane(of);
  const { width, height } = plane;
  const margin = MARGIN * Math.max(width, height);
  const path = useComputed(() => of.lines.map((l) => `M${l.map((p) => fixed(plane.to(...p))).join('L')}`).join(''));
  const place = (e: PointerEvent): readonly [number, number] => {
    const { x, y } = new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.current!.getScreenCTM()!.inverse());
    return [clamp(x, 0, width), clamp(y, 0, height)];
  };
  const centre = useRef<readonly [number, number] | null>(null);
  const at = circle && plane.to(circle.x, circle.y);
  return (
    <>
      <svg
        ref={svg}
        role="img"
        aria-label={TEXTS.dragACircle}
        viewBox={`${-margin} ${-margin} ${width + 2 * margin} ${height + 2 * margin}`}
        onPointerDown={(e) => {
          svg.current!.setPointerCapture(e.pointerId);
          centre.current = place(e);
          const [x, y] = plane.from(...centre.current);
          draw(rounded({ x, y, radius: circle?.radius ?? RADIUS_M[0] }, of.degrees));
        }}
        onPointerMove={(e) => {
          if (!centre.current) return;
          const [[cx, cy], [px, py]] = [centre.current, place(e)];
          const [x, y] = plane.from(cx, cy);
          const radius = Math.hypot(px - cx, py - cy);
          // A press without movement keeps the radius.
          if (radius >= RADIUS_M[0]) draw(rounded({ x, y, radius }, of.degrees));
        }}
        onPointerUp={() => (centre.current = null)}
        onPointerCancel={() => (centre.current = null)}
      >
        <path d={path} />
        {at ? <circle cx={at[0]} cy={at[1]} r={circle!.radius} /> : null}
      </svg>
      <p class="mut">{TEXTS.dragACircle}</p>
    </>
  );
}

const fixed = ([x, y]: readonly [number, number]): string => `${x.toFixed(1)} ${y.toFixed(1)}`;

interface CircleFieldsProps {
  readonly circle: { value: MapCircle | null };
  readonly degrees: boolean;
}

function Fields({ circle, degrees }: CircleFieldsProps) {
  const typed = useRef<Partial<MapCircle>>({});
  const put = (patch: Partial<MapCircle>): void => {
    const all = { ...circle.value, ...typed.current, ...patch };
    typed.current = all;
    const { x, y, radius } = all;
    const whole = [x, y, radius].every((v) => v !== undefined && Number.isFinite(v));
    circle.value = whole ? { x: x!, y: y!, radius: clamp(radius!, ...RADIUS_M) } : null;
  };
  const shown = circle.value ?? typed.current;
  const fields = [
    ['x', degrees ? TEXTS.longitude : TEXTS.centreX, degrees ? '°' : 'm', (v: number) => v],
    ['y', degrees ? TEXTS.latitude : TEXTS.centreY, degrees ? '°' : 'm', (v: number) => v],
    ['radius', TEXTS.radius, lengthUnit(), toLength],
  ] as const;
  return (
    <div class="circle">
      {fields.map(([name, label, unit, told]) => (
        <label key={name}>
          {label}
          <span class="field">
            <input
              type="text"
              inputmode="decimal"
              name={name}
              value={shown[name] === undefined ? '' : String(Number(told(shown[name]).toFixed(DECIMALS.degrees)))}
              onChange={(e) => {
                const v = Number.parseFloat(e.currentTarget.value.replace(',', '.').replace('−', '-'));
                put({ [name]: name === 'radius' ? fromLength(v) : v });
              }}
            />
            <span class="u">{unit}</span>
          </span>
        </label>
      ))}
    </div>
  );
}
