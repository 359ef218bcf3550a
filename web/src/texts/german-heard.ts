// What the server says in words, in German: it speaks English alone. A sentence that is not known here stays as it is.
import { german as places } from './german/places';

type Heard = readonly [sentence: RegExp, german: string | ((...said: string[]) => string)];

const ARM = '((?:East|North|West|South)(?:-(?:east|west))?(?: \\d+)?)';
const arm = (english: string): string =>
  english.replace(/^[A-Za-z-]+/, (way) => places.arms[way.toLowerCase() as keyof typeof places.arms] ?? way);
const WHO: Readonly<Record<string, string>> = {
  vehicle: 'dieses Fahrzeug',
  cyclist: 'dieser Radfahrer',
  pedestrian: 'dieser Mensch',
};
const VEHICLES: Readonly<Record<string, string>> = { '12 m bus': '12-m-Bus', '5 m car': '5-m-Auto' };
const vehicle = (english: string): string => VEHICLES[english] ?? english;

const SENTENCES: readonly Heard[] = [
  [/From ([\d.]+ s) on: /, 'Ab $1: '],
  [/Too far for ([\d.]+ s)\. The goal is (\d+ m) away\. /, 'Zu weit für $1. Das Ziel ist $2 entfernt. '],
  [
    /In ([\d.]+ s) from (\S+ \S+) this (\w+) gets (\d+ m) at most\./,
    (_, time, speed, who, way) => `In ${time} kommt ${WHO[who]} aus ${speed} höchstens ${way} weit.`,
  ],
  [
    /Cannot speed up that much in ([\d.]+ s) from (\S+ \S+)\./,
    'So stark zu beschleunigen, geht nicht. Zeit: $1, aus $2.',
  ],
  [/It would take (\S+ m\/s²) sideways\./, 'Nötig wären quer $1.'],
  [/It would take (\S+ m\/s²?)\./, 'Nötig wären $1.'],
  [/Faster than this \w+ can go\./, 'Schneller, als es geht.'],
  [
    /Cannot stop that soon\. From (\S+ \S+) it gets no nearer than (\d+ m), the goal is (\d+ m) away\./,
    'Anhalten geht so bald nicht. Aus $1 braucht es $2, das Ziel ist $3 entfernt.',
  ],
  [/Cannot slow down that much in ([\d.]+ s)\./, 'So stark bremsen geht nicht. Zeit: $1.'],
  [/Too tight at this speed\./, 'Zu eng bei diesem Tempo.'],
  [/Too tight a turn for this \w+\./, 'Die Kurve ist zu eng.'],
  [/Somebody is in the way of this \w+\./, 'Jemand ist im Weg.'],
  [/Road user (\S+) is in the way of this \w+\./, 'Verkehrsteilnehmer $1 ist im Weg.'],
  [/It halts (\d+ m) short of the goal\./, 'Es hält $1 vor dem Ziel.'],
  [/There is no lane within (\d+ m) of the goal\./, 'Bis $1 um das Ziel ist keine Spur.'],
  [/There is no lane within (\d+ m) of the start\./, 'Bis $1 um den Start ist keine Spur.'],
  [/(\d+ m) in ([\d.]+ s) is beyond the top speed\./, '$1 in $2 ist schneller als das Höchsttempo.'],
  [/The start overlaps (\S+)\./, 'Der Start liegt auf Verkehrsteilnehmer $1.'],
  [
    /Via point (\d+) is passed ([\d.]+ m) away at ([\d.]+ s); at most ([\d.]+ m) was asked\./,
    'Zwischenpunkt $1 wird bei $3 um $2 verfehlt; verlangt war höchstens $4.',
  ],
  [
    /Nothing says where it is from ([\d.]+ s) on; taken to go straight on at its speed\./,
    'Ab $1 ist nicht bekannt, wo es ist; angenommen: geradeaus mit gleichem Tempo.',
  ],
  [/^Every lane leads somewhere$/, 'Jede Spur führt weiter'],
  [/^A (12 m bus|5 m car) can turn$/, (_, who) => `Ein ${vehicle(who)} kann abbiegen`],
  [/^Every lane is wide enough$/, 'Jede Spur ist breit genug'],
  [/^Signal phases do not meet$/, 'Ampelphasen widersprechen sich nicht'],
  [/^Lane (\S+) leads nowhere$/, 'Spur $1 führt nirgends hin'],
  [/^Lane (\S+) is reached from nowhere$/, 'Spur $1 ist nicht erreichbar'],
  [/^Lane (\S+) is ([\d.]+ m) wide$/, 'Spur $1 ist $2 breit'],
  [
    / is tight: ([\d.]+ m), a (12 m bus|5 m car) needs ([\d.]+ m)$/,
    (_, is, who, needs) => ` ist eng: ${is}, ein ${vehicle(who)} braucht ${needs}`,
  ],
  [new RegExp(`^${ARM} to ${ARM}(?= ist eng)`), (_, from, to) => `${arm(from)} nach ${arm(to)}`],
  [/^Lane (\S+)(?= ist eng)/, 'Spur $1'],
  [
    new RegExp(`^${ARM} and ${ARM} have green together and meet$`),
    (_, a, b) => `${arm(a)} und ${arm(b)} haben zugleich Grün und treffen sich`,
  ],
];

export const heard = (words: string): string =>
  SENTENCES.reduce(
    (text, [sentence, german]) =>
      typeof german === 'string' ? text.replace(sentence, german) : text.replace(sentence, german),
    words,
  );
