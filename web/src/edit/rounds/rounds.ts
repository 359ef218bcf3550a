// Rounds of cards, of one road user or of the whole scene: asked for, judged, drawn anew by what was said, and one of
// them taken.
import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals-core';
import {
  docOf,
  hasNews,
  presentRound,
  sameTrait,
  type Answer,
  type Asked,
  type Verdict,
  type Wish,
} from '../../model/document/feedback';
import { reasons, wishWords } from '../../model/words/feedback-words';
import { LETTERS } from '../../model/document/futures';
import { printOf, shortFor, canMove, nameIn } from '../../model/document/scene';
import { addWish, forget, judge, nextRound, type Subject } from '../../model/document/feedback-commands';
import { takeDealt, type Command } from '../../model/document/commands';
import type { Generator } from '../../net/generator';
import { inWords } from '../../net/refusal';
import type { FinalEvent } from '../../net/types';
import type { Editor } from '../editor';
import type { Questions, Wanted } from '../question';
import type { Hand } from './deck';
import { handOf, sceneTaken } from './dealing';
import type { Take } from '../variants/making';
import type { Dealt } from '../variants/variants';
import { saidOf, subjectOf } from './said';
import { TEXTS } from '../../texts/editing/rounds';

/** What is wished, as far as it is known. */
export interface Wished {
  readonly wish: Wish;
  readonly words: string;
  /** Null for one that was said since the cards were drawn. */
  readonly learned: Hand['round']['wishes'][number] | null;
}

/** Rounds that an undo shows again at once. */
const REMEMBERED = 24;

const NO_ANSWER = TEXTS.theGenerator;

/** Joint scenes are judged, each by itself. */
const EVERYBODY: Wanted = {
  agents: 'all',
  react: false,
  step: { name: '', agent: null, undo: false, everybody: true },
};

export class Rounds {
  readonly #known = new Map<string, Hand>();
  /** The document that the open rounds are about. */
  #print = '';
  readonly #tries = signal(0);

  /** Whom they are about; null while they are closed. */
  readonly subject: ReadonlySignal<Subject | null>;
  /** What the document asks of the present round; null while rounds are closed. */
  readonly asked: ReadonlySignal<Asked | null>;
  /** What was said of each card; null where it is open. */
  readonly said: ReadonlySignal<readonly (Answer | null)[]>;
  readonly wished: ReadonlySignal<readonly Wished[]>;
  readonly mayGoOn: ReadonlySignal<boolean>;
  readonly isOpen: ReadonlySignal<boolean>;

  constructor(
    private readonly editor: Editor,
    private readonly questions: Questions,
    private readonly generator: Generator,
  ) {
    const { deck } = editor;
    this.isOpen = computed(() => deck.of.value !== null);
    const print = computed(() => (this.isOpen.value && editor.scene.value ? printOf(editor.scene.value) : ''));
    this.subject = computed(() => subjectOf(editor));
    this.asked = computed(() => {
      const a = this.subject.value;
      return a ? presentRound(a.feedback, print.value) : null;
    });
    this.said = computed(() => saidOf(editor));
    this.mayGoOn = computed(() => {
      const [a, asked] = [this.subject.value, this.asked.value];
      return !!a && !!asked && hasNews(a.feedback, asked) && this.#ready(true);
    });
    this.wished = computed(() => this.#wishes());
    // Whatever else changes the document, or takes the eyes off this road user, ends the rounds.
    effect(() => {
      const of = deck.of.value;
      if (!of) return;
      const looked = of.id === null || editor.selection.value === of.id;
      const same = looked && !editor.dragging.value && print.value === this.#print;
      if (!same || !this.subject.value || editor.lock.value) this.close();
    });
    const question = computed(() => {
      const [a, asked] = [this.subject.value, this.asked.value];
      return a && asked ? JSON.stringify([a.id, asked.round, asked.key, docOf(a.feedback, asked)]) : null;
    });
    const blocked = computed(() => editor.motion.value.stale || editor.away.value !== null);
    effect(() => {
      const text = question.value;
      void this.#tries.value;
      if (text !== null && !blocked.value) this.#ask(text);
      else if (text !== null && editor.away.peek()) deck.fail(NO_ANSWER);
    });
  }

  // -------------------------------------------------------------- open and closed

  /** For the selected road user. */
  open(): void {
    const a = this.editor.agent.peek();
    if (a && canMove(a)) this.#open(a.id, a.name);
  }

  /** For everybody. */
  openScene(): void {
    if (this.editor.scene.peek()) this.#open(null, TEXTS.theWholeScene);
  }

  #open(id: string | null, name: string): void {
    const { editor } = this;
    const lock = editor.lock.peek();
    if (lock) return editor.notices.show({ text: lock.words, action: lock });
    this.#print = printOf(editor.scene.peek()!);
    this.generator.cancel();
    batch(() => {
      editor.playhead.pause();
      editor.setTime(0);
      editor.deck.open(id);
    });
    editor.notices.say(TEXTS.roundsOf(name));
  }

