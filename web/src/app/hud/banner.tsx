// What one must know before going on: a crash, a generator that is away, a conflict, a scene that does not open.
import type { ComponentChildren } from 'preact';
import { useComputed } from '@preact/signals';
import { perform } from '../../actions/registry';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';

export function Banner() {
  const { editor, journal, library, saving, sharing } = useApp();
  const away = useComputed(() => editor.away.value !== null).value;
  if (editor.notices.crash.value) return <Crash details={editor.notices.crash.value} />;
  if (away) return <Away />;
  if (editor.lock.value) return <Locked />;
  if (saving.conflict.value) return <Conflict />;
  if (journal.keeping.value === 'full') return <Full />;
  if (sharing.error.value) return <BrokenLink why={sharing.error.value} />;
  if (library.openError.value) return <NotOpened why={library.openError.value} />;
  return null;
}

interface BoxProps {
  icon: string;
  title: string;
  words: ComponentChildren;
  children: ComponentChildren;
}

function Box({ icon, title, words, children }: BoxProps) {
  return (
    <div class="banner" role="alert">
      <Icon name={icon} size={20} />
      <div>
        <b>{title}</b>
        <span class="sub">{words}</span>
      </div>
      {children}
    </div>
  );
}

function Button({ label, run }: { label: string; run: () => void }) {
  return (
    <button type="button" class="btn" onClick={run}>
      {label}
    </button>
  );
}

function Crash({ details }: { details: string }) {
  return (
    <Box icon="warn" title="Something broke in the editor. The scene is safe." words="Reload the page to go on.">
      <Button label="Reload" run={() => location.reload()} />
      <Button label="Copy details" run={() => void navigator.clipboard?.writeText(details)} />
    </Box>
  );
}

function Away() {
  const { editor, generation } = useApp();
  const waiting = useComputed(() => editor.away.value?.waiting ?? 0).value;
  const retryIn = useComputed(() => editor.away.value?.retryIn ?? 0);
  const changes = waiting
    ? `Keep editing: ${waiting} change${waiting > 1 ? 's are' : ' is'} waiting and saved on this computer.`
    : 'Keep editing: changes will wait and are saved on this computer.';
  const words = (
    <>
      {changes} Trying again in {retryIn} s.
    </>
  );
  return (
    <Box icon="cloud" title="The generator is not answering. Nothing is lost." words={words}>
      <Button label="Try now" run={() => void generation.tryNow()} />
    </Box>
  );
}

function Conflict() {
  const { library, saving } = useApp();
  const words = 'Nothing is overwritten until you choose.';
  return (
    <Box icon="warn" title="This scene was changed elsewhere." words={words}>
      <Button label="Keep this version" run={() => void saving.keepMine()} />
      <Button label="Open the other one" run={() => void library.takeTheirs()} />
    </Box>
  );
}

function Locked() {
  const { editor } = useApp();
  const lock = editor.lock.value!;
  return (
    <Box icon="lock" title={lock.words} words="You can look, play and select.">
      <Button label={lock.label} run={() => lock.run()} />
    </Box>
  );
}

function Full() {
  const c = useApp();
  const words = 'Export the scene to be safe, or forget the steps of other scenes that are saved.';
  const makeRoom = async () => {
    const n = await c.journal.makeRoom((id) => c.scenes.isOwn(id)).catch(() => 0);
    await c.journal.retry();
    const full = c.journal.keeping.peek() === 'full';
    const done = n ? `Steps of ${n} other scene${n > 1 ? 's' : ''} forgotten. ` : '';
    const now = full ? 'There is still no room: export this scene.' : 'This one is kept again.';
    c.editor.notices.show({ text: done + now });
  };
  return (
    <Box icon="warn" title="No room left on this computer for saving." words={words}>
      <Button label="Export" run={() => perform(c, 'export')} />
      <Button label="Make room" run={() => void makeRoom()} />
    </Box>
  );
}

function BrokenLink({ why }: { why: string }) {
  const { sharing } = useApp();
  return (
    <Box icon="warn" title="The link could not be opened." words={`${why} Ask for it once more, or for the file.`}>
      <Button label="Close" run={() => sharing.dismiss()} />
    </Box>
  );
}

function NotOpened({ why }: { why: string }) {
  const { library } = useApp();
  return (
    <Box icon="warn" title="The scene could not be opened." words={why}>
      <Button label="Close" run={() => library.dismissError()} />
    </Box>
  );
}
