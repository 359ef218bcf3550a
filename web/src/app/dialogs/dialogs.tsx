// The open dialog.
import { useApp } from '../parts/app-context';
import { Later } from '../later';

export function Dialogs() {
  const { importing, ui } = useApp();
  const dialog = ui.dialog.value;
  return (
    <>
      {dialog ? <Later key={dialog} part={dialog} /> : null}
      {importing.verdicts.value ? <Later part="import report" /> : null}
    </>
  );
}
