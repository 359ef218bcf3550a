// Questions of the page to the generator and their answers, observed from outside the page.

/** An event with its compact futures expanded to the columns of a scene document: numbers are summed twice. */
function inColumns(event) {
  const summed = (numbers, perUnit) => {
    let [value, change] = [0, 0];
    return numbers.map((n, i) => {
      if (i) value += change += n;
      else value = n;
      return value / perUnit;
    });
  };
  const mode = ({ x_mm, y_mm, heading_e4rad, vx_mmps, vy_mmps, ...rest }) => ({
    ...rest,
    x_m: summed(x_mm, 1e3),
    y_m: summed(y_mm, 1e3),
    heading_rad: summed(heading_e4rad, 1e4),
    vx_mps: summed(vx_mmps, 1e3),
    vy_mps: summed(vy_mmps, 1e3),
  });
  const futures = ({ compact, ...rest }) => (compact ? { ...rest, modes: compact.map(mode) } : rest);
  const all = (agents) => Object.fromEntries(Object.entries(agents).map(([id, f]) => [id, futures(f)]));
  if (event.samples) return { ...event, samples: event.samples.map((s) => ({ ...s, agents: all(s.agents) })) };
  return event.agents ? { ...event, agents: all(event.agents) } : event;
}

/** One `POST /v1/generate`. Times are seconds of the browser's monotonic clock. */
class Asked {
  #body = null;

  constructor(id, sent, text) {
    this.id = id;
    this.sent = sent;
    this.text = text;
    this.ended = null;
    this.head = Buffer.alloc(0);
    this.tail = [];
    this.chunks = [];
    this.whole = null;
    /** Ended, and its data has been fetched from the browser. */
    this.read = false;
  }

