// The sheet of a small page: what opens it, and that a sheet pulled down stays down.
import { describe, expect, it } from 'vitest';
import { Form } from '../../src/actions/form';

describe('a sheet', () => {
  it('opens for a selected road user', () => {
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

  it('stays down once pulled down, until it is pulled up', () => {
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
