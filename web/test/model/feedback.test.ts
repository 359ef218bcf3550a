// Feedback on futures in rounds: every step can be undone, a file stores all, words give the evidence.
import { describe, expect, it } from 'vitest';
import {
  answerTo,
  docOf,
  hasNews,
  presentRound,
  readFeedback,
  type RoundInputs,
  type Verdict,
} from '../../src/model/document/feedback';
import { feedbackTable } from '../../src/model/words/feedback-table';
import { againstWords, reasons, restsOn, wishWords } from '../../src/model/words/feedback-words';
import { patchScene, takeDealt, type Command } from '../../src/model/document/commands';
import { applyDiff, diffOf } from '../../src/model/document/scene-diff';
import type { FeaturesJson, LearnedWishJson, SceneJson } from '../../src/model/document/scene-json';
import { readScene } from '../../src/model/document/scene-reader';
import { printOf, sceneKey, type Scene } from '../../src/model/document/scene';
import {
  addWish,
  everybody,
  forget,
  judge,
  nextRound,
  oneSubject,
  type Judged,
  type Subject,
} from '../../src/model/document/feedback-commands';
import { writeScene } from '../../src/model/document/scene-writer';
import { car, crossing, crossingJson } from '../helpers';

const like = (harsh: number, more: Partial<FeaturesJson> = {}): FeaturesJson => ({
  pace_mps: 6,
  gap_s: 2.4,
  harshness_mps2: harsh,
  standing_s: 0,
  ...more,
});

/** The n-th card of a round. */
const card = (id: string, n: number, features = like(n)): Judged => ({
  card: { features, places: { [id]: [0, 1, 2].map((t) => [t * 5, n * 2]) } },
  letter: 'ABCDEF'[n],
  name: `Way ${n}`,
});

const asked = (s: Scene): RoundInputs => presentRound(car(s).feedback, printOf(s));
const say = (s: Scene, n: number, verdict: Verdict | null): Scene =>
  judge(oneSubject(car(s)), asked(s), card(car(s).id, n), verdict).apply(s);
const step = (s: Scene, make: (a: Subject, r: RoundInputs) => Command): Scene =>
  make(oneSubject(car(s)), asked(s)).apply(s);
const verdicts = (s: Scene) => car(s).feedback?.answers.map((a) => `${a.round}${a.letter} ${a.verdict}`) ?? [];

