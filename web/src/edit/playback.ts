// The playhead. Runs on the stage's frames; with reduced motion it only runs when asked.
import { effect } from '@preact/signals-core';
import type { Editor } from './editor';
import type { Stage } from '../draw/stage';

export const RATES = [0.1, 0.25, 0.5, 1, 2, 4, 8] as const;

export class Playback {
  private last = 0;
  private until: number | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly stage: Stage,
  ) {
    effect(() => {
      if (editor.playing.value) {
        this.last = 0;
        stage.invalidate('agents');
      }
    });
  }

  toggle(): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!scene) return;
    this.until = null;
    if (!editor.playing.peek() && editor.time.peek() >= scene.duration - 0.01) editor.time.value = 0;
    editor.playing.value = !editor.playing.peek();
  }

  /** Shows the first seconds once, then returns to the start. */
  introduce(seconds: number): void {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    this.until = seconds;
    this.editor.playing.value = true;
  }

  /** Called every frame; moves the playhead by the time that passed. */
  frame(now: number): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!editor.playing.peek() || !scene) return;
    const dt = this.last ? Math.min(0.1, (now - this.last) / 1000) : 0;
    this.last = now;
    let t = editor.time.peek() + dt * editor.rate.peek();
    if (this.until !== null && t >= this.until) {
      this.until = null;
      editor.playing.value = false;
      editor.time.value = 0;
      return;
    }
    if (t >= scene.duration) {
      if (editor.loop.peek()) t %= scene.duration;
      else {
        t = scene.duration;
        editor.playing.value = false;
      }
    }
    editor.time.value = t;
    if (editor.playing.peek()) this.stage.invalidate('agents');
  }
}
