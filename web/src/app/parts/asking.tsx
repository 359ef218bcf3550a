// Options of generation: seed, diversity, code of the result, computed length and planning window.
import type { ComponentChildren } from 'preact';
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { setDiversity, setSeed } from '../../model/document/commands';
import { DEFAULTS } from '../../model/base/domain';
import { useApp } from './app-context';
import { LENGTHS, REPLANS } from '../../model/document/scene';
import { ActionButton, IconButton, Segments } from './buttons';
import { Slider } from './slider';
import { resultCode } from '../../model/document/result-code';
import { TEXTS } from '../../texts/desk/parts';
import { TEXTS as CODE } from '../../texts/files/result-code';

/** One row for each option, and the way to variants. */
export function GenerateOptions() {
  return (
    <div class="options">
      <Option name={TEXTS.seed}>
        <SceneSeed />
        <IconButton id="new-seed" />
      </Option>
      <Option name={TEXTS.diversity}>
        <DiversitySlider />
      </Option>
      <Option name={TEXTS.length}>
        <Segments label={TEXTS.computedLength} items={seconds('length', LENGTHS)} />
      </Option>
      <Option name={TEXTS.replanEvery}>
        <Segments label={TEXTS.planningWindow} items={seconds('replan', REPLANS)} />
      </Option>
      <Option name={TEXTS.resultCode}>
        <ResultCode />
      </Option>
      <ActionButton id="variants" class="line" size={15} withKey />
    </div>
  );
}

function Option({ name, children }: { name: string; children: ComponentChildren }) {
  return (
    <div class="option">
      <span class="lab">{name}</span>
      {children}
    </div>
  );
}

/** Seconds side by side; the unit is shown once, at the end. */
const seconds = (action: string, all: readonly number[]): readonly (readonly [string, string])[] =>
  all.map((s, i) => [`${action}-${s}`, i === all.length - 1 ? `${s} s` : `${s}`]);

/** A six-character code of the shown result, to compare with others; a click copies it. */
function ResultCode() {
  const { editor } = useApp();
  const code = useComputed(() => {
    const scene = editor.resting.value;
    return scene ? resultCode(scene, editor.answers.motion.value) : '';
  });
  const copy = () => {
    void navigator.clipboard?.writeText(code.peek()).catch(() => undefined);
    editor.notices.show({ text: CODE.copied(code.peek()) });
  };
  return (
    <button
      type="button"
      class="btn code"
      aria-label={useComputed(() => CODE.label(code.value))}
      title={CODE.means}
      onClick={copy}
    >
      {code}
    </button>
  );
}

function SceneSeed() {
  const { editor } = useApp();
  const seed = useComputed(() => editor.resting.value?.seed ?? DEFAULTS.seed).value;
  return <SeedField label={TEXTS.seed} seed={seed} set={(v) => editor.commits.run(setSeed(v))} />;
}

interface SeedFieldProps {
  label: string;
  seed: number;
  set: (v: number) => void;
}

/** A whole number; other input restores the current seed, with a notice. */
export function SeedField({ label, seed, set }: SeedFieldProps) {
  const { editor } = useApp();
  const input = useRef<HTMLInputElement>(null);
  return (
    <label class="field seed">
      <input
        ref={input}
        type="text"
        inputmode="numeric"
        aria-label={label}
        maxlength={16}
        value={seed}
        onChange={() => {
          const typed = input.current!.value.trim();
          const v = /^\d+$/.test(typed) ? Number(typed) : NaN;
          const isSeed = Number.isSafeInteger(v);
          if (isSeed && v !== seed) set(v);
          else input.current!.value = String(seed);
          if (!isSeed) editor.notices.show({ text: TEXTS.noSeed(typed) });
        }}
        onKeyDown={(e) => {
          if (e.key === 'Enter') input.current!.blur();
        }}
      />
    </label>
  );
}

/** The largest diversity, in percent: the slider's length. */
const MOST = 200;

function DiversitySlider() {
  const { editor } = useApp();
  const percent = useComputed(() => Math.round((editor.resting.value?.diversity ?? DEFAULTS.diversity) * 100)).value;
  return (
    <>
      <Slider
        label={TEXTS.diversity}
        value={percent}
        range={[0, MOST]}
        step={10}
        text={`${percent}%`}
        title={TEXTS.howFarTheSix}
        set={(to) => {
          const v = to / 100;
          if (v !== editor.scene.peek()?.diversity) editor.commits.run(setDiversity(v));
        }}
      />
      <span class="pct">{percent}%</span>
    </>
  );
}
