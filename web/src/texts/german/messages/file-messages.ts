import type { SENTENCES } from '../../messages/file-messages';
import type { Said, Values } from '../../table';

export const german: Said<typeof SENTENCES> = {
  lists: {
    subject: { 'road-users': 'Verkehrsteilnehmer', 'map-features': 'Kartenelemente', tracks: 'Spuren der Aufnahme' },
  },
  sentences: {
    'agents-near-ego': (v: Values) => `${v.found} Verkehrsteilnehmer; die ${v.kept} nächsten am Ego-Fahrzeug bleiben`,
    'agents-near-centre': (v: Values) =>
      `${v.found} Verkehrsteilnehmer; die ${v.kept} nächsten an ihrer Mitte bleiben, bis ${v.within_m} um den Ursprung`,
    'agents-with-used-id': (v: Values) => `${v.count} Hindernisse mit der Kennung eines anderen entfallen`,
    'agents-outside-network': (v: Values) =>
      `${v.count} von ${v.found} Verkehrsteilnehmern liegen außerhalb des Netzes: Es gehört zu einer anderen Aufnahme, oder die Orte sind Grad (fcd-output.geo) statt Meter`,
    'areas-too-far': (v: Values) =>
      `${v.count} befahrbare Flächen reichen weiter als ${v.within_m} von der Mitte und entfallen`,
    'crossing-areas': 'Befahrbare Flächen überlappen sich zu oft, um die Ränder der Straße zu finden',
    'crossing-lanelets': 'Lanelets überlappen sich zu oft, um die Ränder der Straße zu finden',
    'crossing-roads': 'Straßen überlappen sich zu oft, um ihre Ränder zu finden',
    'cut-in-scenes': (v: Values) =>
      `Die Aufnahme ist länger als eine Szene: Sie wird in Szenen von ${v.each_s} geteilt`,
    'elements-unread': (v: Values) => `${v.count} Elemente haben in einer Szene keinen Platz und entfallen`,
    'features-unread': (v: Values) => `${v.count} Kartenelemente unbekannter Art oder mit zu wenigen Punkten entfallen`,
    'futures-unread': (v: Values) => `${v.count} mögliche Bewegungen sind leer, unmöglich oder zu viele und entfallen`,
    'goals-beyond-first': (v: Values) => `${v.count} weitere Ziele derselben Verkehrsteilnehmer entfallen`,
    'goals-are-regions': (v: Values) => `${v.count} Ziele sind Flächen; genommen wird ihre Mitte`,
    'headings-derived': 'Richtungen sind aus der Bewegung bestimmt; im Stand bleibt die letzte Richtung',
    'headings-in-degrees': 'Richtungen stehen in Grad und wurden in Radiant umgerechnet',
    'ids-renumbered': 'Spuren und Kreuzungen haben Nummern statt der Kennungen von SUMO',
    'ids-replaced': (v: Values) =>
      `${v.count} ${v.subject} erhielten andere Kennungen: Eine Kennung kommt nur einmal vor und besteht aus Buchstaben, Ziffern und _ . : -`,
    'ids-respelled': (v: Values) => `${v.count} Kennungen wurden anders geschrieben oder ergänzt`,
    'ids-suffixed': (v: Values) => `${v.count} ${v.subject} mit wiederholter Kennung erhielten einen Zusatz`,
    'identities-joined': (v: Values) =>
      `${v.count} Verkehrsteilnehmer hatten eine zweite Kennung und sind vereint: ${v.pairs} (und ${v.more} weitere)`,
    'identities-joined-all': (v: Values) =>
      `${v.count} Verkehrsteilnehmer hatten eine zweite Kennung und sind vereint: ${v.pairs}`,
    jumps: (v: Values) => `${v.count}-mal wurde ein Verkehrsteilnehmer versetzt; diese Lücken bleiben`,
    'lanelets-unusable': (v: Values) => `${v.count} Lanelets ohne zwei Seiten oder nicht für Verkehr entfallen`,
    'lanelets-with-used-id': (v: Values) => `${v.count} Lanelets mit der Kennung eines anderen entfallen`,
    'lanes-closed': (v: Values) => `${v.count} Spuren, die niemandem offenstehen (Gleise, Streifen), entfallen`,
    'lane-links-derived':
      'Die Datei verbindet ihre Spuren nicht: Eine Spur, die endet, wo eine andere beginnt, wird mit ihr verbunden',
    'lane-segments-unusable': (v: Values) => `${v.count} Spurabschnitte ohne zwei Seiten entfallen`,
    'left-hand': 'Es herrscht Linksverkehr, wie in dieser Gegend üblich',
    'left-hand-as-right': 'Es herrscht Linksverkehr; Borde und Mittellinien sind wie bei Rechtsverkehr gezeichnet',
    'lines-approximated': (v: Values) => `${v.count} Markierungen haben eine Art oder Farbe ohne eigenes Wort`,
    'map-fault': (v: Values) => `${v.first}`,
    'map-faults': (v: Values) => `${v.first} (und ${v.more} weitere)`,
    'map-heights-dropped': 'Das Netz hat Höhen; die Karte ist eben',
    'map-lacks-lanelets': 'Die Datei hat keine Lanelets: Die Szene hat keine Karte',
    'map-missing': 'Zum Szenario kam keine Karte (log_map_archive_*.json): Die Szene hat keine Spuren',
    'moved-by-metadrive': 'MetaDrive hat die Datei verschoben und gedreht; der Ort der Aufnahme ist unbekannt',
    'network-missing': 'Zur Aufnahme kam kein Netz: Die Szene hat weder Spuren noch Ampeln',
    'now-step-moved': (v: Values) => `Der aktuelle Schritt ist ${v.now} von ${v.steps}: Genommen wird der letzte`,
    'obstacles-absent': (v: Values) => `${v.count} Hindernisse sind in keinem behaltenen Schritt da`,
    'obstacles-are-sets': (v: Values) =>
      `${v.count} Hindernisse haben mögliche Flächen statt einer Bewegung: Ihr erster Zustand bleibt`,
    'obstacles-uncertain': (v: Values) => `${v.count} Hindernisse haben unsichere Zustände; genommen wird die Mitte`,
    'obstacles-unplaced': (v: Values) => `${v.count} Hindernisse ohne Ort oder ohne Größe bis 60 m entfallen`,
    'parts-left-out': (v: Values) => `Entfallen: ${v.parts}`,
    'passengers-left-out': (v: Values) => `${v.count} Container und Fahrgäste entfallen bisher`,
    'programs-beyond-last': 'Eine Ampel hat mehrere Programme; gezeigt wird das letzte',
    'projection-dropped': 'Orte bleiben im Bezugssystem des Netzes; seine Projektion geht verloren',
    'recording-heights-dropped': 'Die Aufnahme hat Höhen; die Szene ist eben',
    'shapes-boxed': (v: Values) => `${v.count} Hindernisse sind keine Rechtecke: Genommen werden Rechtecke um sie`,
    'signal-links-unprogrammed': (v: Values) => `${v.count} Signalverbindungen ohne Programm entfallen`,
    'signals-empty': (v: Values) => `${v.count} Ampeln ohne Spur oder ohne Zustände entfallen`,
    'signals-held': (v: Values) => `${v.count} Ampeln sind verkehrsabhängig; sie behalten die Zeiten ihres Plans`,
    'signals-made': (v: Values) =>
      `${v.count} Signalgeber an ${v.junctions} Kreuzungen haben kein Programm; sie erhielten Festzeiten`,
    'signals-made-near': (v: Values) =>
      `${v.count} Signalgeber an ${v.junctions} Kreuzungen haben kein Programm; sie erhielten Festzeiten, und die ${v.kept} nächsten an der Mitte bleiben`,
    'signals-near-centre': (v: Values) => `${v.found} Ampeln; die ${v.kept} nächsten an der Mitte bleiben`,
    'signals-over-limit': (v: Values) => `${v.count} Ampeln über der Grenze von ${v.kept} entfallen`,
    'signals-without-lane': (v: Values) => `${v.count} Ampeln regeln keine Spur der Karte und entfallen`,
    'sizes-assumed': (v: Values) => `${v.count} Verkehrsteilnehmer haben die übliche Größe ihrer Art`,
    'sizes-assumed-by-name': (v: Values) => `${v.count} Verkehrsteilnehmer haben die übliche Größe zum Namen ihrer Art`,
    'sizes-assumed-car': (v: Values) => `${v.count} Planungsaufgaben nennen keine Größe: Genommen wird die eines Pkw`,
    'sizes-vary-median': (v: Values) => `${v.count} Verkehrsteilnehmer ändern ihre Größe; der Median bleibt`,
    'sizes-vary-now': (v: Values) =>
      `${v.count} Verkehrsteilnehmer ändern ihre Größe; die des aktuellen Schritts bleibt`,
    'steps-beyond-limit': (v: Values) =>
      `Die Datei dauert ${v.length_s}; die ersten ${v.kept} Schritte von 0,1 s bleiben`,
    'steps-coarse': (v: Values) =>
      `Die Zeitschritte liegen ${v.apart_s} auseinander; Lücken über ${v.filled_s} bleiben Lücken`,
    'stop-points-vary': 'Eine Ampel hat mehrere Haltepunkte; ihr erster bleibt',
    'time-resampled': (v: Values) =>
      `Die Zeilen liegen ${v.apart_s} auseinander; Zustände werden alle ${v.step_s} berechnet`,
    'time-interpolated': (v: Values) =>
      `Die Schritte liegen ${v.apart_s} auseinander; Zustände alle 0,1 s sind linear interpoliert`,
    'times-ignored': (v: Values) =>
      `${v.found} Zeiten für ${v.steps} Schritte, oder eine Zeit ist nicht endlich; angenommen werden Schritte von 0,1 s`,
    'times-incomplete': 'Manche Schritte haben keine Zeit; angenommen werden Schritte von 0,1 s',
    'times-irregular': 'Die Schritte liegen nicht 0,1 s auseinander; sie werden so gelesen',
    'types-assumed': 'Die Tabelle nennt keine Arten; alle Verkehrsteilnehmer gelten als Fahrzeuge',
    'types-unknown': (v: Values) =>
      `${v.count} Verkehrsteilnehmer sind von unbekannter Art; sie werden gezeigt und nie erzeugt`,
    'velocities-derived': 'Geschwindigkeiten sind aus Orten und Zeiten bestimmt',
  },
};
