// What an action may touch.
import { signal } from '@preact/signals-core';
import type { Editor } from '../edit/editor';
import type { Library } from '../edit/library';
import type { Asking } from '../edit/asking';
import type { Playback } from '../edit/playback';
import type { Gestures } from '../edit/gestures';
import type { Stage } from '../draw/stage';
import type { Client } from '../net/client';
import { keep, recall } from '../net/storage';

export type Dialog = 'palette' | 'shortcuts' | null;
export type Theme = 'light' | 'dark';

export class Ui {
  readonly drawer = signal(true);
  readonly dialog = signal<Dialog>(null);
  readonly menu = signal<string | null>(null);
  /** Id of the scene that is about to be deleted. */
  readonly deleting = signal<string | null>(null);
  readonly eventsPanel = signal(false);
  readonly coach = signal<number>(recall<boolean>('coach-done') ? 0 : 1);
  readonly theme = signal<Theme>(
    recall<Theme>('theme') ??
      (typeof matchMedia !== 'undefined' && matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'),
  );

  setTheme(t: Theme): void {
    this.theme.value = t;
    keep('theme', t);
  }

  endCoach(): void {
    this.coach.value = 0;
    keep('coach-done', true);
  }
}

export interface Context {
  editor: Editor;
  library: Library;
  asking: Asking;
  playback: Playback;
  gestures: Gestures;
  stage: Stage;
  client: Client;
  ui: Ui;
  chooseFiles(): void;
  focusField(part: 'start' | 'goal', field: string): void;
  focusGroup(step: 1 | -1): void;
  focusAgent(id: string): void;
  fit(): void;
}
