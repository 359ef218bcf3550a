// Which dialog is open. All but the one for everything are loaded when the page has nothing else to do.
import { useEffect } from 'preact/hooks';
import { useApp } from '../parts/app-context';
import { Later } from '../parts/later';
import { Palette } from './palette';

const LATER = {
  shortcuts: () => import('./shortcuts').then((m) => m.Shortcuts),
  'save-as': () => import('./save-as').then((m) => m.SaveAs),
  share: () => import('../outward/share').then((m) => m.default),
  export: () => import('../outward/export').then((m) => m.default),
} as const;
const report = () => import('./import-report').then((m) => m.ImportReport);

/** So long after the page is there the rest of it comes, whatever else goes on. */
const REST_MS = 4000;

export function Dialogs() {
  const { importing, ui } = useApp();
  const dialog = ui.dialog.value;
  useEffect(() => {
    const all = () => void Promise.all([...Object.values(LATER), report].map((load) => load().catch(() => null)));
    if (typeof requestIdleCallback === 'undefined') setTimeout(all, REST_MS);
    else requestIdleCallback(all, { timeout: REST_MS });
  }, []);
  return (
    <>
      {dialog === 'palette' ? <Palette /> : dialog ? <Later key={dialog} load={LATER[dialog]} /> : null}
      {importing.verdicts.value ? <Later load={report} /> : null}
    </>
  );
}
