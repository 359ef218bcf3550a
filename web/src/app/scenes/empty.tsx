// The first screen when there is no scene to open.
import { useComputed } from '@preact/signals';
import { perform } from '../../actions/registry';
import { useApp } from '../parts/app-context';
import { about, ChooseFiles } from './drawer';
import { Thumbnail } from './thumbnail';
import { TEXTS } from '../../texts/desk/empty';

const OFFERED = 3;

export function Empty() {
  const c = useApp();
  const { library, scenes } = c;
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
          <button type="button" data-action="new-map" onClick={() => perform(c, 'new-map')}>
            {TEXTS.startFromANewMap}
          </button>
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
