// Which dialog is open.
import { useApp } from '../parts/app-context';
import { ConfirmDelete } from './confirm-delete';
import { ImportReport } from './import-report';
import { Palette } from './palette';
import { Shortcuts } from './shortcuts';

export function Dialogs() {
  const { importing, ui } = useApp();
  const verdicts = importing.verdicts.value;
  const deleting = ui.deleting.value;
  return (
    <>
      {ui.dialog.value === 'palette' ? <Palette /> : null}
      {ui.dialog.value === 'shortcuts' ? <Shortcuts /> : null}
      {deleting ? <ConfirmDelete id={deleting} /> : null}
      {verdicts ? <ImportReport verdicts={verdicts} /> : null}
    </>
  );
}
