// Why a future is shown and not another one.
import { compareFaults } from '../document/future-facts';
import { LETTERS, rankOf, type Futures } from '../document/futures';
import type { NameOf } from '../document/scene';
import { group, grouped, groupOf, sentence, type Walker } from './verdict-words';
import { TEXTS } from '../../texts/scene/verdicts';

/** Key of those without a worse fault. */
const NO_WORSE = 'no-worse';

/**
 * Why the future at `shown` is shown instead of the likelier ones and of the one at `was`: their worse faults, and cost
 * or probability of those without one; null where none has a worse fault.
 */
function whyNotOthers(f: Futures, shown: number, nameOf: NameOf, was = shown): string | null {
  const now = f.modes[shown]?.about;
  if (!now) return null;
  const who: Walker = { type: 'vehicle', nameOf };
  const rank = rankOf(f.modes, shown);
  const all = grouped(f.modes, (i) => {
    const { about } = f.modes[i];
    const isLikelier = rankOf(f.modes, i) < rank;
    if (i === shown || !about || (i !== was && !isLikelier)) return null;
    if (compareFaults(about, now) < 0)
      return groupOf(f, i, about, { named: null, offRoad: false, hasGoal: false, who });
    return isLikelier
      ? group(NO_WORSE, TEXTS.haveHigherCost, TEXTS.hasHigherCost)
      : group(`${NO_WORSE}-was`, TEXTS.isLessLikely, TEXTS.isLessLikely);
  });
  const [worse, others] = [false, true].map((no) => all.filter((g) => g.key.startsWith(NO_WORSE) === no));
  return worse.length ? TEXTS.isShown(LETTERS[shown], [...worse, ...others].map(sentence).join('; ')) : null;
}

/** Why the shown future is not the likeliest; null where it is. */
export function whyNotLikeliest(f: Futures, shown: number, nameOf: NameOf): string | null {
  const first = f.modes.findIndex((_, i) => rankOf(f.modes, i) === 1);
  if (first === shown || !f.modes[first]?.about || !f.modes[shown]) return null;
  return whyNotOthers(f, shown, nameOf) ?? TEXTS.costsLess(LETTERS[shown], LETTERS[first]);
}

/** Why another future is shown than the bold one before, in any case. */
export function whyAnother(f: Futures, was: number, shown: number, nameOf: NameOf): string | null {
  const [old, now] = [f.modes[was], f.modes[shown]];
  if (!now || was === shown) return null;
  if (!old) return TEXTS.previousIsGone(LETTERS[shown]);
  const plain = now.probability > old.probability ? TEXTS.isLikelier : TEXTS.wasInTheDrag;
  return whyNotOthers(f, shown, nameOf, was) ?? plain(LETTERS[shown], LETTERS[was]);
}
