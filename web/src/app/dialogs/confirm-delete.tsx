// Asks before a scene is removed from the server.
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { Modal } from '../parts/modal';

export function ConfirmDelete({ id }: { id: string }) {
  const { editor, library, scenes, ui } = useApp();
  const close = () => ui.askToDelete(null);
  const name = scenes.find(id)?.name ?? editor.scene.peek()?.name ?? id;
  const remove = () => {
    close();
    void library.remove(id);
  };
  return (
    <Modal label="Delete the scene" class="import" close={close}>
      <header>
        <span class="t-collision">
          <Icon name="trash" size={22} />
        </span>
        <h2>Delete “{name}”?</h2>
      </header>
      <div class="body">
        <p class="sec">The scene and its futures are removed from this server. This cannot be undone.</p>
      </div>
      <footer>
        <span class="grow" />
        <button type="button" class="btn line" data-first="" onClick={close}>
          Keep it
        </button>
        <button type="button" class="btn danger line" onClick={remove}>
          Delete
        </button>
      </footer>
    </Modal>
  );
}
