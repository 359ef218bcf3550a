// A part of the page that is loaded when it is first wanted: what few need does not make everybody wait.
import type { ComponentType } from 'preact';
import { useEffect } from 'preact/hooks';
import { useSignal } from '@preact/signals';

export function Later({ load }: { load: () => Promise<ComponentType> }) {
  const part = useSignal<{ readonly of: ComponentType } | null>(null);
  useEffect(() => {
    let wanted = true;
    void load().then((of) => {
      if (wanted) part.value = { of };
    });
    return () => {
      wanted = false;
    };
  }, []);
  const Part = part.value?.of;
  return Part ? <Part /> : null;
}
