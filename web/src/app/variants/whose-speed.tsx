// The road user whose speeds the timeline shows in both variants.
import type { Compared } from '../../edit/tools/variants/cards';
import { useApp } from '../parts/app-context';
import { TEXTS } from '../../texts/panels/variants-panel';

export function WhoseSpeed({ now }: { now: Compared }) {
  const { variants } = useApp();
  const { diverging } = now.comparison;
  if (!diverging.length) return null;
  return (
    <section class="sect">
      <h3>
        {TEXTS.speed}
        <small>{TEXTS.inTheTimeline}</small>
      </h3>
      <select
        class="field pick"
        aria-label={TEXTS.speedOf}
        value={variants.comparing.followed.value?.agent.id}
        onChange={(e) => variants.comparing.follow(e.currentTarget.value)}
      >
        {diverging.map((p) => (
          <option key={p.agent.id} value={p.agent.id}>
            {p.agent.name}
          </option>
        ))}
      </select>
    </section>
  );
}
