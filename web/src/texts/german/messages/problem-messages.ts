import type { SENTENCES } from '../../messages/problem-messages';
import type { Said, Values } from '../../table';
import { plural } from '../plural';

export const german: Said<typeof SENTENCES> = {
  lists: {},
  sentences: {
    'unknown-agent': (v: Values) => `Die Szene hat keinen Verkehrsteilnehmer „${v.id}“`,
    'not-asked': (v: Values) =>
      `Verkehrsteilnehmer „${v.id}“ fehlt in agents: dort ergänzen oder diese Vorgabe weglassen`,
    'no-agents-named': 'Erwartet: „all“, mindestens eine Kennung oder mindestens ein Verkehrsteilnehmer, der reagiert',
    'too-many-regenerated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer neu zu erzeugen; höchstens ${v.most}`,
        other: `${v.count} Verkehrsteilnehmer neu zu erzeugen; höchstens ${v.most}`,
      }),
    'too-many-points': (v: Values) => `Die Antwort hätte ${v.points} Punkte; höchstens ${v.most}`,
    'too-much-work': (v: Values) => `Die Anfrage würde etwa ${v.seconds} s eines Kerns brauchen; höchstens ${v.most}`,
    'no-future-kept': 'Die Szene hat ab dem Start keine Zukunft dieses Verkehrsteilnehmers',
    'replan-interval': (v: Values) => `${v.got} s; erwartet wird null, 3, 6 oder 9`,
    'more-than-a-turn': (v: Values) => `${v.got} rad ist mehr als eine Umdrehung; ${v.got} Grad sind ${v.radians} rad`,
    'one-scene': 'Nötig ist genau eines von scene und scene_id',
    'changed-scene': 'Die gespeicherte Szene wurde seit dem Lesen geändert.',
    'no-network': (v: Values) => `Zu einer Datei im Format ${v.format} gehört keine Netzdatei`,
    'no-part': (v: Values) =>
      `Eine Datei im Format ${v.format} wird ganz gelesen; Karten von SUMO, OpenDRIVE, Lanelet2 und OpenStreetMap auch in Teilen`,
    'no-columns': (v: Values) => `Eine Datei im Format ${v.format} hat keine Spalten zu benennen`,
    'unknown-format': (v: Values) => `Kein Format heißt „${v.format}“; es gibt ${v.formats}.`,
    'ego-absent': (v: Values) => `„${v.id}“ ist zu Beginn nicht in der Szene`,
    'ego-once': (v: Values) => `„${v.id}“ ist genau einmal anzugeben`,
    'not-an-ego': (v: Values) => `„${v.id}“ ist kein Ego-Fahrzeug`,
    'no-ego-state': (v: Values) => `„${v.id}“, Zustand ${v.at}: Ort oder Tempo liegt außerhalb der Grenzen`,
    'step-order': (v: Values) => `Schritt ${v.got} erhalten; erwartet wird Schritt ${v.next}`,
    'setting-of-snapshot': (v: Values) => `Der Schnappschuss legt ${v.member} selbst fest`,
    'snapshot-of-another-scene': 'Der Schnappschuss stammt aus einer anderen Szene',
    'snapshot-broken': (v: Values) => `Kein Schnappschuss: Byte ${v.at} ist falsch`,
    'too-many-runs': 'Für einen weiteren Lauf ist kein Platz; einen löschen oder warten',
    'too-many-requests': (v: Values) =>
      plural(Number(v.most), {
        one: `Mehr als ${v.most} Anfrage in der Sekunde von diesem Aufrufer`,
        other: `Mehr als ${v.most} Anfragen in der Sekunde von diesem Aufrufer`,
      }),
    defect: 'Im Server ist ein Fehler aufgetreten. Mehr steht in seinem Protokoll.',
    'exactly-one': (v: Values) => `Nötig ist genau eines von ${v.first} und ${v.second}`,
    'share-sum': (v: Values) => `Die Summe der Anteile ist ${v.sum}; erwartet: 1`,
    'empty-map': 'Die Karte ist leer: Sie hat keinen Platz für einen Bereich',
  },
};
