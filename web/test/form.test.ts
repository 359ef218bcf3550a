// The sheet of a small page: what opens it, and that a hand which pulled it down is heeded.
import { describe, expect, it } from 'vitest';
import { Form } from '../src/actions/form';

describe('a sheet', () => {
  it('opens for somebody who is selected', () => {
    const form = new Form();
    form.offer();
    expect(form.height.value).toBe('half');
  });

  it('stays as far open as it is for the next one', () => {
    const form = new Form();
    form.pull('full');
    form.offer();
    expect(form.height.value).toBe('full');
  });

  it('stays down once a hand has pulled it down, until a hand pulls it up', () => {
    const form = new Form();
    form.offer();
    form.pull('peek');
    form.offer();
    expect(form.height.value).toBe('peek');
    form.step(1);
    expect(form.height.value).toBe('half');
    form.open('peek');
    form.offer();
    expect(form.height.value).toBe('half');
  });
});
