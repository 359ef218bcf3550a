// Places on the way: each with where it is, how near it is passed, and when.
import { useComputed } from '@preact/signals';
import type { Vec } from '../../model/base/geometry';
import { lengthText, lengthUnit, lengthUnitWord, metres, num, seconds } from '../../model/base/units';
import { passed, VIA_TOLERANCE } from '../../model/document/vias';
import { verdictsHold } from '../../edit/goal-verdict';
import { heldTime, outOfOrder, swapVias, toggleViaTime, viaTime } from '../../edit/via-times';
import { changeVia, moveVia, removeVia, viaName, widenVia } from '../../edit/vias';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { NumberField } from '../parts/number-field';
import { placesAlong } from '../../model/document/lanemap';
import type { Command } from '../../model/document/commands';
import { TEXTS } from '../../texts/editing/via';
import { inSentence } from '../../texts/language';
import type { LiveAgent } from './use-agent';

export function ViasSection({ agent }: { agent: LiveAgent }) {
  const count = useComputed(() => agent.value.goal.via.length).value;
  if (!count) return null;
  return (
    <section class="sect vias" aria-label={TEXTS.placesOnTheWay}>
      <h3>
        <span class="mk">
          <Icon name="via" size={15} />
        </span>
        {TEXTS.placesOnTheWay}
        <small>{count}</small>
      </h3>
      {Array.from({ length: count }, (_, i) => (
        <ViaRows key={i} agent={agent} i={i} />
      ))}
      <Order agent={agent} />
      <ActionButton id="add-via" class="line" size={15} />
    </section>
  );
}

/** The path would pass two of them the other way round: whether they swap is asked. */
function Order({ agent }: { agent: LiveAgent }) {
  const { editor } = useApp();
  const i = useComputed(() => (editor.dragging.value ? null : outOfOrder(editor, agent.value))).value;
  if (i === null) return null;
  const words = TEXTS.liesBefore(viaName(agent.value, i + 1), inSentence(viaName(agent.value, i)));
  return (
    <p class="leave">
      {words}
      <button type="button" class="words" onClick={() => editor.run(swapVias(agent.peek(), i))}>
        {TEXTS.swapThem}
      </button>
    </p>
  );
}

function ViaRows({ agent, i }: { agent: LiveAgent; i: number }) {
  const { editor } = useApp();
  const via = () => agent.value.goal.via[i];
  const run = (c: Command | null): void => {
    if (c) editor.run(c);
  };
  const name = useComputed(() => viaName(agent.value, i)).value;
  const held = useComputed(() => editor.viaInHand.value === i).value;
  const said = useComputed(() => {
    const f = editor.toldFutures.value;
    const m = f?.modes[editor.toldChosen.value]?.motion;
    const at = m && verdictsHold(editor) ? passed(agent.value.goal.via, m)[i] : null;
    if (!at) return '';
    return at.ok ? TEXTS.passedAt(seconds(at.time)) : TEXTS.awayAt(metres(at.away, 1), seconds(at.time));
  });
  const fixed = useComputed(() => via()?.time != null).value;
  const take = () => editor.takeVia(i);
  const live = (handle: 'via' | 'ring') => () => {
    const grip = editor.drag.value?.grip;
    return grip?.handle === handle && grip.index === i;
  };
  const coordinate = (axis: 0 | 1) => (
    <NumberField
      label={TEXTS.inMetres(name, axis ? 'y' : 'x')}
      letter={axis ? 'y' : 'x'}
      unit={() => (lengthUnit() === 'ft' ? 'm' : '')}
      quantity={() => 'place'}
      step={0.1}
      value={() => via()?.pos[axis] ?? null}
      text={() => num(via()?.pos[axis] ?? 0, 1)}
      range={() => placesAlong(editor.scene.peek()!.map, axis)}
      live={live('via')}
      set={(v, l) => {
        const [x, y] = agent.peek().goal.via[i].pos;
        run(moveVia(agent.peek(), i, (axis ? [x, v] : [v, y]) as Vec, l));
      }}
      onFocus={take}
    />
  );
  return (
    <div class={held ? 'viarows held' : 'viarows'} role="group" aria-label={name}>
      <div class="pr">
        <span class="lab">{name}</span>
        <div class="fs">
          {coordinate(0)}
          {coordinate(1)}
        </div>
        <button
          type="button"
          class="off"
          aria-label={TEXTS.removeOne(inSentence(name))}
          title={TEXTS.remove}
          onClick={() => run(removeVia(agent.peek(), i))}
        >
          <Icon name="x" size={12} />
        </button>
      </div>
      <div class="pr">
        <span class="lab">{TEXTS.within}</span>
        <div class="fs">
          <NumberField
            label={TEXTS.toleranceIn(name, lengthUnitWord())}
            letter="±"
            unit={lengthUnit}
            quantity={() => 'length'}
            step={0.1}
            value={() => via()?.tolerance ?? null}
            text={() => lengthText(via()?.tolerance ?? 0, 1)}
            range={() => VIA_TOLERANCE}
            field={`via-${i}-tolerance`}
            live={live('ring')}
            set={(v, l) => run(widenVia(agent.peek(), i, v, l))}
            onFocus={take}
          />
          <NumberField
            label={TEXTS.timeInSeconds(name)}
            letter="t"
            unit={() => 's'}
            quantity={() => 'time'}
            step={0.1}
            value={() => via()?.time ?? viaTime(editor, agent.value, i)}
            text={() => {
              const t = via()?.time ?? viaTime(editor, agent.value, i);
              return t === null ? '' : `${via()?.time == null ? '≈ ' : ''}${num(t, 1)}`;
            }}
            range={() => [0.5, editor.scene.value?.length ?? 9]}
            free={() => via()?.time == null}
            set={(v, l) => {
              const a = agent.peek();
              const time = heldTime(a, i, v, editor.scene.peek()?.length ?? v);
              if (time !== null) run(changeVia(a, i, { time }, l));
            }}
            onFocus={take}
          />
        </div>
        <button
          type="button"
          class="fx"
          role="switch"
          aria-checked={fixed}
          aria-label={TEXTS.timeFixed(name)}
          title={fixed ? TEXTS.fixedYouDecide : TEXTS.freeTheGenerator}
          onClick={() => run(toggleViaTime(editor, agent.peek(), i))}
        >
          <Icon name="lock" size={11} />
          {fixed ? TEXTS.fixed : TEXTS.free}
        </button>
      </div>
      <p class="note" aria-live="off">
        {said}
      </p>
    </div>
  );
}
