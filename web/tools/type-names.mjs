// Names of types in src. `npm run types` prints the names that several files declare, and fails where their number
// differs from the one below: a smaller number is lowered here, a larger one is refused. An import or a re-export of a
// type is no declaration.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

/** Names that several files declare. */
const SEVERAL = 0;
/** Generated: its names are those of the server's documents. */
const GENERATED = 'model/base/api.ts';

const src = fileURLToPath(new URL('../src', import.meta.url));
const files = readdirSync(src, { recursive: true, encoding: 'utf8' })
  .map((name) => name.replaceAll('\\', '/'))
  .filter((name) => /\.tsx?$/.test(name) && name !== GENERATED);

const isType = (node) =>
  ts.isInterfaceDeclaration(node) ||
  ts.isTypeAliasDeclaration(node) ||
  ts.isClassDeclaration(node) ||
  ts.isEnumDeclaration(node);

/** The files that declare each name. */
const declared = new Map();
for (const name of files) {
  const visit = (node) => {
    if (isType(node) && node.name) {
      const places = declared.get(node.name.text) ?? new Set();
      declared.set(node.name.text, places.add(name));
    }
    ts.forEachChild(node, visit);
  };
  visit(ts.createSourceFile(name, readFileSync(join(src, name), 'utf8'), ts.ScriptTarget.Latest));
}

const several = [...declared].filter(([, places]) => places.size > 1);
console.log(`types: ${declared.size} names, ${several.length} in several files`);
for (const [name, places] of several) console.log(`  ${name}: ${[...places].sort().join(' ')}`);
if (several.length !== SEVERAL) {
  console.error(`${several.length} names in several files, tools/type-names.mjs says ${SEVERAL}`);
  process.exitCode = 1;
}
