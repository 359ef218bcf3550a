// Parameters of a map being made: the selected arm, the whole map, and its checks.
import { Fragment } from 'preact';
import { TEMPLATE_TITLES } from '../../model/document/layouts';
import { messageText, withArms } from '../../model/words/message-text';
import { SENTENCES } from '../../texts/messages/map-messages';
import { lengthUnit, num, toLength } from '../../model/base/units';
import type { Parameters } from '../../net/types';
import { useApp } from '../parts/app-context';
import { ActionButton } from '../parts/buttons';
import { Icon } from '../parts/icons';
import { Switch } from '../parts/switch';
import '../../styles/layouts.css';
import { TEXTS } from '../../texts/panels/layouts';
import { inSentence } from '../../texts/language';
import { ArmSection } from './arm-section';
import { Choice, LINES, NumberRow, Row } from './rows';

const SWITCHES: Readonly<Record<string, string>> = {
  on_ramp: TEXTS.rampJoins,
  off_ramp: TEXTS.rampLeaves,
  speed_bumps: TEXTS.speedBumps,
};
const CONTROL_WORDS = { signals: TEXTS.signals, priority: TEXTS.priority, equal: TEXTS.equal } as const;
const CONTROLS = Object.entries(CONTROL_WORDS) as readonly (readonly [keyof typeof CONTROL_WORDS, string])[];
const SIDES = [
  ['right-hand', TEXTS.rightHand],
  ['left-hand', TEXTS.leftHand],
] as const;

export default function LayoutPanel() {
  const { maker, layouts } = useApp();
  const wish = layouts.wish.value;
  const parameters = layouts.parameters.value;
  if (!wish) return null;
  const title = layouts.isNew.value ? TEXTS.newMap : TEXTS.changeTheMap;
  return (
    <>
      <div class="ih">
        <div class="ag t-ink">
          <Icon name="road" size={20} />
        </div>
        <div class="grow">
          <h2>{title}</h2>
          <p>
            {[
              wish.template.endsWith('-arms') && parameters?.arms
                ? TEXTS.arms(parameters.arms.length)
                : inSentence(TEMPLATE_TITLES[wish.template]),
              parameters?.control && inSentence(CONTROL_WORDS[parameters.control]),
            ]
              .filter(Boolean)
              .join(', ')}
          </p>
        </div>
      </div>
      <div class="layouts">
        {parameters?.arms ? <ArmSection arms={parameters.arms} /> : null}
        {parameters ? <Whole parameters={parameters} /> : null}
        <Checks />
      </div>
      <div class="layouts-foot">
        <ActionButton id="use-map" class="pri" icon="" withKey>
          {TEXTS.useThisMap}
        </ActionButton>
        <button type="button" class="btn line" onClick={() => maker.leave()}>
          {TEXTS.cancel}
        </button>
      </div>
    </>
  );
}

function Whole({ parameters }: { parameters: Parameters }) {
  const { layouts } = useApp();
  const keys = Object.keys(LINES).filter((k) => k in parameters);
  const now = (key: string): number =>
    ((layouts.parameters.value as Record<string, unknown> | null)?.[key] as number | undefined) ?? 0;
  const switches = Object.keys(SWITCHES).filter((k) => k in parameters) as (keyof Parameters)[];
  return (
    <section class="sect">
      <h3>{parameters.arms ? TEXTS.junction : TEXTS.road}</h3>
      {parameters.control ? (
        <Choice
          label={TEXTS.rightOfWay}
          items={CONTROLS}
          value={parameters.control}
          set={(control) => layouts.set({ control })}
        />
      ) : null}
      {keys.map((key) => (
        <Fragment key={key}>
          <NumberRow place={key} name={key} value={() => now(key)} set={(v) => layouts.set({ [key]: v })} />
          {key === 'kerb_radius_m' ? <Tightest asked_m={now(key)} /> : null}
        </Fragment>
      ))}
      {switches.map((key) => (
        <Row key={key} label={SWITCHES[key]}>
          <Switch label={SWITCHES[key]} on={!!parameters[key]} set={(on) => layouts.set({ [key]: on })} />
        </Row>
      ))}
      <Choice
        label={TEXTS.traffic}
        items={SIDES}
        value={parameters.traffic}
        set={(traffic) => layouts.set({ traffic })}
      />
    </section>
  );
}

/** A corner that is drawn with a smaller radius than requested. */
function Tightest({ asked_m }: { asked_m: number }) {
  const made = useApp().layouts.made.value;
  const [least] = [...(made?.corners ?? [])].sort((a, b) => a.radius_m - b.radius_m);
  if (!made || !least || least.radius_m > asked_m - 0.05) return null;
  const [a, b] = least.arms.map((arm) => made.arms[arm].title);
  return <p class="mut short">{TEXTS.tighterCorner(`${num(toLength(least.radius_m), 1)} ${lengthUnit()}`, a, b)}</p>;
}

function Checks() {
  const { stage, layouts } = useApp();
  const made = layouts.made.value;
  const fault = layouts.fault.value;
  const failed = made?.checks.filter((c) => !c.passed) ?? [];
  const sentences = withArms(SENTENCES, made?.arms ?? []);
  return (
    <section class="sect last" aria-label={TEXTS.checks}>
      <h3>{TEXTS.checks}</h3>
      <ul class="checks">
        {fault ? <li class="bad">{fault}</li> : null}
        {made?.checks.map((c) => (
          <li key={c.text} class={c.passed ? 'ok' : 'bad'}>
            {c.at_m ? (
              <button
                type="button"
                onClick={() => {
                  const [x, y] = c.at_m!;
                  stage.glide.by((v) => v.centre(x, y));
                }}
              >
                <b>{failed.indexOf(c) + 1}</b> {messageText(c.message, c.text, sentences)}
              </button>
            ) : (
              messageText(c.message, c.text, sentences)
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
