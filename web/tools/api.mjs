// Writes src/model/base/api.ts, the API's types, from assets/openapi.json; --check only compares them.
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import openapi, { astToString } from 'openapi-typescript';

const document = new URL('../../assets/openapi.json', import.meta.url);
const target = fileURLToPath(new URL('../src/model/base/api.ts', import.meta.url));
const head =
  '// Made from assets/openapi.json by `npm run api`; not to be edited. model/document/scene-json.ts and\n' +
  '// net/types.ts name what the editor uses.\n';

// A member with a default may be omitted in a request.
const types = head + astToString(await openapi(document, { defaultNonNullable: false, silent: true }));
if (!process.argv.includes('--check')) writeFileSync(target, types);
else if (readFileSync(target, 'utf8') !== types) {
  console.error('src/model/base/api.ts does not agree with assets/openapi.json; run `npm run api`.');
  process.exit(1);
}
