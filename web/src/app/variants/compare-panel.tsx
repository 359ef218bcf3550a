// Differences between the two compared variants: a table, and the moments when they diverge.
import { goToMoment } from '../../actions/variants';
import { num, seconds } from '../../model/base/units';
import type { DivergingMoment } from '../../model/words/comparison';
import { comparisonRows } from '../../model/words/comparison-table';
import type { Compared, WholeCard } from '../../edit/tools/variants/cards';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { WhoseSpeed } from './whose-speed';
import { TEXTS } from '../../texts/panels/variants-panel';

export default function ComparePanel() {
  const c = useApp();
  const now = c.variants.comparing.compared.value;
  if (!now) return null;
  const { left, right, comparison } = now;
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name="compare" size={20} />
        </div>
        <div class="grow">
          <h2>{TEXTS.compare}</h2>
          <p>{TEXTS.variantAndVariant(calledOf(left), calledOf(right))}</p>
        </div>
        <button
          type="button"
          class="btn i"
          aria-label={TEXTS.endTheComparison}
          onClick={() => c.variants.comparing.end()}
        >
          <Icon name="x" size={16} />
        </button>
      </div>
      <section class="sect compare">
        <table>
          <thead>
            <tr>
              <td />
              <th scope="col" title={left.name}>
                {left.id}
              </th>
              <th scope="col" title={right.name}>
                {right.id}
              </th>
            </tr>
          </thead>
          <tbody>
            {comparisonRows(left, right, comparison.diverging).map((r) => (
              <tr key={r.what} class={r.differs ? 'differs' : ''}>
                <th scope="row">{r.what}</th>
                <td>{r.left}</td>
                <td>{r.right}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </section>
      <WhoseSpeed now={now} />
      <section class="sect">
        <h3>
          {TEXTS.differences}
          <small>{TEXTS.clickToGoThere}</small>
        </h3>
        {comparison.moments.length ? null : <p class="sec">{TEXTS.noDifferences}</p>}
        {comparison.moments.map((m) => (
          <MomentRow key={`${m.time} ${m.words}`} moment={m} />
        ))}
      </section>
      <section class="sect last">
        <h3>{TEXTS.sameInBoth}</h3>
        <p class="sec">{sameWords(now)}</p>
      </section>
      <footer class="sect foot">
        <button
          type="button"
          class="btn line"
          onClick={() => {
            c.variants.setScope('pair');
            c.ui.openDialog('export');
          }}
        >
          {TEXTS.exportBoth}
        </button>
        <ActionButton id="swap-variants" class="line" icon="">
          {TEXTS.swapSides}
        </ActionButton>
      </footer>
    </>
  );
}

/** Its number, and its given name. */
const calledOf = ({ id, variant }: WholeCard): string => [id, variant.called].filter(Boolean).join(' ');

function MomentRow({ moment: m }: { moment: DivergingMoment }) {
  const c = useApp();
  const here = Math.abs(c.editor.playhead.time.value - m.time) < 0.05;
  return (
    <button type="button" class="moment" aria-current={here} onClick={() => goToMoment(c, m)}>
      <b>{seconds(m.time)}</b>
      <span>{m.words}</span>
    </button>
  );
}

function sameWords({ left, right, comparison }: Compared): string {
  const numbers = [
    left.state.seed === right.state.seed ? TEXTS.seed(left.state.seed) : '',
    left.state.diversity === right.state.diversity ? TEXTS.diversity(num(left.state.diversity * 100, 0)) : '',
  ].filter(Boolean);
  return TEXTS.ofRoadUsers([TEXTS.map, ...numbers].join(', '), comparison.same, comparison.all);
}
