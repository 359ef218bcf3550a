// What the placing tool puts down: a size, and one or many at once.
import { useComputed } from '@preact/signals';
import { rangesOf } from '../../model/base/domain';
import { KIND_NAMES, KIND_WORDS, PRESETS, typeOfKind, type PlacedKind, type Preset } from '../../model/base/kinds';
import { areaText, lengthUnit, lengthUnitWord, sizeText } from '../../model/base/units';
import { placedBy } from '../../actions/place';
import { LEAST_COUNT, MOST_COUNT, type Spread } from '../../edit/placing';
import { useApp } from '../parts/app-context';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { TEXTS } from '../../texts/panels/place-panel';

const SPREADS: readonly (readonly [Spread, string, string])[] = [
  ['one', TEXTS.one, TEXTS.clickWhereIt],
  ['line', TEXTS.alongALine, TEXTS.dragALineThey],
  ['area', TEXTS.overAnArea, TEXTS.dragOverTheGround],
];

export function PlacePanel() {
  const c = useApp();
  const kind = useComputed(() => placedBy(c)).value;
  return kind ? <Panel key={kind} kind={kind} /> : null;
}

const same = (a: Preset, b: Preset): boolean => a.length === b.length && a.width === b.width && a.subtype === b.subtype;

function Panel({ kind }: { kind: PlacedKind }) {
  const { editor } = useApp();
  const { placement } = editor;
  const choice = useComputed(() => placement.choice(kind)).value;
  const { size, spread } = choice;
  const preset = PRESETS[kind].find((p) => same(p, size));
  const own = (patch: Partial<Preset>) =>
    placement.choose(kind, { size: { ...size, label: KIND_NAMES[kind], ...patch } });
  return (
    <section class="card placing" aria-label={TEXTS.placeA(KIND_WORDS[kind])}>
      <h3>
        {TEXTS.placeA(KIND_WORDS[kind])}
        <button type="button" class="btn i" aria-label={TEXTS.donePlacing} onClick={() => editor.chooseTool('select')}>
          <Icon name="x" size={16} />
        </button>
      </h3>
      <div role="radiogroup" aria-label={TEXTS.size}>
        {PRESETS[kind].map((p) => (
          <button
            key={p.label}
            type="button"
            class={`preset ${p === preset ? 'on' : ''}`}
            role="radio"
            aria-checked={p === preset}
            onClick={() => placement.choose(kind, { size: p })}
          >
            <Icon name={kind} size={18} />
            {p.label}
            <small>{areaText(p.length, p.width)}</small>
          </button>
        ))}
        <div class={`preset own ${preset ? '' : 'on'}`}>
          {TEXTS.ownSize}
          <OwnSize kind={kind} name="length" set={(length) => own({ length })} />
          <OwnSize kind={kind} name="width" set={(width) => own({ width })} />
        </div>
      </div>
      <div class="seg wide" role="radiogroup" aria-label={TEXTS.howMany}>
        {SPREADS.map(([id, text, help]) => (
          <button
            key={id}
            type="button"
            class={`btn ${spread === id ? 'on' : ''}`}
            role="radio"
            aria-checked={spread === id}
            title={help}
            onClick={() => placement.choose(kind, { spread: id })}
          >
            {text}
          </button>
        ))}
      </div>
      {spread === 'one' ? null : (
        <div class="many">
          <span>{TEXTS.howMany}</span>
          <NumberField
            label={TEXTS.howManyRoadUsers}
            field="place-count"
            unit={() => ''}
            quantity={() => 'count'}
            step={1}
            range={() => [LEAST_COUNT, MOST_COUNT]}
            value={() => placement.choice(kind).count}
            text={() => String(placement.choice(kind).count)}
            set={(n) => placement.choose(kind, { count: Math.round(n) })}
          />
        </div>
      )}
      <p class="note">{SPREADS.find(([id]) => id === spread)![2]}.</p>
    </section>
  );
}

function OwnSize({ kind, name, set }: { kind: PlacedKind; name: 'length' | 'width'; set: (v: number) => void }) {
  const { placement } = useApp().editor;
  return (
    <NumberField
      label={TEXTS.ownIn(TEXTS.sizes[name], lengthUnitWord())}
      letter={TEXTS.letters[name]}
      unit={() => (lengthUnit() === 'ft' ? 'ft' : '')}
      quantity={() => 'length'}
      step={0.1}
      range={() => rangesOf({ type: typeOfKind(kind) })[`${name}_m`]}
      value={() => placement.choice(kind).size[name]}
      text={() => sizeText(placement.choice(kind).size[name])}
      set={set}
    />
  );
}
