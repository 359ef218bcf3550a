// A switch, with its label beside it.
interface SwitchProps {
  label: string;
  on: boolean;
  title?: string;
  set: (on: boolean) => void;
}

export const Switch = ({ label, on, title, set }: SwitchProps) => (
  <button
    type="button"
    class="bareswitch"
    role="switch"
    aria-checked={on}
    aria-label={label}
    title={title}
    onClick={() => set(!on)}
  >
    <i class="knob" />
  </button>
);
