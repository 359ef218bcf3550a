import { expect, it } from 'vitest';
import { Emitter } from '../../src/model/base/emitter';

it('calls all listeners in their order, until each is disposed', () => {
  const heard: string[] = [];
  const { emit, end } = listening(heard);
  emit(1);
  end[0]();
  end[0]();
  emit(2);
  expect(heard).toEqual(['a1', 'b1', 'b2']);
});

it('registers one function twice as two listeners', () => {
  let calls = 0;
  const hear = (): void => void calls++;
  const e = new Emitter();
  const end = e.listen(hear);
  e.listen(hear);
  end();
  e.emit();
  expect(calls).toBe(1);
});

it('lets a listener add and remove others during an event', () => {
  const heard: string[] = [];
  const e = new Emitter<[n: number]>();
  e.listen((n) => {
    if (n > 1) return;
    endOther();
    e.listen((m) => heard.push(`added${m}`));
  });
  const endOther = e.listen((n) => heard.push(`removed${n}`));
  e.emit(1);
  e.emit(2);
  expect(heard).toEqual(['added2']);
});

function listening(heard: string[]): { emit: (n: number) => void; end: (() => void)[] } {
  const e = new Emitter<[n: number]>();
  const end = ['a', 'b'].map((name) => e.listen((n) => heard.push(`${name}${n}`)));
  return { emit: (n) => e.emit(n), end };
}
