// What one must know before going on: a crash, a generator that is away, a conflict, a scene that does not open.
import type { ComponentChildren } from 'preact';
import { useComputed } from '@preact/signals';
import { perform } from '../../actions/registry';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { TEXTS } from '../../texts/desk/hud';

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
    <Box icon="warn" title={TEXTS.somethingBroke} words={TEXTS.reloadThePage}>
      <Button label={TEXTS.reload} run={() => location.reload()} />
      <Button label={TEXTS.copyDetails} run={() => void navigator.clipboard?.writeText(details)} />
    </Box>
  );
}

function Away() {
  const { editor, generation } = useApp();
  const waiting = useComputed(() => editor.away.value?.waiting ?? 0).value;
  const retryIn = useComputed(() => editor.away.value?.retryIn ?? 0);
  const changes = waiting ? TEXTS.keepEditingChanges(waiting) : TEXTS.keepEditingChangesWill;
  const words = (
    <>
      {TEXTS.tryingAgainIn(changes)} {retryIn} s.
    </>
  );
  return (
    <Box icon="cloud" title={TEXTS.theGenerator} words={words}>
      <Button label={TEXTS.tryNow} run={() => void generation.tryNow()} />
    </Box>
  );
}

function Conflict() {
  const { library, saving } = useApp();
  const keep = <Button label={TEXTS.keepThisVersion} run={() => void saving.keepMine()} />;
  if (saving.conflict.value?.etag === null)
    return (
      <Box icon="warn" title={TEXTS.thisSceneWasDeleted} words={TEXTS.itIsMadeAgain}>
        {keep}
      </Box>
    );
  return (
    <Box icon="warn" title={TEXTS.thisSceneWas} words={TEXTS.nothingIsOverwritten}>
      {keep}
      <Button label={TEXTS.openTheOther} run={() => void library.takeTheirs()} />
    </Box>
  );
}

function Locked() {
  const { editor } = useApp();
  const lock = editor.lock.value!;
  return (
    <Box icon="lock" title={lock.words} words={TEXTS.youCanLookPlay}>
      <Button label={lock.label} run={() => lock.run()} />
    </Box>
  );
}

function Full() {
  const c = useApp();
  const words = TEXTS.exportTheScene;
  const makeRoom = async () => {
    const n = await c.journal.makeRoom((id) => c.scenes.isOwn(id)).catch(() => 0);
    await c.journal.retry();
    const full = c.journal.keeping.peek() === 'full';
    const done = n ? TEXTS.stepsOfOther(n) : '';
    const now = full ? TEXTS.thereIsStill : TEXTS.thisOneIsKept;
    c.editor.notices.show({ text: done + now });
  };
  return (
    <Box icon="warn" title={TEXTS.noRoomLeftOn} words={words}>
      <Button label={TEXTS.export} run={() => perform(c, 'export')} />
      <Button label={TEXTS.makeRoom} run={() => void makeRoom()} />
    </Box>
  );
}

function BrokenLink({ why }: { why: string }) {
  const { sharing } = useApp();
  return (
    <Box icon="warn" title={TEXTS.theLinkCould} words={TEXTS.askForItOnce(why)}>
      <Button label={TEXTS.close} run={() => sharing.dismiss()} />
    </Box>
  );
}

function NotOpened({ why }: { why: string }) {
  const { library } = useApp();
  return (
    <Box icon="warn" title={TEXTS.theSceneCould} words={why}>
      <Button label={TEXTS.close} run={() => library.dismissError()} />
    </Box>
  );
}
