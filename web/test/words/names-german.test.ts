// Names of futures in German, by the same rules.
import { describe, expect, it, vi } from 'vitest';
import { nameAll, type Nameable, type Naming } from '../../src/model/words/future-names';
import { ANSWERS, aside, drive, modesOf, paced, related } from './named-lists';

vi.mock('../../src/texts/scene/names', async () => ({
  TEXTS: (await import('../../src/texts/german/scene/names')).german,
}));

const who: Naming = { onFoot: false, nameOf: (id) => `Auto ${id}` };
const names = (...modes: Nameable[]): string[] => nameAll(modes, who).map((n) => n.name);

describe('German names', () => {
  it('have the order with another, and whom one waits for', () => {
    const [before, after] = [[related('before', '3')], [related('after', '3')]];
    expect(names(drive(aside(9), before), drive(aside(6), after))).toEqual(['Vor Auto 3', 'Nach Auto 3']);
    expect(names(drive(aside(9), before), drive(aside(9), [], 'left'), drive(aside(6), after))).toEqual([
      'Geradeaus, vor Auto 3',
      'Biegt links ab',
      'Geradeaus, nach Auto 3',
    ]);
    const waits = drive(paced(8, 5, 2, 0, 0, 0, 0, 3, 6, 8), [related('gives_way_to', '3', { time: 7 })]);
    expect(names(drive(aside(8)), waits)).toEqual(['Geradeaus', 'Wartet auf Auto 3']);
  });

  it('have the difference as a number', () => {
    expect(names(drive(aside(9)), drive(aside(9, 2)), drive(aside(7)))).toEqual([
      'Geradeaus',
      'Geradeaus, weiter links',
      'Geradeaus, langsamer',
    ]);
  });

  it.each(Object.keys(ANSWERS))('of %s are short', (list) => {
    for (const name of names(...modesOf(ANSWERS[list]))) expect(name.length).toBeLessThanOrEqual(36);
  });
});