describe('feedback on futures', () => {
  it('changes no motion', () => {
    const s = crossing();
    const said = step(say(s, 1, 'keep'), nextRound);
    expect(sceneKey(said)).toBe(sceneKey(s));
    expect(printOf(said)).toBe(printOf(s));
    expect(printOf(patchScene('', { seed: 77 }).apply(s))).not.toBe(printOf(s));
    expect(printOf({ ...s, id: 'saved-under-another' })).toBe(printOf(s));
  });

  it('has an inverse for every command', () => {
    let s = crossing();
    const wish = { trait: 'pace', wants: 'less' } as const;
    const all: ((a: Subject, r: RoundInputs) => Command)[] = [
      (a, r) => judge(a, r, card(a.id!, 0), 'keep'),
      (a, r) => judge(a, r, card(a.id!, 1), 'reject', { trait: 'harshness', wants: 'less' }),
      (a, r) => addWish(a, r, wish, 'Slower'),
      nextRound,
      (a, r) => judge(a, r, card(a.id!, 0), 'reject'),
      (a, r) => judge(a, r, card(a.id!, 0), null),
      (a, r) => forget(a, r, [wish], 'Slower'),
      nextRound,
    ];
    for (const make of all) {
      const command = make(oneSubject(car(s)), asked(s));
      const next = command.apply(s);
      const back = command.invert(s).apply(next);
      expect(car(back).feedback, command.name).toEqual(car(s).feedback);
      // The history stores plain differences, which a browser can store.
      const diff = JSON.parse(JSON.stringify(diffOf(s, next))) as ReturnType<typeof diffOf>;
      expect(car(applyDiff(s, diff, 'forth')).feedback).toEqual(car(next).feedback);
      expect(car(applyDiff(next, diff, 'back')).feedback ?? null).toEqual(car(s).feedback);
      s = next;
    }
    expect(verdicts(s)).toEqual(['1A keep', '1B reject']);
    expect(asked(s)).toMatchObject({ round: 3, wishes: [], forgotten: [{ trait: 'pace' }] });
  });

  it('counts from the next round on; the cards of this one stay', () => {
    const start = crossing();
    const first = asked(start);
    expect(docOf(car(start).feedback, first)).toEqual({ answers: [], wishes: [], forgotten: [] });
    expect(hasNews(car(start).feedback, first)).toBe(false);
    let s = say(start, 0, 'keep');
    s = step(s, (a, r) => addWish(a, r, { trait: 'gap', wants: 'more' }, 'Wider gap'));
    expect(docOf(car(s).feedback, asked(s))).toEqual(docOf(null, first));
    expect(hasNews(car(s).feedback, asked(s))).toBe(true);
    s = step(s, nextRound);
    expect(docOf(car(s).feedback, asked(s))).toMatchObject({
      answers: [{ verdict: 'keep', features: like(0) }],
      wishes: [{ trait: 'gap', wants: 'more' }],
    });
    expect(hasNews(car(s).feedback, asked(s))).toBe(false);
  });

  it('belongs to its card, also where that is drawn again with a small offset', () => {
    const s = say(crossing(), 2, 'reject');
    const f = car(s).feedback;
    const again = card(car(s).id, 2);
    const moved = again.card.places[car(s).id].map(([x, y]) => [x + 0.05, y - 0.05]);
    expect(answerTo(f, asked(s), { places: { [car(s).id]: moved } })?.verdict).toBe('reject');
    expect(answerTo(f, asked(s), card(car(s).id, 3).card)).toBeNull();
    expect(verdicts(say(s, 2, null))).toEqual([]);
    expect(verdicts(say(s, 2, 'keep'))).toEqual(['1C keep']);
  });

  it('continues with another round for another document', () => {
    let s = say(crossing(), 0, 'keep');
    s = patchScene('', { seed: 5 }).apply(s);
    expect(asked(s).round).toBe(2);
    expect(docOf(car(s).feedback, asked(s)).answers).toHaveLength(1);
    expect(verdicts(say(s, 1, 'reject'))).toEqual(['1A keep', '2B reject']);
  });

  it('keeps one preference for each trait', () => {
    let s = crossing();
    s = step(s, (a, r) => addWish(a, r, { trait: 'pace', wants: 'more' }, ''));
    s = step(s, (a, r) => addWish(a, r, { trait: 'pace', wants: 'less' }, ''));
    expect(car(s).feedback!.wishes).toEqual([{ trait: 'pace', wants: 'less' }]);
    s = step(s, (a, r) => forget(a, r, [{ trait: 'pace' }], ''));
    expect(car(s).feedback).toMatchObject({ wishes: [], forgotten: [{ trait: 'pace' }] });
    s = step(s, (a, r) => addWish(a, r, { trait: 'pace', wants: 'more' }, ''));
    expect(car(s).feedback!.forgotten).toEqual([]);
  });

  it('is read back from a file, with the round of a picked card', () => {
    const raw = crossingJson();
    let s = say(say(readScene(raw), 0, 'keep'), 1, 'reject');
    s = step(s, nextRound);
    s = takeDealt(car(s), 1, '0123456789abcdef', 'B').apply(s);
    const back = readScene(JSON.parse(JSON.stringify(writeScene(raw, s, null))) as SceneJson);
    expect(car(back).feedback).toEqual(car(s).feedback);
    expect(sceneKey(back)).toBe(sceneKey(s));
  });

  it('distinguishes a card from the usual future of the same letter', () => {
    const s = crossing();
    const key = (dealt: string) => sceneKey(takeDealt(car(s), 1, dealt, 'B').apply(s));
    expect(key('one')).not.toBe(key('two'));
  });

  it.each([
    ['nothing', null],
    ['a list', []],
    ['text', 'x'],
    ['lists that are none', { answers: 7, wishes: {}, forgotten: 'x', asked: 3 }],
    ['answers that are none', { answers: [null, 1, {}, { verdict: 'keep' }, { verdict: 'maybe' }] }],
    ['wishes that are none', { wishes: [{ trait: 'pace' }, { trait: 'first', wants: 'more' }, { wants: 'more' }] }],
    ['a round that is none', { asked: { round: 0, key: 'k' } }],
  ])('is read with care: %s', (_, v) => expect(readFeedback(v)).toBeNull());

  it('is bounded', () => {
    const { answers } = car(say(crossing(), 0, 'keep')).feedback!;
    const many = readFeedback({ answers: Array.from({ length: 900 }, () => answers[0]) });
    expect(many!.answers).toHaveLength(200);
    const far = { ...answers[0], places: { 1: Array.from({ length: 900 }, () => [0, 0]) } };
    expect(readFeedback({ answers: [far] })).toBeNull();
  });
});

