// The list of events, and the facts of the one that is picked.
import { useEffect, useMemo } from 'preact/hooks';
import { counted, worstOf } from '../../model/physics/events';
import type { TrafficEvent } from '../../model/words/event-words';
import type { Agent } from '../../model/document/scene';
import { threshold, type ThresholdName } from '../../model/document/thresholds';
import { num } from '../../model/base/units';
import type { Editor } from '../../edit/editor';
import { laneWords } from '../../edit/snap';
import { poseAt } from '../../model/base/motion';
import { eventRemedies } from '../../edit/event-remedies';
import { Weighing } from '../../edit/weighing';
import { useApp } from '../parts/app-context';
import { IconButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { RemedyButton } from '../parts/remedy-button';
import { EventList } from './event-list';
import { ThresholdsSection, told } from './thresholds-section';
import { TEXTS } from '../../texts/panels/events-panel';
import { TEXTS as COUNTS } from '../../texts/panels/thresholds';

export function EventsPanel() {
  const { editor, ui } = useApp();
  // Asked for by itself it comes first, above however many events there are.
  const first = ui.eventsPanel.value === 'counts';
  const events = editor.events.value;
  const worst = worstOf(events);
  const own = counted(events).length;
  const length = TEXTS.inTheseS(num(editor.scene.peek()?.duration ?? 9, 0));
  const inLog = events.length - own;
  return (
    <>
      <div class="ih">
        <div class={`ag t-${worst === 'collision' ? 'collision' : worst && worst !== 'short' ? 'near' : 'ink'}`}>
          <Icon name="warn" size={20} />
        </div>
        <div class="grow">
          <h2>{TEXTS.events}</h2>
          <p>{`${own} ${length}${inLog ? TEXTS.inTheLog(inLog) : ''}`}</p>
        </div>
        <IconButton id="deselect" icon="x" size={16} />
      </div>
      {first ? <ThresholdsSection last={false} /> : null}
      <section class="sect">
        <EventList below={(e) => <Facts event={e} />} />
      </section>
      {first ? null : <ThresholdsSection last />}
    </>
  );
}

/** The lane on which the first of them is then. */
function whereWords(editor: Editor, { a, at: [x, y], time }: TrafficEvent): string {
  const p = poseAt(editor.motionFor(a), time);
  // Where it is itself: between the two are other lanes.
  return laneWords(editor.scene.peek()!.map, a, p?.x ?? x, p?.y ?? y, p?.heading ?? 0);
}

function Facts({ event: e }: { event: TrafficEvent }) {
  const { editor, supposing, ui, variants } = useApp();
  const weighing = useMemo(() => new Weighing(editor, supposing), [editor, supposing]);
  useEffect(() => weighing.begin(), [weighing]);
  const now = (name: ThresholdName): string => told(name, threshold(editor.scene.peek()!, name));
  const counts = COUNTS.countsBelow(now('ttc_s'), now('gap_m'));
  const change = (id: string) => {
    editor.setTime(0);
    ui.showEvents(false);
    editor.select(id);
  };
  return (
    <div class="evfacts">
      <section>
        <h3>{e.label.replace(/ (?=\d)/, ' at ')}</h3>
        <dl class="wh">
          <dt>{TEXTS.where}</dt>
          <dd>{whereWords(editor, e)}</dd>
          {e.facts.flatMap(([what, value]) => [<dt key={what}>{what}</dt>, <dd key={`${what}:`}>{value}</dd>])}
        </dl>
        {e.kind === 'near' ? <p class="note">{counts}</p> : null}
      </section>
      <section>
        <h3>{TEXTS.whatYouCanDo}</h3>
        <div class="stack">
          {eventRemedies(editor, e).map((r) => (
            <RemedyButton key={r.label} remedy={r} outcome={weighing.of(r)} />
          ))}
          {[e.a, e.b]
            .filter((a): a is Agent => a !== null && a.type !== 'other' && a.logStart !== null)
            .map((a) => (
              <button key={a.id} type="button" class="opt" onClick={() => change(a.id)}>
                <Icon name="select" size={15} />
                {TEXTS.change(a.name)}
              </button>
            ))}
          <button type="button" class="opt" onClick={() => variants.keepPresent()}>
            <Icon name="star" size={15} />
            {TEXTS.keepAsAVariant}
          </button>
        </div>
      </section>
    </div>
  );
}
