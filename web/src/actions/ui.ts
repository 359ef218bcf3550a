// What of the page is open: the drawer, a dialog, a menu, the hint; and light or dark.
import { signal, type ReadonlySignal } from '@preact/signals-core';
import type { MenuOn } from '../edit/gestures/chart';
import { keep, recall } from '../net/storage';

/** A menu at a place of the picture, in pixels of it. */
export interface ContextMenu {
  readonly x: number;
  readonly y: number;
  readonly on: MenuOn;
}

export type Dialog = 'palette' | 'shortcuts';
export type Theme = 'light' | 'dark';

const systemTheme = (): Theme =>
  typeof matchMedia !== 'undefined' && matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';

export class Ui {
  readonly #drawer = signal(true);
  readonly #dialog = signal<Dialog | null>(null);
  readonly #menu = signal<string | null>(null);
  readonly #contextMenu = signal<ContextMenu | null>(null);
  readonly #emptyHidden = signal<string | null>(null);
  readonly #deleting = signal<string | null>(null);
  readonly #eventsPanel = signal(false);
  readonly #coach = signal<number>(recall<boolean>('coach-done') ? 0 : 1);
  readonly #theme = signal<Theme>(recall<Theme>('theme') ?? systemTheme());

  readonly drawer: ReadonlySignal<boolean> = this.#drawer;
  readonly dialog: ReadonlySignal<Dialog | null> = this.#dialog;
  readonly menu: ReadonlySignal<string | null> = this.#menu;
  readonly contextMenu: ReadonlySignal<ContextMenu | null> = this.#contextMenu;
  /** Id of the empty scene whose offers were closed. */
  readonly emptyHidden: ReadonlySignal<string | null> = this.#emptyHidden;
  /** Id of the scene that is about to be deleted. */
  readonly deleting: ReadonlySignal<string | null> = this.#deleting;
  readonly eventsPanel: ReadonlySignal<boolean> = this.#eventsPanel;
  /** Step of the hint for the first minute; 0 when it is closed. */
  readonly coach: ReadonlySignal<number> = this.#coach;
  readonly theme: ReadonlySignal<Theme> = this.#theme;

  showDrawer(open: boolean): void {
    this.#drawer.value = open;
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

  askToDelete(id: string | null): void {
    this.#deleting.value = id;
  }

  showEvents(open: boolean): void {
    this.#eventsPanel.value = open;
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
