// A number dragged along a line between its least and its greatest value.
interface SliderProps {
  label: string;
  value: number;
  range: readonly [least: number, greatest: number];
  step: number;
  /** The value in words, for screen readers. */
  text: string;
  title?: string;
  set: (v: number) => void;
}

export function Slider({ label, value, range: [least, greatest], step, text, title, set }: SliderProps) {
  return (
    <input
      type="range"
      aria-label={label}
      aria-valuetext={text}
      title={title}
      min={least}
      max={greatest}
      step={step}
      value={value}
      style={{ '--fill': `${((value - least) / (greatest - least)) * 100}%` }}
      onInput={(e) => set(Number(e.currentTarget.value))}
    />
  );
}
