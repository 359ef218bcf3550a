// What differs between the two variants that are compared: a table, and the moments at which they part.
import { goToMoment } from '../../actions/variants';
import { num, seconds } from '../../model/units';
import type { Moment } from '../../model/parting';
import type { Compared } from '../../edit/variants/cards';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { SpeedPair } from './speed-pair';

export default function ComparePanel() {
  const c = useApp();
  const now = c.variants.compared.value;
  if (!now) return null;
  const { left, right, parting } = now;
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name="compare" size={20} />
        </div>
        <div class="grow">
          <h2>Compare</h2>
          <p>
            Variant {left.id} and variant {right.id}
          </p>
        </div>
        <button type="button" class="btn i" aria-label="End the comparison" onClick={() => c.variants.endCompare()}>
          <Icon name="x" size={16} />
        </button>
      </div>
      <section class="sect compare">
        <table>
          <thead>
            <tr>
              <td />
              <th scope="col">{left.id}</th>
              <th scope="col">{right.id}</th>
            </tr>
          </thead>
          <tbody>
            {parting.rows.map((r) => (
              <tr key={r.what} class={r.differs ? 'differs' : ''}>
                <th scope="row">{r.what}</th>
                <td>{r.left}</td>
                <td>{r.right}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </section>
      <SpeedPair key={`${left.id} ${right.id}`} now={now} />
      <section class="sect">
        <h3>
          When they part
          <small>click to go there</small>
        </h3>
        {parting.moments.length ? null : <p class="sec">They are the same.</p>}
        {parting.moments.map((m) => (
          <MomentRow key={`${m.time} ${m.words}`} moment={m} />
        ))}
      </section>
      <section class="sect last">
        <h3>Same in both</h3>
        <p class="sec">{sameWords(now)}</p>
      </section>
      <footer class="sect foot">
        <ActionButton id="export-variants" class="line" icon="">
          Export both
        </ActionButton>
        <ActionButton id="swap-variants" class="line" icon="">
          Swap sides
        </ActionButton>
      </footer>
    </>
  );
}

function MomentRow({ moment: m }: { moment: Moment }) {
  const c = useApp();
  const here = Math.abs(c.editor.time.value - m.time) < 0.05;
  return (
    <button type="button" class="moment" aria-current={here} onClick={() => goToMoment(c, m)}>
      <b>{seconds(m.time)}</b>
      <span>{m.words}</span>
    </button>
  );
}

function sameWords({ left, right, parting }: Compared): string {
  const numbers = [
    left.state.seed === right.state.seed ? `seed ${left.state.seed}` : '',
    left.state.diversity === right.state.diversity ? `diversity ${num(left.state.diversity * 100, 0)}%` : '',
  ].filter(Boolean);
  return `${['Map', ...numbers].join(', ')}, ${parting.same} of ${parting.all} road users.`;
}
