import type { SENTENCES } from '../../messages/messages';
import type { Said, Values } from '../../table';

export const german: Said<typeof SENTENCES> = {
  since: (time, sentence) => `Ab ${time}: ${sentence}`,
  inLine: (line, sentence) => `Zeile ${line}: ${sentence}`,
  lists: { kind: { vehicle: 'dieses Fahrzeug', cyclist: 'dieses Fahrrad', pedestrian: 'diese Person' } },
  sentences: {
    'goal-too-far': {
      title: (v: Values) => `Zu weit für ${v.time_s}`,
      rest: (v: Values) =>
        `Das Ziel ist ${v.goal_m} entfernt. In ${v.time_s} kommt ${v.kind} aus ${v.start_mps} höchstens ${v.most_m} weit.`,
    },
    'goal-too-fast': {
      title: (v: Values) => `So starkes Beschleunigen ist in ${v.time_s} aus ${v.start_mps} nicht möglich`,
      rest: (v: Values) => (v.need_mps2 ? `Nötig wären ${v.need_mps2}.` : ''),
    },
    'goal-above-top-speed': {
      title: (v: Values) => `Zu schnell für ${v.kind}: über der Höchstgeschwindigkeit`,
      rest: (v: Values) => (v.need_mps ? `Nötig wären ${v.need_mps}.` : ''),
    },
    'goal-too-near': {
      title: () => 'Anhalten ist so früh nicht möglich',
      rest: (v: Values) =>
        `Der Bremsweg aus ${v.start_mps} beträgt ${v.least_m}, das Ziel ist ${v.goal_m} entfernt.${v.need_mps2 && ` Nötig wären ${v.need_mps2}.`}`,
    },
    'goal-too-slow': {
      title: (v: Values) => `So starkes Bremsen ist in ${v.time_s} nicht möglich`,
      rest: (v: Values) => (v.need_mps2 ? `Nötig wären ${v.need_mps2}.` : ''),
    },
    'goal-too-tight': {
      title: () => 'Zu eng bei diesem Tempo',
      rest: (v: Values) => (v.need_mps2 ? `Nötige Querbeschleunigung: ${v.need_mps2}.` : ''),
    },
    'goal-turn-too-tight': { title: (v: Values) => `Die Kurve ist für ${v.kind} zu eng`, rest: '' },
    'goal-blocked': {
      title: (v: Values) => `Verkehrsteilnehmer ${v.agent} ist im Weg für ${v.kind}`,
      rest: (v: Values) => `Der Halt liegt ${v.short_m} vor dem Ziel.`,
    },
    'goal-blocked-by-traffic': {
      title: (v: Values) => `Ein anderer Verkehrsteilnehmer ist im Weg für ${v.kind}`,
      rest: (v: Values) => `Der Halt liegt ${v.short_m} vor dem Ziel.`,
    },
    'goal-off-road': { title: (v: Values) => `Im Umkreis von ${v.within_m} um das Ziel ist keine Spur`, rest: '' },
    'goal-beyond-top-speed': {
      title: (v: Values) => `${v.goal_m} in ${v.time_s} sind auch mit Höchstgeschwindigkeit nicht möglich`,
      rest: '',
    },
    'relation-gone': {
      title: (v: Values) => `Verkehrsteilnehmer ${v.agent} ist bei ${v.time_s} nicht in der Szene`,
      rest: 'Das Ziel bezieht sich auf ihn.',
    },
    'relation-lane-ends': {
      title: (v: Values) => `Die Spur endet ${v.short_m} vor dem Ziel`,
      rest: (v: Values) => `Das Ziel bezieht sich auf Verkehrsteilnehmer ${v.agent} bei ${v.time_s}.`,
    },
    'relation-no-lane-left': {
      title: (v: Values) => `Spur ${v.number} links von Verkehrsteilnehmer ${v.agent} gibt es nicht`,
      rest: (v: Values) => `Das gilt für seinen Ort bei ${v.time_s}.`,
    },
    'relation-no-lane-right': {
      title: (v: Values) => `Spur ${v.number} rechts von Verkehrsteilnehmer ${v.agent} gibt es nicht`,
      rest: (v: Values) => `Das gilt für seinen Ort bei ${v.time_s}.`,
    },
    'relation-not-passed': {
      title: (v: Values) => `Verkehrsteilnehmer ${v.agent} passiert das Ziel nicht`,
      rest: (v: Values) => `Er kommt nicht näher als ${v.within_m} heran.`,
    },
    'relation-off-lanes': {
      title: (v: Values) => `Verkehrsteilnehmer ${v.agent} ist bei ${v.time_s} auf keiner Spur`,
      rest: 'Daher gibt es keine Spur daneben.',
    },
    'relation-outside': {
      title: (v: Values) => `Das Ziel wäre bei ${v.time_s} fällig`,
      rest: (v: Values) =>
        `Verkehrsteilnehmer ${v.agent} passiert es bei ${v.passed_s}; möglich sind ${v.least_s} bis ${v.most_s}.`,
    },
    'relation-stands': {
      title: (v: Values) => `Verkehrsteilnehmer ${v.agent} steht bei ${v.time_s}`,
      rest: 'Eine Zeitlücke braucht ein Tempo; ein Abstand in Metern ist möglich.',
    },
    'relation-too-slow': {
      title: (v: Values) => `${v.slower_mps} langsamer ergäbe ein Tempo unter null`,
      rest: (v: Values) => `Verkehrsteilnehmer ${v.agent} fährt bei ${v.time_s} mit ${v.other_mps}.`,
    },
    'start-off-road': (v: Values) => `Im Umkreis von ${v.within_m} um den Start ist keine Spur.`,
    'start-overlaps': (v: Values) => `Der Start überlappt Verkehrsteilnehmer ${v.agent}.`,
    'via-missed': (v: Values) =>
      `Zwischenpunkt ${v.number} wird bei ${v.time_s} um ${v.distance_m} verfehlt; die Toleranz ist ${v.tolerance_m}.`,
    'nothing-generated':
      'Kein Verkehrsteilnehmer wird neu erzeugt, und keine bekannte Bewegung endet vor dem letzten Fenster.',
    'motion-ends': (v: Values) =>
      `Die bekannte Bewegung endet bei ${v.time_s}; danach geht es geradeaus mit gleichem Tempo weiter.`,
  },
};
