// Rounds of cards, of one road user or of the whole scene: requested, judged, drawn again from the verdicts, and one of
// them taken.
import { batch, computed, effect, signal, type ReadonlySignal } from '@preact/signals-core';
import {
  docOf,
  hasNews,
  presentRound,
  sameTrait,
  type CardVerdict,
  type RoundInputs,
  type Verdict,
  type Wish,
} from '../../../model/document/feedback';
import { reasons, wishWords } from '../../../model/words/feedback-words';
import { LETTERS } from '../../../model/document/futures';
import { printOf, shortFor, canMove, nameIn } from '../../../model/document/scene';
import { addWish, forget, judge, nextRound, type Subject } from '../../../model/document/feedback-commands';
import { takeDealt, type Command } from '../../../model/document/commands';
import type { Generator } from '../../../net/generator';
import { inWords } from '../../../net/refusal';
import type { FinalEvent } from '../../../net/types';
import type { Editor } from '../../session/editor';
import type { RequestBuilder, Wanted } from '../../asking/request-builder';
import type { Deck, Hand } from './deck';
import { handOf, sceneTaken } from './dealing';
import type { Take } from '../../asking/take-maker';
import type { DealtScenes } from '../variants/variants';
import { TEXTS } from '../../../texts/editing/rounds';

/** A preference, as far as it is known. */
export interface Wished {
  readonly wish: Wish;
  readonly words: string;
  /** Null for a preference stated since the cards were drawn. */
  readonly learned: Hand['round']['wishes'][number] | null;
}

/** Rounds that an undo restores at once. */
const REMEMBERED = 24;

const NO_ANSWER = TEXTS.theGenerator;

/** Joint scenes are judged one by one. */
const EVERYBODY: Wanted = {
  agents: 'all',
  react: false,
  step: { name: '', agent: null, undo: false, everybody: true },
};

export class Rounds {
  readonly #known = new Map<string, Hand>();
  /** Identifies the document of the open rounds. */
  #print = '';
  readonly #tries = signal(0);

  /** Subject of the rounds; null while they are closed. */
  readonly subject: ReadonlySignal<Subject | null>;
  /** Inputs of the current round in the document; null while rounds are closed. */
  readonly asked: ReadonlySignal<RoundInputs | null>;
  /** Verdict on each card; null where it is open. */
  readonly said: ReadonlySignal<readonly (CardVerdict | null)[]>;
  readonly wished: ReadonlySignal<readonly Wished[]>;
  readonly mayGoOn: ReadonlySignal<boolean>;
  readonly isOpen: ReadonlySignal<boolean>;

  constructor(
    private readonly editor: Editor,
    private readonly deck: Deck,
    private readonly questions: RequestBuilder,
    private readonly generator: Generator,
  ) {
    this.isOpen = computed(() => deck.of.value !== null);
    const print = computed(() => (this.isOpen.value && editor.scene.value ? printOf(editor.scene.value) : ''));
    this.subject = deck.subject;
    this.asked = computed(() => {
      const a = this.subject.value;
      return a ? presentRound(a.feedback, print.value) : null;
    });
    this.said = deck.said;
    this.mayGoOn = computed(() => {
      const [a, asked] = [this.subject.value, this.asked.value];
      return !!a && !!asked && hasNews(a.feedback, asked) && this.#ready(true);
    });
    this.wished = computed(() => this.#wishes());
    // Any other change of the document or of the selection ends the rounds.
    effect(() => {
      const of = deck.of.value;
      if (!of) return;
      const looked = of.id === null || editor.selection.value === of.id;
      const same = looked && !editor.drag.active.value && print.value === this.#print;
      if (!same || !this.subject.value || editor.document.lock.value) this.close();
    });
    const question = computed(() => {
      const [a, asked] = [this.subject.value, this.asked.value];
      return a && asked ? JSON.stringify([a.id, asked.round, asked.key, docOf(a.feedback, asked)]) : null;
    });
    const blocked = computed(() => editor.answers.motion.value.stale || editor.answers.away.value !== null);
    effect(() => {
      const text = question.value;
      void this.#tries.value;
      if (text !== null && !blocked.value) this.#ask(text);
      else if (text !== null && editor.answers.away.peek()) deck.fail(NO_ANSWER);
    });
  }

  // -------------------------------------------------------------- open and closed

  /** For the selected road user. */
  open(): void {
    const a = this.editor.agent.peek();
    if (a && canMove(a)) this.#open(a.id, a.name);
  }

  /** For the whole scene. */
  openScene(): void {
    if (this.editor.scene.peek()) this.#open(null, TEXTS.theWholeScene);
  }

  #open(id: string | null, name: string): void {
    const { editor } = this;
    const lock = editor.document.lock.peek();
    if (lock) return editor.notices.show({ text: lock.words, action: lock });
    this.#print = printOf(editor.scene.peek()!);
    this.#stopAsking();
    batch(() => {
      editor.playhead.pause();
      editor.playhead.moveTo(0);
      this.deck.open(id);
    });
    editor.notices.say(TEXTS.roundsOf(name));
  }

  close(): void {
    this.#stopAsking();
    this.deck.close();
  }

