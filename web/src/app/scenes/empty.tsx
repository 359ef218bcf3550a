// The first screen when there is no scene to open.
import { useComputed } from '@preact/signals';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { about, ChooseFiles } from './drawer';
import { Thumbnail } from './thumbnail';
import { TEXTS } from '../../texts/empty';

const OFFERED = 3;

export function Empty() {
  const { library, scenes } = useApp();
  const cards = scenes.list.value.slice(0, OFFERED);
  return (
    <div class="empty">
      <div class="in">
        <h1>{cards.length ? TEXTS.startWithACrossing : TEXTS.bringAScene}</h1>
        <Words some={cards.length > 0} />
        {cards.length ? (
          <div class="cards">
            {cards.map((s) => (
              <button key={s.id} type="button" class="crd" onClick={() => void library.open(s.id)}>
                <Thumbnail item={s} width={220} height={132} />
                <div>
                  <b>{s.name}</b>
                  <small>{about(s)}</small>
                </div>
              </button>
            ))}
          </div>
        ) : null}
        <div class="drop">
          <b>{TEXTS.dropSceneFiles}</b>
          {TEXTS.scenarioRecords}
          <ChooseFiles />
          {' · '}
          <ActionButton id="new-map" class="line" size={14} />
        </div>
      </div>
    </div>
  );
}

function Words({ some }: { some: boolean }) {
  const { editor } = useApp();
  const away = useComputed(() => editor.away.value !== null).value;
  const none = away ? TEXTS.theServerIsNot : TEXTS.thereAreNoExamples;
  return <p>{some ? TEXTS.openAnExample : none}</p>;
}
