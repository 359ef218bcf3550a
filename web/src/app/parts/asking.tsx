// What futures are asked with: seed, diversity, and the button that asks.
import { useRef } from 'preact/hooks';
import { useComputed } from '@preact/signals';
import { setDiversity, setSeed } from '../../model/document/commands';
import { DEFAULTS } from '../../model/base/domain';
import { useApp } from './app-context';
import { ActionButton, IconButton } from './buttons';
import { Slider } from './slider';
import { resultCode } from '../../model/document/result-code';
import { TEXTS } from '../../texts/desk/parts';
import { TEXTS as CODE } from '../../texts/files/result-code';

export function Controls() {
  const { editor } = useApp();
  const away = useComputed(() => editor.away.value !== null).value;
  return (
    <>
      <span class="fieldlab">{TEXTS.seed}</span>
      <SceneSeed />
      <IconButton id="new-seed" />
      <span class="gap" />
      <span class="fieldlab">{TEXTS.diversity}</span>
      <DiversitySlider />
      <ResultCode />
      <ActionButton id="generate" class="pri" icon="" withKey>
        {away ? TEXTS.waiting : TEXTS.generate}
      </ActionButton>
      <IconButton id="variants" />
    </>
  );
}

/** Names what is shown in six characters, to be told to somebody else; a click copies it. */
function ResultCode() {
  const { editor } = useApp();
  const code = useComputed(() => {
    const scene = editor.resting.value;
    return scene ? resultCode(scene, editor.motion.value) : '';
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
  return <SeedField label={TEXTS.seed} seed={seed} set={(v) => editor.run(setSeed(v))} />;
}

interface SeedFieldProps {
  label: string;
  seed: number;
  set: (v: number) => void;
}

/** A whole number; what is none goes back to the seed that holds, and is said. */
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
          if (v !== editor.scene.peek()?.diversity) editor.run(setDiversity(v));
        }}
      />
      <span class="pct">{percent}%</span>
    </>
  );
}
