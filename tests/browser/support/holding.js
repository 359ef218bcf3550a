// A proxy before the program that can hold answers: an answer of the generator passes up to its first draft, and the
// rest waits. A state of a hundredth of a second can be examined then.
import { createServer, request } from 'node:http';

export class Holding {
  /** Number of answers that pass completely; later ones stop after their first draft. */
  lets = Infinity;
  #server;
  url = '';

  static async before(url) {
    const h = new Holding();
    const program = new URL(url);
    h.#server = createServer((asked, reply) => {
      const headers = { ...asked.headers, host: program.host };
      // The program refuses pages of another origin than its own.
      delete headers.origin;
      // A persistent connection does not carry one question after the other.
      delete headers.upgrade;
      // In a compressed stream the end of an event is invisible.
      delete headers['accept-encoding'];
      const { hostname, port } = program;
      const question = asked.method === 'POST' && asked.url.startsWith('/v1/generate');
      const whole = !question || h.lets-- > 0;
      const on = request({ hostname, port, path: asked.url, method: asked.method, headers }, (answer) => {
        reply.writeHead(answer.statusCode, answer.headers);
        if (whole) answer.pipe(reply);
        else firstDraft(answer, reply);
      });
      on.on('error', () => reply.destroy());
      reply.on('close', () => on.destroy());
      if (whole) asked.pipe(on);
      else void withDrafts(asked).then((body) => on.end(body));
    });
    await new Promise((done) => h.#server.listen(0, '127.0.0.1', done));
    h.url = `http://127.0.0.1:${h.#server.address().port}`;
    return h;
  }

  async close() {
    this.#server.closeAllConnections();
    await new Promise((done) => this.#server.close(done));
  }
}

/** Requests drafts without delay, so that quick answers have them too; the body keeps its length. */
async function withDrafts(asked) {
  const pieces = [];
  for await (const piece of asked) pieces.push(piece);
  return String(Buffer.concat(pieces)).replace(/"draft_delay_ms":\d+/, '"draft_delay_ms":0');
}

/** The accepted event, and the first draft. */
const LINES = 2;

function firstDraft(answer, reply) {
  let left = LINES;
  answer.on('data', (bytes) => {
    let end = 0;
    while (left && end < bytes.length) {
      const at = bytes.indexOf(10, end);
      if (at < 0) end = bytes.length;
      else {
        end = at + 1;
        left--;
      }
    }
    if (end) reply.write(bytes.subarray(0, end));
  });
  answer.on('end', () => {
    if (left) reply.end();
  });
}
