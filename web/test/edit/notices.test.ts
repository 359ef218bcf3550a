// Notices beside the picture: a refusal is shown and spoken, and leaves a remedy of another notice in place.
import { describe, expect, it } from 'vitest';
import { Notices } from '../../src/edit/session/notices';

describe('a refusal', () => {
  it('is spoken and shown', () => {
    const notices = new Notices();
    notices.refuse('Select a road user first');
    expect(notices.spoken.value.text).toBe('Select a road user first');
    expect(notices.toast.value).toEqual({ text: 'Select a road user first' });
    notices.refuse('Nothing to undo');
    expect(notices.toast.value?.text).toBe('Nothing to undo');
  });

  it('leaves a shown remedy in place', () => {
    const notices = new Notices();
    notices.show({ text: 'Car 2 is gone', undo: true });
    notices.refuse('Nothing to do again');
    expect(notices.spoken.value.text).toBe('Nothing to do again');
    expect(notices.toast.value?.text).toBe('Car 2 is gone');
  });
});
