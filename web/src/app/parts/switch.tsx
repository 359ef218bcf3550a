// On or off.
interface SwitchProps {
  label: string;
  on: boolean;
  title?: string;
  set: (on: boolean) => void;
}

export const Switch = ({ label, on, title, set }: SwitchProps) => (
  <button
    type="button"
    class="switch"
    role="switch"
    aria-checked={on}
    aria-label={label}
    title={title}
    onClick={() => set(!on)}
  />
);
