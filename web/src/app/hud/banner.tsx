// What one must know before going on: a crash, a generator that is away, a conflict, a scene that does not open.
import type { ComponentChildren } from 'preact';
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';

export function Banner() {
  const { editor, library, saving } = useApp();
  const away = useComputed(() => editor.away.value !== null).value;
  if (editor.notices.crash.value) return <Crash details={editor.notices.crash.value} />;
  if (away) return <Away />;
  if (editor.lock.value) return <Locked />;
  if (saving.conflict.value) return <Conflict />;
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

function NotOpened({ why }: { why: string }) {
  const { library } = useApp();
  return (
    <Box icon="warn" title="The scene could not be opened." words={why}>
      <Button label="Close" run={() => library.dismissError()} />
    </Box>
  );
}
