// Layout of the page: panels beside the picture, or a sheet over it; and whether the main pointer is a finger.
import { computed, signal, type ReadonlySignal } from '@preact/signals-core';

/** Heights of the sheet: name and verdict, the picture with what is needed, every field. */
export const SHEET_HEIGHTS = ['peek', 'half', 'full'] as const;
export type SheetHeight = (typeof SHEET_HEIGHTS)[number];

/** From this width on panels are beside the picture; the second value is for fingers, which need more room. */
const WIDE_PX = 1100;
const WIDE_FOR_FINGERS_PX = 1367;
/** A page narrower or lower than this has no room for the rail of tools. */
const SMALL_WIDTH_PX = 640;
const LOW_PX = 520;

/** Height of the nearly closed sheet, pixels; its head has the same. */
export const PEEK_PX = 96;
const HALF_PX = 300;
/** On a lower page the half-open sheet has no room for the curves. */
const ROOMY_PX = 800;
/** On a high page the open sheet shows more. */
const HALF_ROOMY_PX = 412;
/** Largest share of the page's height. */
const HALF_SHARE = 0.55;
const FULL_SHARE = 0.92;
/** A list over the picture needs this many pixels above the sheet. */
const LIST_PX = 420;
/** Largest share of the sheet during a drag in the picture. */
const DRAGGED_SHARE = 0.62;

export class Form {
  readonly #size = signal({ w: 1440, h: 900 });
  readonly #touch = signal(false);
  readonly #height = signal<SheetHeight>('peek');
  /** Did the user pull the sheet down? It stays there until the user pulls it up. */
  #keptDown = false;

  /** Is a finger the main pointer? */
  readonly touch: ReadonlySignal<boolean> = this.#touch;
  /** Are the panels a sheet over the picture? */
  readonly sheet = computed(() => this.#size.value.w < (this.touch.value ? WIDE_FOR_FINGERS_PX : WIDE_PX));
  /** Is there room for little more than the picture? */
  readonly small = computed(() => this.sheet.value && (this.#size.value.w < SMALL_WIDTH_PX || this.low.value));
  /** Is the page so low that the sheet is at its side? */
  readonly low = computed(() => this.sheet.value && this.#size.value.h < LOW_PX);
  readonly height: ReadonlySignal<SheetHeight> = this.#height;

  constructor() {
    if (typeof matchMedia === 'undefined') return;
    const coarse = matchMedia('(pointer: coarse)');
    const measure = () => {
      this.#touch.value = coarse.matches;
      this.#size.value = { w: innerWidth, h: innerHeight };
    };
    coarse.addEventListener('change', measure);
    addEventListener('resize', measure);
    measure();
  }

  /** Height of the sheet on this page, in pixels. */
  pixels(height: SheetHeight): number {
    const { h } = this.#size.value;
    const most = h - 52;
    if (height === 'peek') return PEEK_PX;
    if (height === 'full') return Math.round(Math.min(most, FULL_SHARE * h));
    const half = this.small.value || h < ROOMY_PX ? HALF_PX : HALF_ROOMY_PX;
    return Math.round(this.low.value ? Math.min(most, 0.68 * h) : Math.min(most, half, HALF_SHARE * h));
  }

  /** Would an open sheet leave too little of the picture for a list or a card over it? */
  get crowded(): boolean {
    return this.#size.value.h - this.pixels('half') < LIST_PX;
  }

  /** Largest height during a drag in the picture. */
  get whileDragging(): number {
    return Math.round(DRAGGED_SHARE * this.#size.value.h);
  }

  /** Opens without the user, for its content. */
  open(height: SheetHeight): void {
    this.#height.value = height;
  }

  /** Half open for a newly selected road user, unless the user pulled it down. */
  offer(): void {
    if (!this.#keptDown && this.#height.peek() === 'peek') this.open('half');
  }

  /** Pulled by the user; this height is kept from now on. */
  pull(height: SheetHeight): void {
    this.#keptDown = height === 'peek';
    this.open(height);
  }

  /** One height up or down by the user; from the top back to the bottom. */
  step(by: 1 | -1): void {
    const n = SHEET_HEIGHTS.length;
    this.pull(SHEET_HEIGHTS[(SHEET_HEIGHTS.indexOf(this.#height.peek()) + by + n) % n]);
  }

  /** The height nearest to this many pixels. */
  nearest(px: number): SheetHeight {
    const away = (h: SheetHeight): number => Math.abs(this.pixels(h) - px);
    return [...SHEET_HEIGHTS].sort((a, b) => away(a) - away(b))[0];
  }
}
