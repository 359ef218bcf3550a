// The playhead. Runs on the stage's frames; with reduced motion only on request.
import { effect } from '@preact/signals-core';
import type { Editor } from './editor';
import type { Stage } from '../../draw/stage';

export class Playback {
  private last = 0;
  private until: number | null = null;

  constructor(
    private readonly editor: Editor,
    private readonly stage: Stage,
  ) {
    effect(() => {
      if (editor.playhead.playing.value) {
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
    if (!editor.playhead.playing.peek() && editor.playhead.time.peek() >= scene.duration - 0.01)
      editor.playhead.moveTo(0);
    if (editor.playhead.playing.peek()) editor.playhead.pause();
    else editor.playhead.play();
  }

  /** Shows the first seconds once, then returns to the start. */
  introduce(seconds: number): void {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    this.until = seconds;
    this.editor.playhead.play();
  }

  /** Called every frame; moves the playhead by the time that passed. */
  frame(now: number): void {
    const { editor } = this;
    const scene = editor.scene.peek();
    if (!editor.playhead.playing.peek() || !scene) return;
    // What is live has its own time.
    if (editor.reading.live.isOn.peek()) return editor.playhead.pause();
    const dt = this.last ? Math.min(0.1, (now - this.last) / 1000) : 0;
    this.last = now;
    let t = editor.playhead.time.peek() + dt * editor.playhead.rate.peek();
    if (this.until !== null && t >= this.until) {
      this.until = null;
      editor.playhead.rewind();
      return;
    }
    if (t >= scene.duration) {
      if (editor.playhead.loop.peek()) t %= scene.duration;
      else {
        t = scene.duration;
        editor.playhead.pause();
      }
    }
    editor.playhead.moveTo(t);
    if (editor.playhead.playing.peek()) this.stage.invalidate('agents');
  }
}
