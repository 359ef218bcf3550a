// The tabs of the drawer: its three lists, and a way to close it where the top bar is out of reach.
import { useApp } from './app-context';
import { ActionButton, IconButton } from './buttons';

const LISTS = ['scenes', 'users', 'history'] as const;

export function DrawerTabs() {
  const { form, ui } = useApp();
  return (
    <div class="tabs">
      <div class="seg wide">
        {LISTS.map((id) => (
          <ActionButton key={id} id={id} icon="" />
        ))}
      </div>
      {form.sheet.value && ui.drawer.value ? <IconButton id={ui.drawer.value} icon="x" size={16} /> : null}
    </div>
  );
}