  /** A running answer to a change must still arrive: the cards wait for it. */
  #stopAsking(): void {
    if (!this.editor.answers.motion.peek().stale) this.generator.cancel();
  }

  /** Sends the request again after a failure. */
  tryAgain(): void {
    this.#tries.value++;
  }

  // -------------------------------------------------------------- verdicts

  /** Keeps or rejects a card; the same verdict again clears it. */
  say(index: number, verdict: Verdict): void {
    const was = this.said.peek()[index];
    this.#judge(index, was?.verdict === verdict ? null : verdict, null);
  }

  /** The reason for a verdict; on an open card it rejects the card. */
  sayWhy(index: number, key: string): void {
    const [a, hand] = [this.subject.peek(), this.deck.hand.peek()];
    const card = hand?.round.cards[index];
    if (!a || !card) return;
    const verdict = this.said.peek()[index]?.verdict ?? 'reject';
    const all = reasons(a.id, card.features, verdict, this.#nameOf);
    this.#judge(index, verdict, all.find((c) => c.key === key)?.wish ?? null);
  }

  #judge(index: number, verdict: Verdict | null, why: Wish | null): void {
    const { deck } = this;
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
    if (traits.length) this.#run((a, asked) => forget(a, asked, traits, TEXTS.all));
  }

  /** Draws the next round. */
  next(): void {
    if (this.mayGoOn.peek()) this.#run(nextRound);
    else if (this.#ready()) this.editor.notices.show({ text: TEXTS.keepOrReject });
  }

  /**
   * Takes a card as the followed future: the others react as to any picked one. A whole-scene card already has their
   * reactions.
   */
  take(index: number): void {
    const { editor } = this;
    const [hand, scene] = [this.deck.hand.peek(), editor.scene.peek()];
    if (!hand || !scene || index >= hand.names.length || !this.#ready() || editor.document.lock.peek()) return;
    const before = editor.answers.motion.peek();
    batch(() => {
      this.close();
      if (hand.id === null) {
        const { command, take } = sceneTaken(scene, hand, index);
        editor.answers.know(take.set);
        editor.commits.run(command);
        return;
      }
      const a = scene.agents.get(hand.id)!;
      editor.answers.look(a.id, hand.futures, before.reach.get(a.id) ?? null);
      editor.commits.run(takeDealt(a, index, hand.print, LETTERS[index]));
    });
    // Undo shows the answers from before.
    editor.answers.know(before);
  }

  /** The kept cards, each as the document after it is taken. */
  kept(): DealtScenes | readonly Take[] | null {
    const [hand, scene] = [this.deck.hand.peek(), this.editor.scene.peek()];
    if (!hand || !scene || !this.#ready()) return null;
    const which = this.said.peek().flatMap((s, i) => (s?.verdict === 'keep' ? [i] : []));
    if (hand.id === null) return which.map((i) => sceneTaken(scene, hand, i).take);
    const a = scene.agents.get(hand.id)!;
    const scenes = which.map((i) => takeDealt(a, i, hand.print, LETTERS[i]).apply(scene));
    return { id: a.id, scenes, futures: hand.futures };
  }

  #run(make: (a: Subject, asked: RoundInputs) => Command | null): void {
    const [a, asked] = [this.subject.peek(), this.asked.peek()];
    const command = a && asked && make(a, asked);
    if (command) this.editor.commits.run(command);
  }

  // -------------------------------------------------------------- the cards

  #ask(text: string): void {
    const { deck } = this;
    const { scene: document } = this.editor;
    const { motion } = this.editor.answers;
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
      // Partly drawn cards are not shown for judging.
      draft: () => undefined,
      final: (e) => this.#deal(text, a, asked, e),
      refused: (p) => deck.fail(inWords(p)),
      away: () => deck.fail(NO_ANSWER),
    });
    this.generator.ask(question);
  }

  #deal(text: string, of: Subject, asked: RoundInputs, e: FinalEvent): void {
    const { deck } = this;
    const { scene } = this.editor;
    const { motion } = this.editor.answers;
    const document = scene.peek();
    const round = e.feedback;
    const made = document && handOf(document, motion.peek(), of, e);
    if (!round || !made?.names.length) return deck.fail(TEXTS.noCardsCame);
    const hand: Hand = { ...made, print: shortFor(text), asked, round };
    this.#known.set(text, hand);
    if (this.#known.size > REMEMBERED) this.#known.delete(this.#known.keys().next().value as string);
    deck.deal(hand);
    this.editor.notices.say(TEXTS.roundA(asked.round, hand.names.length, hand.names[0]));
  }

  /** Do the cards belong to the document? */
  #ready(watch = false): boolean {
    const { deck } = this;
    const [hand, asked] = watch ? [deck.hand.value, this.asked.value] : [deck.hand.peek(), this.asked.peek()];
    const asking = watch ? deck.asking.value : deck.asking.peek();
    return !!hand && !asking && hand.asked.round === asked?.round && hand.asked.key === asked.key;
  }

  /** Learned preferences and those stated since, without forgotten ones. */
  #wishes(): readonly Wished[] {
    const { deck } = this;
    const f = this.subject.value?.feedback;
    const forgotten = f?.forgotten ?? [];
    const own = f?.wishes ?? [];
    const learned = (deck.hand.value?.round.wishes ?? []).filter((w) => {
      const other = own.find((o) => sameTrait(o, w));
      if (forgotten.some((t) => sameTrait(t, w))) return false;
      // A preference stated and withdrawn since is dropped.
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

/** Only the preference, without statistics. */
function wishOf(l: Hand['round']['wishes'][number]): Wish {
  const { wants } = l;
  if (l.trait === 'first') return { trait: l.trait, who: l.who, with: l.with, wants };
  return l.trait === 'does' ? { trait: l.trait, who: l.who, manoeuvre: l.manoeuvre, wants } : { trait: l.trait, wants };
}
