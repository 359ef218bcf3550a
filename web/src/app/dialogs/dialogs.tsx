// Which dialog is open.
import { useApp } from '../parts/app-context';
import { Later } from '../parts/later';
import { ImportReport } from './import-report';
import { Palette } from './palette';
import { SaveAs } from './save-as';
import { Shortcuts } from './shortcuts';

const share = () => import('../outward/share').then((m) => m.default);
const exporting = () => import('../outward/export').then((m) => m.default);

export function Dialogs() {
  const { importing, ui } = useApp();
  const verdicts = importing.verdicts.value;
  const dialog = ui.dialog.value;
  return (
    <>
      {dialog === 'palette' ? <Palette /> : null}
      {dialog === 'shortcuts' ? <Shortcuts /> : null}
      {dialog === 'save-as' ? <SaveAs /> : null}
      {dialog === 'share' ? <Later load={share} /> : null}
      {dialog === 'export' ? <Later load={exporting} /> : null}
      {verdicts ? <ImportReport verdicts={verdicts} /> : null}
    </>
  );
}
