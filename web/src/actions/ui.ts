// Open parts of the page: drawer, dialog, menu, hint; and the theme.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { MenuOn } from '../edit/gestures/chart';
import { keep, recall } from '../net/storage';

export type Dialog = 'palette' | 'shortcuts' | 'save-as' | 'share' | 'export' | 'import';
/** Panels at the left edge of the picture. */
export type Drawer = 'scenes' | 'history' | 'users';
/** A menu at a place of the picture, in its pixels. */
export interface ContextMenu {
  readonly x: number;
  readonly y: number;
  readonly on: MenuOn;
  /** The future of the menu. */
  readonly future?: number | null;
}

export type Theme = 'light' | 'dark';

const systemTheme = (): Theme =>
  typeof matchMedia !== 'undefined' && matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';

export class Ui {
  readonly #drawer = signal<Drawer | null>('scenes');
  readonly #dialog = signal<Dialog | null>(null);
  readonly #menu = signal<string | null>(null);
  readonly #aimed = signal<string | null>(null);
  readonly #renaming = signal<string | null>(null);
  readonly #contextMenu = signal<ContextMenu | null>(null);
  readonly #emptyHidden = signal<string | null>(null);
  readonly #eventsPanel = signal<boolean | 'counts'>(false);
  readonly #tall = signal(false);
  readonly #allFields = signal(recall<boolean>('all-fields') ?? false);
  readonly #coach = signal<number>(recall<boolean>('coach-done') ? 0 : 1);
  readonly #theme = signal<Theme>(recall<Theme>('theme') ?? systemTheme());

  readonly drawer: ReadonlySignal<Drawer | null> = this.#drawer;
  readonly dialog: ReadonlySignal<Dialog | null> = this.#dialog;
  readonly menu: ReadonlySignal<string | null> = this.#menu;
  /** Id of the scene in the list that actions apply to; without one, the open scene. */
  readonly aimed: ReadonlySignal<string | null> = this.#aimed;
  /** Id of the scene being renamed in the list. */
  readonly renaming: ReadonlySignal<string | null> = this.#renaming;
  readonly contextMenu: ReadonlySignal<ContextMenu | null> = this.#contextMenu;
  /** Id of the empty scene whose suggestions were closed. */
  readonly emptyHidden: ReadonlySignal<string | null> = this.#emptyHidden;
  readonly eventsPanel: ReadonlySignal<boolean | 'counts'> = this.#eventsPanel;
  /** Is the timeline enlarged for the speed curve? */
  readonly tall: ReadonlySignal<boolean> = this.#tall;
  /** Are the rarely typed fields of a road user shown? */
  readonly allFields: ReadonlySignal<boolean> = this.#allFields;
  /** Step of the first-minute hint; 0 when it is closed. */
  readonly coach: ReadonlySignal<number> = this.#coach;
  readonly theme: ReadonlySignal<Theme> = this.#theme;

  showDrawer(drawer: Drawer | null): void {
    this.#drawer.value = drawer;
    this.#aimed.value = this.#renaming.value = null;
  }

  toggleDrawer(drawer: Drawer): void {
    this.showDrawer(this.#drawer.peek() === drawer ? null : drawer);
  }

  openDialog(dialog: Dialog): void {
    this.#dialog.value = dialog;
  }

  closeDialog(): void {
    this.#dialog.value = null;
  }

  openMenu(name: string): void {
    this.#menu.value = name;
  }

  closeMenu(): void {
    this.#menu.value = null;
  }

  /** Actions on scenes apply to this one from now on. */
  aimAt(id: string | null): void {
    this.#aimed.value = id;
  }

  renameScene(id: string | null): void {
    this.#renaming.value = id;
  }

  openContextMenu(menu: ContextMenu): void {
    this.#menu.value = null;
    this.#contextMenu.value = menu;
  }

  closeContextMenu(): void {
    this.#contextMenu.value = null;
  }

  hideEmpty(scene: string): void {
    this.#emptyHidden.value = scene;
  }

  /** `counts`: also without events, to show the thresholds. */
  showEvents(open: boolean | 'counts'): void {
    this.#eventsPanel.value = open;
  }

  toggleTall(): void {
    this.#tall.value = !this.#tall.peek();
  }

  showAllFields(on: boolean): void {
    this.#allFields.value = on;
    keep('all-fields', on);
  }

  coachTo(step: number): void {
    this.#coach.value = step;
  }

  endCoach(): void {
    this.#coach.value = 0;
    keep('coach-done', true);
  }

  setTheme(t: Theme): void {
    this.#theme.value = t;
    keep('theme', t);
  }
}
