import type { SENTENCES } from '../../messages/refusal-messages';
import type { Said, Values } from '../../table';
import { plural } from '../plural';
import { WORDS } from '../refusal-words';

export const german: Said<typeof SENTENCES> = {
  lists: WORDS,
  sentences: {
    'appears-twice': (v: Values) => `${v.what} „${v.id}“ kommt zweimal vor`,
    'at-most': (v: Values) => `${v.found} ${v.what} gefunden, höchstens ${v.most} erwartet`,
    expected: (v: Values) => `Erwartet: ${v.expected}`,
    'found-expected': (v: Values) => `Gefunden: ${v.found}; erwartet: ${v.expected}`,
    'map-over-limit': (v: Values) =>
      `${v.lines} Linien mit ${v.points} Punkten; höchstens ${v.most_lines} mit ${v.most_points}`,
    'more-than': (v: Values) => `Mehr als ${v.most} ${v.what}`,
    outside: (v: Values) => `Gefunden: ${v.found}; erwartet: ${v.least} bis ${v.most}`,
    'relation-ring': (v: Values) => `Die Ziele beziehen sich im Kreis aufeinander: ${v.row}`,
    'relation-row': (v: Values) => `Mehr als ${v.most} Ziele beziehen sich in Folge aufeinander`,
    'relation-to-itself': 'Das Ziel bezieht sich auf denselben Verkehrsteilnehmer',
    'relation-unknown': (v: Values) =>
      `Das Ziel bezieht sich auf „${v.id}“; dieser Verkehrsteilnehmer ist nicht in der Szene`,
    'state-expected': (v: Values) => `Erwartet in Zustand ${v.step}: ${v.expected}`,
    'track-beyond-scene': (v: Values) => `Die Trajektorie endet nach Schritt ${v.end}, die Szene hat ${v.steps}`,
    'both-or-neither': (v: Values) => `${v.first} ist festgelegt, ${v.second} nicht; beide oder keines festlegen`,
    'cannot-decompress': (v: Values) => `Nicht zu entpacken oder zu lesen: ${v.words}`,
    'challenge-start': (v: Values) =>
      `Die Challenge beginnt bei Schritt ${v.begin} (1,0 s), diese Szene bei Schritt ${v.found} (${v.found_s}): Zukünfte mit --start-time 1.0 erzeugen`,
    'checksum-differs': (v: Values) => `Die Prüfsumme ${v.what} stimmt nicht`,
    contradiction: (v: Values) => `Nicht als ${v.format} lesbar: Die Datei widerspricht sich`,
    'element-lacks-attribute': (v: Values) => `<${v.element}> hat kein Attribut „${v.attribute}“`,
    'element-lacks-child': (v: Values) => `<${v.element}> hat kein <${v.child}>`,
    'file-ends-after': (v: Values) => `Die Datei endet nach ${v.found} von ${v.expected} Byte eines Datensatzes`,
    'file-ends-inside': (v: Values) => `Die Datei endet in ${v.what}`,
    'file-has-no': (v: Values) => `In der Datei fehlt: ${v.what}`,
    'file-needs': (v: Values) => `Für eine Datei im Format ${v.format} fehlt der Szene: ${v.what}`,
    'file-too-long': (v: Values) => `Die Datei hat mindestens ${v.bytes} Byte; höchstens ${v.most}`,
    'found-in-element': (v: Values) => `Gefunden in <${v.element}>: „${v.found}“; erwartet: ${v.expected}`,
    'found-one-of': (v: Values) => `Gefunden: „${v.found}“; erwartet: eines von ${v.list}`,
    'index-beyond': (v: Values) => `Gefunden: ${v.index}; erwartet: eine Zahl ab 0 und unter ${v.below}`,
    'inflates-too-much': (v: Values) => `Entpackt mehr als ${v.most}-mal so groß`,
    'lane-outside': (v: Values) =>
      `Spur „${v.lane}“, ${v.what}: ${v.found} gefunden, ${v.least} bis ${v.most} erwartet`,
    'lanelets-in-extract': 'Die Datei hat Lanelets: eine Lanelet2-Karte, die als lanelet2 gelesen wird',
    'map-too-wide': (v: Values) => `${v.width_m} x ${v.height_m}; eine Karte reicht bis ${v.most_m} um ihre Mitte`,
    needs: (v: Values) => `${v.what} braucht: ${v.expected}`,
    'nested-deeper': (v: Values) => `Tiefer als ${v.most} Ebenen verschachtelt`,
    'netconvert-failed': (v: Values) => `netconvert konnte aus der Datei kein Netz erzeugen: ${v.words}`,
    'netconvert-missing':
      'Ein OpenStreetMap-Auszug wird mit netconvert von SUMO gelesen, das hier fehlt: mit `pip install eclipse-sumo` installieren und neu starten',
    'near-a-place':
      '--around X,Y,RADIUS (im Aufruf: around) liest den Teil im Umkreis von RADIUS Metern um X,Y in den Koordinaten der Datei',
    'network-too-large': (v: Values) => `Mehr als ${v.most} ${v.what}`,
    'nothing-around': (v: Values) =>
      `Keine Spur liegt im Umkreis von ${v.radius_m} um ${v.x}, ${v.y}; die Datei hat x ${v.x_range} und y ${v.y_range}`,
    'no-column': (v: Values) => `Keine Spalte „${v.column}“; die Tabelle hat ${v.columns}`,
    'no-lanelets': 'Keine Lanelets: Ein OpenStreetMap-Auszug wird als osm gelesen',
    'no-open-lanelets':
      'Keine Lanelets mit zwei Seiten, die ein Verkehrsteilnehmer befahren darf: Subtypen und Teilnehmer entscheiden',
    'no-roads-with-lanes': (v: Values) => `Keine Straßen mit Spuren: ${v.words}`,
    'no-projection': (v: Values) => `Die Projektion ist nicht bekannt: ${v.key} der Karte nennt keine UTM-Zone`,
    'no-table': (v: Values) => `Die Datenbank hat keine Tabelle ${v.table}`,
    'not-both': (v: Values) => `Nur ${v.first} oder ${v.second} angeben, nicht beide`,
    'not-read': (v: Values) => `${v.what} wird nicht gelesen`,
    'not-utf8': (v: Values) => `Kein UTF-8 in ${v.what}`,
    'one-of': (v: Values) => `Erwartet: eines von ${v.list}`,
    'one-scene-a-file': 'Eine Datei in diesem Format enthält eine Szene',
    'only-read': (v: Values) => `${v.format} wird gelesen, nicht geschrieben`,
    'only-written': (v: Values) => `${v.format} wird geschrieben, nicht gelesen`,
    'other-kind': (v: Values) => `${v.file} wird nicht gelesen; ${v.instead}`,
    'other-kind-named': (v: Values) =>
      `${v.file} wird nicht gelesen; ${v.instead} (der Name endet auf .${v.end}, der Inhalt ist etwas anderes)`,
    'parser-words': (v: Values) => `Nicht wie erwartet: ${v.words}`,
    'pickle-calls': (v: Values) =>
      `Byte ${v.byte}: Das Pickle verlangt ${v.name}; gelesen werden Zahlen, Texte, Listen und Arrays, aufgerufen wird nichts`,
    'pickle-holds': (v: Values) =>
      `Byte ${v.byte}: ${v.what} gefunden; gelesen werden Zahlen, Texte, Listen und Arrays`,
    'positions-over-limit': (v: Values) =>
      `Mehr als ${v.most} ${v.what} in ${v.within_s}: weniger aufzeichnen (fcd-output.filter-edges.input-file, device.fcd.probability)`,
    'range-outside': (v: Values) => `${v.what}: ${v.found} gefunden, ${v.least} bis ${v.most} erwartet`,
    'road-over-limit': (v: Values) => `Straße „${v.road}“ hat ${v.records} Einträge, zu viele für ihre Länge`,
    'roads-over-memory': (v: Values) =>
      `${v.lanes_m} Spuren und ${v.elements} Elemente brauchen mehr Speicher, als eine Datei dieser Größe darf`,
    'roads-too-far': (v: Values) => `Straßen über ${v.reach_km} km; eine Karte umfasst wenige Kilometer`,
    'too-far-from-start': (v: Values) => `${v.what} liegt ${v.distance_m} vom Start, höchstens ${v.most_m} erwartet`,
    'unequal-columns': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Wert, erwartet werden so viele wie ${v.like} (${v.expected})`,
        other: `${v.count} Werte, erwartet werden so viele wie ${v.like} (${v.expected})`,
      }),
    'unknown-map': 'Der Server hat keine Karte mit diesem Hash: die Karte selbst senden',
    unreadable: (v: Values) => `Nicht als ${v.format} lesbar: ${v.words}`,
    'unsupported-version': (v: Values) => `Version ${v.found} gefunden, bekannt sind Versionen bis ${v.known}`,
    'zip-without': (v: Values) => `Ein ZIP ohne Datei, deren Name auf ${v.first} oder ${v.second} endet`,
  },
};