describe('words of rounds', () => {
  const nameOf = (id: string) => (id === '7' ? 'Car 7' : id === '12' ? 'Car 12' : null);
  const speaking = { nameOf, unit: 'km/h' as const };
  const learned = (w: Partial<LearnedWishJson> & Pick<LearnedWishJson, 'trait'>) =>
    ({ wants: 'more', strength: 0.5, said: false, against: [], ...w }) as LearnedWishJson;

  it('name the preference', () => {
    expect(wishWords({ trait: 'harshness', wants: 'less' }, nameOf)).toBe('Smoother');
    expect(wishWords({ trait: 'first', who: '7', with: '12', wants: 'less' }, nameOf)).toBe('Car 12 first');
    expect(wishWords({ trait: 'first', who: '7', with: '12', wants: 'more' }, nameOf)).toBe('Car 7 first');
    expect(wishWords({ trait: 'gap', wants: 'more' }, nameOf, [2.04, 4])).toBe('Keeps a 2 s gap');
    expect(wishWords({ trait: 'gap', wants: 'more' }, nameOf, [2.46, 4])).toBe('Keeps a 2.4 s gap');
    expect(wishWords({ trait: 'gap', wants: 'more' }, nameOf, [0.3, 4])).toBe('Wider gap');
    expect(wishWords({ trait: 'does', who: '7', manoeuvre: 'left', wants: 'less' }, nameOf)).toBe('Not: turns left');
  });

  it('give its evidence', () => {
    const smooth = learned({ trait: 'harshness', wants: 'less', kept: [1, 2.1], rejected: [2.8, 3.6] });
    expect(restsOn(smooth, [], speaking)).toBe('Highest acceleration: kept 2.1, rejected 3.6 m/s².');
    const gap = learned({ trait: 'gap', kept: [2.4, 5], rejected: [0.9, 1.8] });
    expect(restsOn(gap, [], speaking)).toBe('Smallest gap: kept 2.4, rejected 0.9 s.');
    const said = learned({ trait: 'pace', said: true, kept: null, rejected: [5, 10] });
    expect(restsOn(said, [], speaking)).toBe('Set by you. Mean speed: rejected 18 to 36 km/h.');
    expect(restsOn(learned({ trait: 'standing', said: true }), [], speaking)).toBe('Set by you.');
    let s = crossing();
    const { id } = car(s);
    const goes = (first: boolean, n: number, verdict: Verdict) =>
      judge(oneSubject(car(s)), asked(s), card(id, n, like(1, { first: { [id]: { 12: first } } })), verdict).apply(s);
    s = goes(false, 0, 'keep');
    s = goes(true, 1, 'keep');
    s = goes(true, 2, 'reject');
    const order = learned({ trait: 'first', who: id, with: '12', wants: 'less' } as never);
    const { answers } = car(s).feedback!;
    expect(restsOn(order, answers, speaking)).toBe('Applies to 1 of 2 kept and 0 of 1 rejected.');
    expect(againstWords(answers[1])).toBe('B of round 1, “Way 1”, was kept.');
  });

  it('offer reasons for and against a card', () => {
    const words = (f: FeaturesJson, v: Verdict) => reasons('7', f, v, nameOf).map((r) => r.words);
    const first = (yes: boolean) => like(1, { first: { 7: { 12: yes } } });
    expect(words(first(true), 'reject')).toContain('should go after Car 12');
    expect(words(first(false), 'reject')).toContain('should go before Car 12');
    expect(words(first(false), 'keep')).toContain('yields to Car 12');
    expect(words(like(1), 'reject')).not.toContain('too unlike the recording');
    expect(words(like(1, { from_log_m: 3 }), 'reject')).toContain('too unlike the recording');
    const [wish] = reasons('7', first(true), 'reject', nameOf).slice(-1);
    expect(wish.wish).toEqual({ trait: 'first', who: '7', with: '12', wants: 'less' });
    const liked = reasons('7', first(true), 'keep', nameOf).at(-1)!;
    expect(liked.wish).toMatchObject({ wants: 'more' });
  });

  it('make a table that no spreadsheet reads as formulas', () => {
    let s = crossing();
    const { id } = car(s);
    const odd = { ...card(id, 0, like(1.5, { first: { [id]: { 12: true } } })), name: '=1+1, "so"' };
    s = judge(oneSubject(car(s)), asked(s), odd, 'reject', { trait: 'harshness', wants: 'less' }).apply(s);
    s = say(s, 3, 'keep');
    const lines = feedbackTable(id, car(s).feedback!, nameOf).trimEnd().split('\r\n');
    expect(lines[0]).toBe(
      'round,letter,name,verdict,why,pace_mps,gap_s,harshness_mps2,standing_s,from_log_m,manoeuvre,before Car 12',
    );
    expect(lines[1]).toBe(`1,A,"'=1+1, ""so""",reject,too harsh,6,2.4,1.5,0,,,true`);
    expect(lines[2]).toBe('1,D,Way 3,keep,,6,2.4,3,0,,,');
  });
});

