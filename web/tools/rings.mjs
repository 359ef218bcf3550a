// Rings of imports in src, and folders of many files in src, test and the browser journeys. `npm run rings` prints the
// counts and fails where a number differs from the one below: a smaller count lowers its number here, a larger one is
// refused. Imports of types count, since a file is not read without them, and a dynamic import() too.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

/** Files in rings, by room; `across` for a ring through several rooms. Rooms without a number have none. */
const RINGS = {};
/** The most files in a folder, and the folders with more; the folders that are looked at. */
const MOST_FILES = 25;
const LARGER = {};
const COUNTED = ['src', 'test', '../tests/browser/journeys', '../tests/browser/support'];

const src = fileURLToPath(new URL('../src', import.meta.url));
const files = readdirSync(src, { recursive: true, encoding: 'utf8' })
  .filter((name) => /\.tsx?$/.test(name))
  .map((name) => name.replaceAll('\\', '/'));
const known = new Set(files);

/** The files that a file imports. */
function importsOf(name) {
  const out = new Set();
  const file = ts.createSourceFile(name, readFileSync(join(src, name), 'utf8'), ts.ScriptTarget.Latest);
  const visit = (node) => {
    const dynamic = ts.isCallExpression(node) && node.expression.kind === ts.SyntaxKind.ImportKeyword;
    const from = dynamic ? node.arguments[0] : ts.isImportTypeNode(node) ? node.argument.literal : node.moduleSpecifier;
    const path = from?.text?.startsWith('.') ? join(dirname(name), from.text).replaceAll('\\', '/') : null;
    const hit = path && ['', '.ts', '.tsx'].map((end) => path + end).find((p) => known.has(p));
    if (hit) out.add(hit);
    else if (path && !existsSync(join(src, path))) throw new Error(`${name} imports ${from.text}, which is not there`);
    ts.forEachChild(node, visit);
  };
  visit(file);
  return [...out];
}

/** Groups of files each of which reaches every other one: strongly connected components, by Tarjan. */
function ringsOf(graph) {
  const [order, low, stack, rings] = [new Map(), new Map(), [], []];
  const visit = (v) => {
    order.set(v, order.size);
    low.set(v, order.get(v));
    stack.push(v);
    for (const w of graph.get(v)) {
      if (!order.has(w)) visit(w);
      if (stack.includes(w)) low.set(v, Math.min(low.get(v), low.get(w)));
    }
    if (low.get(v) !== order.get(v)) return;
    const ring = stack.splice(stack.indexOf(v));
    if (ring.length > 1) rings.push(ring);
  };
  for (const v of graph.keys()) if (!order.has(v)) visit(v);
  return rings;
}

const faults = [];
function hold(what, found, allowed) {
  for (const key of new Set([...Object.keys(found), ...Object.keys(allowed)]))
    if ((found[key] ?? 0) !== (allowed[key] ?? 0))
      faults.push(`${what} in ${key}: ${found[key] ?? 0}, tools/rings.mjs says ${allowed[key] ?? 0}`);
}

const rings = ringsOf(new Map(files.map((name) => [name, importsOf(name)])));
const inRings = {};
for (const ring of rings) {
  const rooms = [...new Set(ring.map((name) => name.split('/')[0]))];
  const room = rooms.length > 1 ? 'across' : rooms[0];
  inRings[room] = (inRings[room] ?? 0) + ring.length;
}
const counts = {};
for (const top of COUNTED)
  for (const file of readdirSync(join(src, '..', top), { recursive: true, withFileTypes: true })) {
    const folder = relative(join(src, '..'), file.parentPath).replaceAll('\\', '/');
    if (file.isFile()) counts[folder] = (counts[folder] ?? 0) + 1;
  }
const large = Object.fromEntries(Object.entries(counts).filter(([, n]) => n > MOST_FILES));
hold('files in rings', inRings, RINGS);
hold(`more than ${MOST_FILES} files`, large, LARGER);
console.log(`rings: ${JSON.stringify(inRings)}, folders over ${MOST_FILES} files: ${JSON.stringify(large)}`);
for (const ring of faults.length ? rings : []) console.error(`ring: ${ring.sort().join(' ')}`);
for (const fault of faults) console.error(fault);
process.exitCode = faults.length ? 1 : 0;
