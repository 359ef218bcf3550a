import type { SENTENCES } from '../../messages/file-messages';
import type { Said, Values } from '../../table';
import { plural } from '../plural';

export const german: Said<typeof SENTENCES> = {
  lists: {
    fault: {
      'cut-off': 'die Datei bricht ab',
      'no-value': 'es fehlt ein Wert',
      'no-sign': 'es fehlt ein Komma, ein Doppelpunkt oder eine Klammer',
      comma: 'ein Komma zu viel',
      'text-after': 'nach dem Ende folgt weiterer Text',
      'no-quotes': 'ein Name steht ohne Anführungszeichen',
      number: 'eine Zahl ist ungültig',
      text: 'ein Text ist ungültig',
    },
    what: { lanes: 'Spuren', roads: 'Straßen' },
    subject: { 'road-users': 'Verkehrsteilnehmer', 'map-features': 'Kartenelemente', tracks: 'Trajektorien' },
  },
  sentences: {
    'agents-near-ego': (v: Values) => `${v.found} Verkehrsteilnehmer; die ${v.kept} nächsten am Ego-Fahrzeug bleiben`,
    'agents-near-centre': (v: Values) =>
      `${v.found} Verkehrsteilnehmer; die ${v.kept} nächsten an ihrer Mitte bleiben, bis ${v.within_m} um den Ursprung`,
    'agents-over-limit': (v: Values) => `Die Szene hat ${v.agents} Verkehrsteilnehmer; höchstens ${v.most}.`,
    'agents-with-used-id': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Hindernis mit der Kennung eines anderen entfällt`,
        other: `${v.count} Hindernisse mit der Kennung eines anderen entfallen`,
      }),
    'agents-outside-network': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} von ${v.found} Verkehrsteilnehmern liegt außerhalb des Netzes: Es gehört zu einer anderen Aufzeichnung, oder die Orte stehen in Grad (fcd-output.geo) statt in Metern`,
        other: `${v.count} von ${v.found} Verkehrsteilnehmern liegen außerhalb des Netzes: Es gehört zu einer anderen Aufzeichnung, oder die Orte stehen in Grad (fcd-output.geo) statt in Metern`,
      }),
    'areas-too-far': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} befahrbare Fläche reicht weiter als ${v.within_m} von der Mitte und entfällt`,
        other: `${v.count} befahrbare Flächen reichen weiter als ${v.within_m} von der Mitte und entfallen`,
      }),
    'boxes-across': (v: Values) =>
      plural(Number(v.count), {
        one: `Die lange Seite von ${v.count} Box liegt quer zur Bewegung: möglicherweise sind Länge und Breite vertauscht`,
        other: `Die langen Seiten von ${v.count} Boxen liegen quer zur Bewegung: möglicherweise sind Länge und Breite vertauscht`,
      }),
    'columns-recognised': (v: Values) =>
      `Die Spalten werden als die des Datensatzes ${v.sets} gelesen; --columns nennt andere`,
    'agents-table-missing': 'Die Tabelle der Verkehrsteilnehmer fehlt, die ihre Arten nennt',
    'recording-table-missing': 'Die Tabelle der Aufzeichnung fehlt, die Bildrate, Tempolimit und Ort nennt',
    'rows-in-part': (v: Values) =>
      `Die Tabelle hat ${v.found} Zeilen, mehr, als auf einmal gelesen werden: Gelesen sind die ${v.kept} Zeilen vor ${v.before_s} s. „only“ in einer Spaltendatei wählt einen anderen Teil nach time_s oder agent_id`,
    'files-beside': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Datei desselben Ordners wird mit der Tabelle gelesen: ${v.names}`,
        other: `${v.count} Dateien desselben Ordners werden mit der Tabelle gelesen: ${v.names}`,
      }),
    'map-unread': (v: Values) => `Die Karte ${v.name} ist nicht lesbar: ${v.why}`,
    'map-chosen': (v: Values) => `Von ${v.maps} Karten hat die von ${v.name} die meisten Fahrzeuge auf ihren Spuren`,
    'speed-limit-of-recording': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spur ohne Tempolimit hat das der Aufzeichnung, ${v.limit_mps} m/s`,
        other: `${v.count} Spuren ohne Tempolimit haben das der Aufzeichnung, ${v.limit_mps} m/s`,
      }),
    'columns-missing': (v: Values) =>
      `Keine Spalte ${v.missing}; die Tabelle hat ${v.columns}. Eine Datei mit Spalten kann sie benennen.`,
    'crossing-areas': 'Befahrbare Flächen überlappen sich zu oft, um die Ränder der Straße zu bestimmen',
    'crossing-lanelets': 'Lanelets überlappen sich zu oft, um die Ränder der Straße zu bestimmen',
    'crossing-roads': 'Straßen überlappen sich zu oft, um ihre Ränder zu bestimmen',
    'cut-around': (v: Values) =>
      `Umkreis von ${v.radius_m} um ${v.x}, ${v.y}: Spuren behalten ${v.kept}, davon am Kreis endend ${v.ended}; außerhalb ${v.what} ${v.outside}`,
    'cut-in-scenes': (v: Values) =>
      `Die Aufzeichnung ist länger als eine Szene: Sie wird in Szenen von ${v.each_s} geteilt`,
    'unread-by-place': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Element wird nicht gelesen: ${v.places}`,
        other: `${v.count} Elemente werden nicht gelesen: ${v.places}`,
      }),
    'unread-places': (v: Values) => `${v.all} Elemente werden nicht gelesen: ${v.places} und ${v.more} weitere`,
    'elements-unread': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Element, das eine Szene nicht darstellen kann, entfällt`,
        other: `${v.count} Elemente, die eine Szene nicht darstellen kann, entfallen`,
      }),
    'empty-file': 'Die Datei ist leer',
    'features-unread': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Kartenelement unbekannter Art oder mit zu wenigen Punkten entfällt`,
        other: `${v.count} Kartenelemente unbekannter Art oder mit zu wenigen Punkten entfallen`,
      }),
    'futures-unread': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Zukunft ist leer, unmöglich oder über der Grenze und entfällt`,
        other: `${v.count} Zukünfte sind leer, unmöglich oder über der Grenze und entfallen`,
      }),
    'goals-beyond-first': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} weiteres Ziel desselben Verkehrsteilnehmers entfällt`,
        other: `${v.count} weitere Ziele derselben Verkehrsteilnehmer entfallen`,
      }),
    'goals-are-regions': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Ziel ist eine Fläche; verwendet wird ihre Mitte`,
        other: `${v.count} Ziele sind Flächen; verwendet wird ihre Mitte`,
      }),
    'headings-derived': 'Richtungen sind aus der Bewegung bestimmt; im Stand bleibt die letzte Richtung',
    'headings-along-degrees': (v: Values) =>
      `Richtungen stehen in Grad und wurden in Radiant umgerechnet: ${v.agree} von ${v.moving} bewegten Verkehrsteilnehmern folgen ihnen`,
    'headings-along-radians': (v: Values) =>
      `Richtungen stehen in Radiant, wo Grad üblich sind: ${v.agree} von ${v.moving} bewegten Verkehrsteilnehmern folgen ihnen`,
    'headings-in-degrees': (v: Values) =>
      `Richtungen wurden aus Grad umgerechnet: In Radiant wären die von ${v.outside} von ${v.found} Verkehrsteilnehmern größer als eine volle Umdrehung, oder das Format verwendet Grad`,
    'headings-wrapped': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Richtung überschreitet eine volle Umdrehung und wurde umgerechnet`,
        other: `${v.count} Richtungen überschreiten eine volle Umdrehung und wurden umgerechnet`,
      }),
    'ids-renumbered': 'Spuren und Kreuzungen haben Nummern statt der Kennungen von SUMO',
    'ids-replaced': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Kennung (${v.subject}) wurde ersetzt: Eine Kennung kommt nur einmal vor und besteht aus Buchstaben, Ziffern und _ . : -`,
        other: `${v.count} Kennungen (${v.subject}) wurden ersetzt: Eine Kennung kommt nur einmal vor und besteht aus Buchstaben, Ziffern und _ . : -`,
      }),
    'ids-respelled': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Kennung wurde anders geschrieben oder ergänzt`,
        other: `${v.count} Kennungen wurden anders geschrieben oder ergänzt`,
      }),
    'ids-suffixed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} wiederholte Kennung (${v.subject}) erhielt einen Zusatz`,
        other: `${v.count} wiederholte Kennungen (${v.subject}) erhielten einen Zusatz`,
      }),
    'identities-joined': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer hatte eine zweite Kennung und wurde zusammengeführt: ${v.pairs} (und ${v.more} weitere)`,
        other: `${v.count} Verkehrsteilnehmer hatten eine zweite Kennung und wurden zusammengeführt: ${v.pairs} (und ${v.more} weitere)`,
      }),
    'identities-joined-all': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer hatte eine zweite Kennung und wurde zusammengeführt: ${v.pairs}`,
        other: `${v.count} Verkehrsteilnehmer hatten eine zweite Kennung und wurden zusammengeführt: ${v.pairs}`,
      }),
    jumps: (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count}-mal wurde ein Verkehrsteilnehmer teleportiert; diese Lücke bleibt`,
        other: `${v.count}-mal wurde ein Verkehrsteilnehmer teleportiert; diese Lücken bleiben`,
      }),
    'json-array': 'Die Datei ist eine JSON-Liste; eine Szene ist ein JSON-Objekt mit dem Format dragtraffic.scene',
    'lanelets-unusable': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Lanelet ohne zwei Seiten oder nicht für Verkehr entfällt`,
        other: `${v.count} Lanelets ohne zwei Seiten oder nicht für Verkehr entfallen`,
      }),
    'lanelets-with-used-id': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Lanelet mit der Kennung eines anderen entfällt`,
        other: `${v.count} Lanelets mit der Kennung eines anderen entfallen`,
      }),
    'lanes-bordered': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spur (${Math.round(Number(v.length_m))} m) hat Ränder in einem Abschnitt mit Breiten, die nach der Norm gelten: Ihre Ränder entfallen`,
        other: `${v.count} Spuren (${Math.round(Number(v.length_m))} m) haben Ränder in Abschnitten mit Breiten, die nach der Norm gelten: Ihre Ränder entfallen`,
      }),
    'lanes-closed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spur, die kein Verkehrsteilnehmer benutzen darf (Gleise, Streifen), entfällt`,
        other: `${v.count} Spuren, die kein Verkehrsteilnehmer benutzen darf (Gleise, Streifen), entfallen`,
      }),
    'json-syntax': (v: Values) => `Kein gültiges JSON: ${v.fault}.`,
    'lane-links-derived': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spurverbindung fehlt in der Datei: Eine Spur, die endet, wo eine andere beginnt, wird mit ihr verbunden`,
        other: `${v.count} Spurverbindungen fehlen in der Datei: Eine Spur, die endet, wo eine andere beginnt, wird mit ihr verbunden`,
      }),
    'lane-segments-unusable': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spurabschnitt ohne zwei Seiten entfällt`,
        other: `${v.count} Spurabschnitte ohne zwei Seiten entfallen`,
      }),
    'lanes-shared': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Straße für beide Richtungen ist eine Spur breit: Beide fahren in ihrer Mitte`,
        other: `${v.count} Straßen für beide Richtungen sind eine Spur breit: Beide fahren in ihrer Mitte`,
      }),
    'lanes-without-line': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spur ohne Mittellinie entfällt`,
        other: `${v.count} Spuren ohne Mittellinie entfallen`,
      }),
    'left-hand': 'Es herrscht Linksverkehr, wie in dieser Gegend üblich',
    'left-hand-network': 'Es herrscht Linksverkehr, wie das Netz angibt',
    'lines-thinned': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Linie hat mehr Punkte, als eine Szene fasst, und wird ausgedünnt`,
        other: `${v.count} Linien haben mehr Punkte, als eine Szene fasst, und werden ausgedünnt`,
      }),
    'links-apart': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spurverbindung entfällt: Die Enden liegen mehr als eine Spurbreite auseinander`,
        other: `${v.count} Spurverbindungen entfallen: Die Enden liegen mehr als eine Spurbreite auseinander`,
      }),
    'links-turned': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Spurverbindung führt rückwärts: Sie wurde so gedreht, wie die Spuren aneinanderstoßen`,
        other: `${v.count} Spurverbindungen führen rückwärts: Sie wurden so gedreht, wie die Spuren aneinanderstoßen`,
      }),
    'lines-approximated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Markierung hat eine Art oder Farbe, die es in einer Szene nicht gibt`,
        other: `${v.count} Markierungen haben eine Art oder Farbe, die es in einer Szene nicht gibt`,
      }),
    'loss-lane-lines': (v: Values) =>
      plural(Number(v.count), {
        one: `Spuren sind Polylinien auf ${v.off_mm} mm genau, und der Anfang von ${v.count} ist eine Verbindungsstraße`,
        other: `Spuren sind Polylinien auf ${v.off_mm} mm genau, und die Anfänge von ${v.count} sind Verbindungsstraßen`,
      }),
    'loss-lane-points': (v: Values) =>
      `Spuren liegen auf ${v.off_mm} mm genau an ihren Linien, wenn ihre Punkte neu gesetzt werden; Haltlinien und Stoppschilder stehen am Anfang und Ende von Spuren`,
    'loss-lanes-without-length': (v: Values) =>
      plural(Number(v.count), { one: `${v.count} Spur ohne Länge`, other: `${v.count} Spuren ohne Länge` }),
    'loss-lights-over-room': (v: Values) => `ein Datensatz fasst ${v.most} Ampeln je Schritt`,
    'loss-lines-sampled': (v: Values) =>
      `Linien als Punkte im Abstand von ${v.apart_m}, ohne Spurgraph und Tempolimits`,
    'loss-longer': (v: Values) => `nichts ist gekürzt: ${v.steps} Schritte, wo die Szene ${v.known} hat`,
    'loss-motion-extrapolated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Bewegung endet früher und geht geradeaus weiter`,
        other: `${v.count} Bewegungen enden früher und gehen geradeaus weiter`,
      }),
    'loss-points-over-room': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Kartenpunkt; ein Datensatz fasst ${v.most}`,
        other: `${v.count} Kartenpunkte; ein Datensatz fasst ${v.most}`,
      }),
    'loss-rollouts': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} von ${v.most} Verläufen der Challenge: erst so viele Varianten erzeugen`,
        other: `${v.count} von ${v.most} Verläufen der Challenge: erst so viele Varianten erzeugen`,
      }),
    'loss-single-precision': (v: Values) => `Zahlen in einfacher Genauigkeit: Abweichung bis ${v.off_um} µm`,
    'loss-steps-over-room': (v: Values) =>
      `Zustände mehr als ${v.past} Schritte vor dem aktuellen oder ${v.future} danach`,
    'loss-users-off-lanes': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer auf keiner eigenen Spur steht nur in der Aufzeichnung`,
        other: `${v.count} Verkehrsteilnehmer auf keiner eigenen Spur stehen nur in der Aufzeichnung`,
      }),
    'loss-users-over-room': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer; ein Datensatz fasst ${v.most}`,
        other: `${v.count} Verkehrsteilnehmer; ein Datensatz fasst ${v.most}`,
      }),
    'map-fault': (v: Values) => `${v.first}`,
    'map-faults': (v: Values) => `${v.first} (und ${v.more} weitere)`,
    'map-heights-dropped': 'Das Netz hat Höhen; die Karte ist eben',
    'map-lacks-lanelets': 'Die Datei hat keine Lanelets: Die Szene hat keine Karte',
    'map-missing': 'Zum Szenario fehlt die Karte (log_map_archive_*.json): Die Szene hat keine Spuren',
    'map-elsewhere': (v: Values) =>
      `Nur ${v.percent} % der Fahrzeugpositionen liegen auf Spuren der Karte: Sie gehört zu einem anderen Ort oder Bezugssystem`,
    'map-laid': (v: Values) => `${v.percent} % der Fahrzeugpositionen liegen auf Spuren der Karte`,
    'moved-by-metadrive': 'MetaDrive hat die Datei verschoben und gedreht; der Ort der Aufzeichnung ist unbekannt',
    'network-missing': 'Zur Aufzeichnung fehlt das Netz: Die Szene hat weder Spuren noch Ampeln',
    'not-a-known-format': (v: Values) => `Keine Datei eines bekannten Formats (${v.formats}).`,
    'now-step-moved': (v: Values) => `Der aktuelle Schritt ist ${v.now} von ${v.steps}: Genommen wird der letzte`,
    'obstacles-absent': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Hindernis kommt in keinem behaltenen Schritt vor`,
        other: `${v.count} Hindernisse kommen in keinem behaltenen Schritt vor`,
      }),
    'obstacles-are-sets': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Hindernis hat mögliche Flächen statt einer Bewegung: Sein erster Zustand bleibt`,
        other: `${v.count} Hindernisse haben mögliche Flächen statt einer Bewegung: Ihr erster Zustand bleibt`,
      }),
    'obstacles-uncertain': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Hindernis hat unsichere Zustände; verwendet wird die Mitte`,
        other: `${v.count} Hindernisse haben unsichere Zustände; verwendet wird die Mitte`,
      }),
    'obstacles-unplaced': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Hindernis ohne Ort oder ohne Größe bis 60 m entfällt`,
        other: `${v.count} Hindernisse ohne Ort oder ohne Größe bis 60 m entfallen`,
      }),
    'parts-left-out': (v: Values) => `Entfallen: ${v.parts}`,
    'passengers-left-out': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Container oder Fahrgast entfällt`,
        other: `${v.count} Container und Fahrgäste entfallen`,
      }),
    'points-out-of-range': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Punkt; ${v.least} bis ${v.most} erwartet`,
        other: `${v.count} Punkte; ${v.least} bis ${v.most} erwartet`,
      }),
    'programs-beyond-last': 'Eine Ampel hat mehrere Programme; gezeigt wird das letzte',
    'recording-heights-dropped': 'Die Aufzeichnung hat Höhen; die Szene ist eben',
    'rows-repeated': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Zeile wiederholt einen Verkehrsteilnehmer zur selben Zeit; je Zeit bleibt eine Zeile`,
        other: `${v.count} Zeilen wiederholen einen Verkehrsteilnehmer zur selben Zeit; je Zeit bleibt eine Zeile`,
      }),
    'shapes-boxed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Hindernis ist kein Rechteck: Verwendet wird das umschließende Rechteck`,
        other: `${v.count} Hindernisse sind keine Rechtecke: Verwendet werden die umschließenden Rechtecke`,
      }),
    'signal-links-unprogrammed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Signalverbindung ohne Programm entfällt`,
        other: `${v.count} Signalverbindungen ohne Programm entfallen`,
      }),
    'signals-empty': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Ampel ohne Spur oder ohne Phasen entfällt`,
        other: `${v.count} Ampeln ohne Spur oder ohne Phasen entfallen`,
      }),
    'signals-held': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Ampel ist verkehrsabhängig; sie behält die Zeiten ihres Plans`,
        other: `${v.count} Ampeln sind verkehrsabhängig; sie behalten die Zeiten ihres Plans`,
      }),
    'signals-made': (v: Values) =>
      plural(Number(v.junctions), {
        one: `Die Signalgeber an ${v.junctions} Kreuzung (${v.count}) haben kein Programm; sie erhielten Festzeiten`,
        other: `Die Signalgeber an ${v.junctions} Kreuzungen (${v.count}) haben kein Programm; sie erhielten Festzeiten`,
      }),
    'signals-made-near': (v: Values) =>
      plural(Number(v.junctions), {
        one: `Die Signalgeber an ${v.junctions} Kreuzung (${v.count}) haben kein Programm; sie erhielten Festzeiten, und die ${v.kept} nächsten an der Mitte bleiben`,
        other: `Die Signalgeber an ${v.junctions} Kreuzungen (${v.count}) haben kein Programm; sie erhielten Festzeiten, und die ${v.kept} nächsten an der Mitte bleiben`,
      }),
    'signals-near-centre': (v: Values) => `${v.found} Ampeln; die ${v.kept} nächsten an der Mitte bleiben`,
    'signals-over-limit': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Ampel über der Grenze von ${v.kept} entfällt`,
        other: `${v.count} Ampeln über der Grenze von ${v.kept} entfallen`,
      }),
    'signals-without-lane': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Ampel regelt keine Spur der Karte und entfällt`,
        other: `${v.count} Ampeln regeln keine Spur der Karte und entfallen`,
      }),
    'sizes-assumed': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer hat die übliche Größe seiner Art`,
        other: `${v.count} Verkehrsteilnehmer haben die übliche Größe ihrer Art`,
      }),
    'sizes-assumed-by-name': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer hat die übliche Größe zum Namen seiner Art`,
        other: `${v.count} Verkehrsteilnehmer haben die übliche Größe zum Namen ihrer Art`,
      }),
    'sizes-assumed-car': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Planungsaufgabe nennt keine Größe: Genommen wird die eines Pkw`,
        other: `${v.count} Planungsaufgaben nennen keine Größe: Genommen wird die eines Pkw`,
      }),
    'sizes-vary-median': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer ändert seine Größe; der Median bleibt`,
        other: `${v.count} Verkehrsteilnehmer ändern ihre Größe; der Median bleibt`,
      }),
    'sizes-vary-now': (v: Values) =>
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer ändert seine Größe; die des aktuellen Schritts bleibt`,
        other: `${v.count} Verkehrsteilnehmer ändern ihre Größe; die des aktuellen Schritts bleibt`,
      }),
    'steps-beyond-limit': (v: Values) =>
      `Die Datei dauert ${v.length_s}; die ersten ${v.kept} Schritte von 0,1 s bleiben`,
    'steps-coarse': (v: Values) =>
      `Die Zeitschritte liegen ${v.apart_s} auseinander; Lücken über ${v.filled_s} bleiben`,
    'stop-points-vary': 'Eine Ampel hat mehrere Haltepunkte; der erste bleibt',
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
      plural(Number(v.count), {
        one: `${v.count} Verkehrsteilnehmer ist von unbekannter Art; er wird gezeigt, aber nicht neu berechnet`,
        other: `${v.count} Verkehrsteilnehmer sind von unbekannter Art; sie werden gezeigt, aber nicht neu berechnet`,
      }),
    'velocities-derived': 'Geschwindigkeiten sind aus Orten und Zeiten bestimmt',
  },
};