describe('feedback on the whole scene', () => {
  const whole = (s: Scene) => everybody(s);
  const asking = (s: Scene): RoundInputs => presentRound(s.feedback, printOf(s));
  const many = Array.from({ length: 50 }, (_, i) => `${i}`);

  /** All go straight on except one, which turns; one pair has either order. */
  const sceneCard = (n: number): Judged => ({
    card: {
      features: like(n, {
        first: Object.fromEntries(many.map((id, i) => [id, { other: i === 40 ? n % 2 === 0 : true }])),
        manoeuvres: Object.fromEntries(many.map((id, i) => [id, i === 45 && n % 2 ? 'left' : 'straight'])),
      }),
      places: {
        moving: [0, 1, 2].map((t) => [t * 5 + 0.123, n * 2]),
        standing: [0, 1, 2].map(() => [70.04, 3]),
      },
    },
    letter: 'ABCDEF'[n],
    name: `Way ${n}`,
  });
  const judged = [0, 1, 2, 3].reduce(
    (s, n) => judge(whole(s), asking(s), sceneCard(n), n % 2 ? 'keep' : 'reject').apply(s),
    crossing(),
  );

  it('is sent with a limited number of traits: those that distinguish the cards', () => {
    const next = nextRound(whole(judged), asking(judged)).apply(judged);
    const { answers = [] } = docOf(next.feedback, asking(next));
    expect(answers).toHaveLength(4);
    const traits = new Set(
      answers.flatMap(({ features: f }) => [
        ...Object.entries(f.first ?? {}).flatMap(([who, row]) => Object.keys(row).map((o) => `${who} before ${o}`)),
        ...Object.entries(f.manoeuvres ?? {}).map(([who, does]) => `${who} ${does}`),
      ]),
    );
    expect(traits.size + 5).toBeLessThanOrEqual(64);
    expect(traits.size).toBeGreaterThan(40);
    for (const told of ['40 before other', '45 left', '45 straight']) expect(traits).toContain(told);
    for (const { features } of answers) expect(features.gap_s).toBe(2.4);
    // All of it is stored: later rounds may distinguish others.
    expect(Object.keys(next.feedback!.answers[0].features.manoeuvres!)).toHaveLength(50);
  });

  it('stores positions in short form, and is found again by them', () => {
    const [first] = judged.feedback!.answers;
    expect(first.places).toEqual({
      moving: [
        [0.1, 0],
        [5.1, 0],
        [10.1, 0],
      ],
      standing: [[70, 3]],
    });
    const said = (n: number) => answerTo(judged.feedback, asking(judged), sceneCard(n).card)?.letter;
    expect([0, 1, 2, 3, 4].map(said)).toEqual(['A', 'B', 'C', 'D', undefined]);
    const again = judge(whole(judged), asking(judged), sceneCard(1), null).apply(judged);
    expect(again.feedback!.answers.map((a) => a.letter)).toEqual(['A', 'C', 'D']);
    expect(car(again).feedback, 'of a road user nothing was said').toBeNull();
  });
});