  get body() {
    return (this.#body ??= JSON.parse(this.text));
  }

  /** Size of the request and of its answer so far, bytes. */
  get weight() {
    return { request: Buffer.byteLength(this.text), answer: this.chunks.reduce((sum, c) => sum + c.bytes, 0) };
  }

  /** The complete events, each with the arrival time of its last byte. */
  events() {
    const text = this.whole ?? Buffer.concat([this.head, ...this.tail]);
    const out = [];
    let from = 0;
    for (let end; (end = text.indexOf(10, from)) >= 0; from = end + 1) {
      if (end > from)
        out.push({ ...inColumns(JSON.parse(text.subarray(from, end).toString())), at: this.#arrival(end + 1) });
    }
    return out;
  }

  #arrival(bytes) {
    let sum = 0;
    for (const c of this.chunks) {
      sum += c.bytes;
      if (sum >= bytes) return c.at;
    }
    return this.ended;
  }

  event(name) {
    return this.events().find((e) => e.event === name);
  }
}

/** A worker of the page; its messages are nested in those of the page. */
class Worker {
  #count = 0;
  #asked = new Map();
  #heard = new Map();

  constructor(cdp, sessionId) {
    this.cdp = cdp;
    this.sessionId = sessionId;
  }

  on(method, handler) {
    this.#heard.set(method, handler);
  }

  async send(method, params = {}) {
    const id = ++this.#count;
    const message = JSON.stringify({ id, method, params });
    const answered = new Promise((done, fail) => this.#asked.set(id, { done, fail }));
    answered.catch(() => undefined);
    await this.cdp.send('Target.sendMessageToTarget', { sessionId: this.sessionId, message });
    return answered;
  }

  hear(message) {
    const { id, method, params, result, error } = JSON.parse(message);
    if (method) return this.#heard.get(method)?.(params);
    const asked = this.#asked.get(id);
    this.#asked.delete(id);
    if (error) asked?.fail(new Error(error.message));
    else asked?.done(result);
  }
}

/** `all`: questions and answers in full. `times`: questions, and times of answers. */
export class Wire {
  asked = [];
  /** Transferred bytes so far, as compressed. */
  bytes = 0;
  #listening = 'all';

  /** Listens to a page and to its workers, which send the questions; `listening` is `all`, `times` or `nothing`. */
  static async on(cdp, listening = 'all') {
    const w = new Wire();
    w.#listening = listening;
    if (listening === 'nothing') return w;
    const workers = new Map();
    cdp.on('Target.attachedToTarget', ({ sessionId }) => {
      const worker = new Worker(cdp, sessionId);
      workers.set(sessionId, worker);
      const followed = w.#follow(worker).finally(() => worker.send('Runtime.runIfWaitingForDebugger'));
      // A worker that starts while its page closes cannot be followed; where one should be, its questions are missed.
      followed.catch(() => undefined);
    });
    cdp.on('Target.detachedFromTarget', ({ sessionId }) => workers.delete(sessionId));
    cdp.on('Target.receivedMessageFromTarget', ({ sessionId, message }) => workers.get(sessionId)?.hear(message));
    // A worker waits until listening has started.
    await cdp.send('Target.setAutoAttach', { autoAttach: true, waitForDebuggerOnStart: true, flatten: false });
    await w.#follow(cdp);
    return w;
  }

  /** Follows the questions and answers of one thread. */
  #follow(thread) {
    const of = (e) => this.asked.find((a) => a.id === e.requestId);
    thread.on('Network.requestWillBeSent', (e) => {
      if (e.request.method === 'POST' && new URL(e.request.url).pathname === '/v1/generate')
        this.asked.push(new Asked(e.requestId, e.timestamp, e.request.postData ?? '{}'));
    });
    thread.on('Network.responseReceived', (e) => {
      const a = of(e);
      if (!a) return;
      a.status = e.response.status;
      if (this.#listening === 'times') return;
      void thread.send('Network.streamResourceContent', { requestId: e.requestId }).then(
        (r) => {
          a.head = Buffer.from(r.bufferedData, 'base64');
        },
        () => undefined,
      );
    });
    thread.on('Network.dataReceived', (e) => {
      const a = of(e);
      if (!a) return;
      a.chunks.push({ at: e.timestamp, bytes: e.dataLength });
      if (e.data) a.tail.push(Buffer.from(e.data, 'base64'));
    });
    thread.on('Network.loadingFinished', (e) => {
      this.bytes += e.encodedDataLength;
      const a = of(e);
      if (!a) return;
      a.ended = e.timestamp;
      if (this.#listening === 'times') {
        a.read = true;
        return;
      }
      // A quick answer may end before its stream can be followed.
      void thread
        .send('Network.getResponseBody', { requestId: e.requestId })
        .then(
          (r) => {
            a.whole = Buffer.from(r.body, r.base64Encoded ? 'base64' : 'utf8');
          },
          () => undefined,
        )
        .finally(() => {
          a.read = true;
        });
    });
    thread.on('Network.loadingFailed', (e) => {
      const a = of(e);
      if (a) {
        a.ended = e.timestamp;
        a.read = true;
      }
    });
    this.#overLines(thread);
    return thread.send('Network.enable', { maxPostDataSize: 1 << 24 });
  }

  /** The same for questions over a persistent connection: a message each, and pieces of answers by its number. */
  #overLines(thread) {
    const open = new Map();
    /** Connections for other things than questions. */
    const others = new Set();
    const end = (id, timestamp) => {
      Object.assign(open.get(id), { ended: timestamp, read: true });
      open.delete(id);
    };
    thread.on('Network.webSocketCreated', ({ requestId, url }) => {
      if (new URL(url).pathname !== '/v1/generate') others.add(requestId);
    });
    thread.on('Network.webSocketFrameSent', ({ requestId, timestamp, response: { payloadData } }) => {
      if (others.has(requestId)) return;
      const said = JSON.parse(payloadData);
      const id = `${requestId}/${said.ask ?? said.end}`;
      if (said.body) {
        const text = payloadData.slice(payloadData.indexOf('{', 1), -1);
        const asked = new Asked(id, timestamp, text);
        this.asked.push(asked);
        open.set(id, asked);
      } else if (open.has(id)) end(id, timestamp);
    });
    thread.on('Network.webSocketFrameReceived', ({ requestId, timestamp, response: { opcode, payloadData } }) => {
      if (opcode !== 1 || others.has(requestId)) return;
      this.bytes += Buffer.byteLength(payloadData);
      const line = payloadData.indexOf('\n');
      const told = JSON.parse(payloadData.slice(0, line));
      const id = `${requestId}/${told.ask}`;
      const asked = open.get(id);
      if (!asked) return;
      if (told.status) asked.status = told.status;
      const piece = Buffer.from(payloadData.slice(line + 1));
      if (piece.length) asked.chunks.push({ at: timestamp, bytes: piece.length });
      if (this.#listening !== 'times') asked.tail.push(piece);
      if (told.last) end(id, timestamp);
    });
    thread.on('Network.webSocketClosed', ({ requestId, timestamp }) => {
      for (const id of open.keys()) if (id.startsWith(`${requestId}/`)) end(id, timestamp);
    });
  }

  /** Questions since a mark taken with `asked.length`. */
  since(mark) {
    return this.asked.slice(mark);
  }
  last() {
    return this.asked.at(-1);
  }
  quiet() {
    return this.asked.every((a) => a.read);
  }

  /** Largest number under way at the same time. */
  static crowd(asked) {
    const ends = asked
      .flatMap((a) => [
        [a.sent, 1],
        [a.ended ?? Infinity, -1],
      ])
      .sort((p, q) => p[0] - q[0] || p[1] - q[1]);
    let now = 0,
      most = 0;
    for (const [, d] of ends) most = Math.max(most, (now += d));
    return most;
  }
}
