// Whose speed the timeline shows, in the one variant and in the other.
import type { Compared } from '../../edit/variants/cards';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/panels/variants-panel';

export function WhoseSpeed({ now }: { now: Compared }) {
  const { variants } = useApp();
  const { parted } = now.parting;
  if (!parted.length) return null;
  return (
    <section class="sect">
      <h3>
        {TEXTS.speed}
        <small>{TEXTS.inTheTimeline}</small>
      </h3>
      <select
        class="field pick"
        aria-label={TEXTS.whoseSpeed}
        value={variants.followed.value?.agent.id}
        onChange={(e) => variants.follow(e.currentTarget.value)}
      >
        {parted.map((p) => (
          <option key={p.agent.id} value={p.agent.id}>
            {p.agent.name}
          </option>
        ))}
      </select>
    </section>
  );
}