  close(): void {
    this.generator.cancel();
    this.editor.deck.close();
  }

  /** Asks again after nobody answered. */
  tryAgain(): void {
    this.#tries.value++;
  }

  // -------------------------------------------------------------- what is said

  /** Keeps or rejects a card; the same once more opens it again. */
  say(index: number, verdict: Verdict): void {
    const was = this.said.peek()[index];
    this.#judge(index, was?.verdict === verdict ? null : verdict, null);
  }

  /** Why a card is liked or not; of an open one it says that it is not. */
  sayWhy(index: number, key: string): void {
    const [a, hand] = [this.subject.peek(), this.editor.deck.hand.peek()];
    const card = hand?.round.cards[index];
    if (!a || !card) return;
    const verdict = this.said.peek()[index]?.verdict ?? 'reject';
    const all = reasons(a.id, card.features, verdict, this.#nameOf);
    this.#judge(index, verdict, all.find((c) => c.key === key)?.wish ?? null);
  }

  #judge(index: number, verdict: Verdict | null, why: Wish | null): void {
    const { deck } = this.editor;
    const hand = deck.hand.peek();
    const card = hand?.round.cards[index];
    deck.point(index);
    if (!hand || !card || !this.#ready()) return;
    const of = { card, letter: LETTERS[index], name: hand.names[index] };
    this.#run((a, asked) => judge(a, asked, of, verdict, why));
  }

  wish(wish: Wish): void {
    this.#run((a, asked) => addWish(a, asked, wish, wishWords(wish, this.#nameOf)));
  }

  forget({ wish, words }: Wished): void {
    this.#run((a, asked) => forget(a, asked, [wish], words));
  }

  forgetAll(): void {
    const traits = this.wished.peek().map((w) => w.wish);
    if (traits.length) this.#run((a, asked) => forget(a, asked, traits, TEXTS.allWishes));
  }

  /** Draws the next round. */
  next(): void {
    if (this.mayGoOn.peek()) this.#run(nextRound);
    else if (this.#ready()) this.editor.notices.show({ text: TEXTS.keepOrReject });
  }

  /**
   * A card becomes what the road user does: the others answer it as any future that is picked. One of the whole scene
   * has their answers already.
   */
  take(index: number): void {
    const { editor } = this;
    const [hand, scene] = [editor.deck.hand.peek(), editor.scene.peek()];
    if (!hand || !scene || index >= hand.names.length || !this.#ready() || editor.lock.peek()) return;
    const before = editor.motion.peek();
    batch(() => {
      this.close();
      if (hand.id === null) {
        const { command, take } = sceneTaken(scene, hand, index);
        editor.answers.know(take.set);
        editor.run(command);
        return;
      }
      const a = scene.agents.get(hand.id)!;
      editor.answers.look(a.id, hand.futures, before.reach.get(a.id) ?? null);
      editor.run(takeDealt(a, index, hand.print, LETTERS[index]));
    });
    // Undo shows what was there before.
    editor.answers.know(before);
  }

  /** The kept cards, each as the document in which it is taken. */
  kept(): Dealt | readonly Take[] | null {
    const [hand, scene] = [this.editor.deck.hand.peek(), this.editor.scene.peek()];
    if (!hand || !scene || !this.#ready()) return null;
    const which = this.said.peek().flatMap((s, i) => (s?.verdict === 'keep' ? [i] : []));
    if (hand.id === null) return which.map((i) => sceneTaken(scene, hand, i).take);
    const a = scene.agents.get(hand.id)!;
    const scenes = which.map((i) => takeDealt(a, i, hand.print, LETTERS[i]).apply(scene));
    return { id: a.id, scenes, futures: hand.futures };
  }

  #run(make: (a: Subject, asked: Asked) => Command | null): void {
    const [a, asked] = [this.subject.peek(), this.asked.peek()];
    const command = a && asked && make(a, asked);
    if (command) this.editor.run(command);
  }

  // -------------------------------------------------------------- the cards

  #ask(text: string): void {
    const { deck, scene: document, motion } = this.editor;
    const known = this.#known.get(text);
    if (known) {
      this.generator.cancel();
      deck.deal(known);
      return;
    }
    const [a, asked, scene] = [this.subject.peek(), this.asked.peek(), document.peek()];
    if (!a || !asked || !scene) return;
    deck.ask();
    const feedback = docOf(a.feedback, asked);
    const wanted: Wanted =
      a.id === null ? { ...EVERYBODY, feedback } : { agents: [a.id], react: false, step: null, feedback };
    const question = this.questions.makeApart(scene, motion.peek(), wanted, {
      // Half-drawn cards are nothing to be judged.
      draft: () => undefined,
      final: (e) => this.#deal(text, a, asked, e),
      refused: (p) => deck.fail(inWords(p)),
      away: () => deck.fail(NO_ANSWER),
    });
    this.generator.ask(question);
  }

  #deal(text: string, of: Subject, asked: Asked, e: FinalEvent): void {
    const { deck, motion, scene } = this.editor;
    const document = scene.peek();
    const round = e.feedback;
    const made = document && handOf(document, motion.peek(), of, e);
    if (!round || !made?.names.length) return deck.fail(TEXTS.noCardsCame);
    const hand: Hand = { ...made, print: shortFor(text), asked, round };
    this.#known.set(text, hand);
    if (this.#known.size > REMEMBERED) this.#known.delete(this.#known.keys().next().value as string);
    deck.deal(hand);
    const many = of.id === null ? TEXTS.ways : TEXTS.futures;
    this.editor.notices.say(TEXTS.roundA(asked.round, hand.names.length, many, hand.names[0]));
  }

  /** Are the cards those of the document? */
  #ready(watch = false): boolean {
    const { deck } = this.editor;
    const [hand, asked] = watch ? [deck.hand.value, this.asked.value] : [deck.hand.peek(), this.asked.peek()];
    const asking = watch ? deck.asking.value : deck.asking.peek();
    return !!hand && !asking && hand.asked.round === asked?.round && hand.asked.key === asked.key;
  }

  /** What was learned and what was said since, without what was forgotten. */
  #wishes(): readonly Wished[] {
    const { deck } = this.editor;
    const f = this.subject.value?.feedback;
    const forgotten = f?.forgotten ?? [];
    const own = f?.wishes ?? [];
    const learned = (deck.hand.value?.round.wishes ?? []).filter((w) => {
      const other = own.find((o) => sameTrait(o, w));
      if (forgotten.some((t) => sameTrait(t, w))) return false;
      // Of what was said and taken back since nothing is left.
      return other ? other.wants === w.wants : !w.said;
    });
    const since = own.filter((w) => !learned.some((l) => sameTrait(l, w)));
    return [
      ...learned.map((l) => ({ wish: wishOf(l), words: wishWords(l, this.#nameOf, l.kept), learned: l })),
      ...since.map((w) => ({ wish: w, words: wishWords(w, this.#nameOf), learned: null })),
    ];
  }

  readonly #nameOf = (id: string): string | null => {
    const scene = this.editor.scene.peek();
    return scene ? nameIn(scene)(id) : null;
  };
}

/** The wish alone. */
function wishOf(l: Hand['round']['wishes'][number]): Wish {
  const { wants } = l;
  if (l.trait === 'first') return { trait: l.trait, who: l.who, with: l.with, wants };
  return l.trait === 'does' ? { trait: l.trait, who: l.who, manoeuvre: l.manoeuvre, wants } : { trait: l.trait, wants };
}
