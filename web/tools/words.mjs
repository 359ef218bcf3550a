// Displayed words are in src/texts: `npm run words` lists those elsewhere, and fails if there are any. Literals that
// only look like words (keys, classes, names of states, tags) are recognised by form or by position.
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const src = fileURLToPath(new URL('../src', import.meta.url));

/** Attributes that are displayed or read aloud. */
const SPOKEN = /^(label|title|placeholder|alt|aria-label|aria-description|aria-valuetext|aria-roledescription)$/;
/** Attributes that are not displayed. */
const UNSEEN =
  /^(class|className|d|id|style|viewBox|fill|stroke|type|role|key|data-.*|href|for|rel|name|icon|part|transform|points|tabIndex|accept|inputMode|aria-(?!label|desc|value).*)$/;
/** Calls with arguments for the program. */
/** Files without displayed text. */
const SILENT =
  /^(texts|draw|net)\/|^app\/(parts\/icons|focus)|^actions\/keys|^edit\/tools\/outward\/gif|^model\/base\/api/;

const UNSEEN_CALLS =
  /(^|\.)(querySelector|querySelectorAll|closest|matches|addEventListener|removeEventListener|getAttribute|setAttribute|removeAttribute|toggleAttribute|createElement|createElementNS|getContext|matchMedia|setProperty|getPropertyValue|includes|startsWith|endsWith|indexOf|split|replace|has|get|set|delete|keep|recall|forget|test|match|join|toggle|contains|add|remove|dispatchEvent|Error|TypeError|URL|fetch|request|RegExp|css|Path2D|Worker|FontFace|Event|CustomEvent|append)$/;
/** Words of the program, not of users: keys, formats, media types, names of fields. */
const CODE =
  /^(?:[a-z0-9]+(?:[-_.:/][a-z0-9*]+)+|[a-z]+|[a-z]+[A-Z0-9][A-Za-z0-9]*|[A-Z]|[A-Z0-9_]+|Arrow\w+|Escape|Enter|Home|End|PageUp|PageDown|Tab|Backspace|Delete|Shift|Ctrl|Alt|Meta|Control|Space|Left|Right|Up|Down|F\d+|(?:Ctrl|Shift|Alt)\+.*|[#.][\w-]+|(?:Esc|Del)|--[\w-]+|&\w+;|translate\(.*|.*: ?x(?:px|%)|[MLHVCZ][\d\s.,a-zA-Z-]*\d.*|https?:.*|var\(.*|(?:image|video)\/.*|\/[a-z_/]+|application\/.*|text\/.*|\d.*px.*)$/;

/** Units, and names that are equal everywhere. */
const UNITS = /^(?:px|km\/h|m\/s|m\/s²|mph|KB|MB|ft|DragTraffic|GIF|PNG|SVG|WebM|%PDF|#?[0-9a-fA-F]{3,8}|rgba?\(.*\))$/;

const letters = /\p{L}{2}/u;

function parentCall(node) {
  let n = node.parent;
  while (ts.isConditionalExpression(n) || ts.isParenthesizedExpression(n) || ts.isArrayLiteralExpression(n))
    n = n.parent;
  return (ts.isCallExpression(n) || ts.isNewExpression(n)) && n.expression !== node ? n : null;
}

/** Is this literal displayed? */
function seen(node, text) {
  const p = node.parent;
  if (!isWords(text.replaceAll('\u0000', ' '))) return false;
  if (ts.isJsxText(node)) return true;
  // Tags of HTML and their attributes.
  if (!isWords(text.replace(/<[^>]*>/g, '').replace(/^[\w-]+="[^"]*"$/, ''))) return false;
  if (ts.isImportDeclaration(p) || ts.isExportDeclaration(p) || ts.isExternalModuleReference(p)) return false;
  if (ts.isLiteralTypeNode(p) || ts.isTemplateLiteralTypeNode?.(p)) return false;
  if (ts.isImportTypeNode(p) || (ts.isCallExpression(p) && p.expression.kind === ts.SyntaxKind.ImportKeyword))
    return false;
  if (ts.isPropertyAssignment(p) && p.name === node) return false;
  // Names of states, and marks in files: not displayed.
  if (ts.isPropertyDeclaration(p) && p.name.getText() === 'name') return false;
  if (ts.isVariableDeclaration(p) && /^(MARK|STYLE)$/.test(p.name.getText())) return false;
  if (ts.isElementAccessExpression(p) || ts.isCaseClause(p)) return false;
  if (ts.isBinaryExpression(p) && /^(===|!==|in)$/.test(p.operatorToken.getText())) return false;
  let attr = p;
  while (attr && !ts.isJsxAttribute(attr) && !ts.isArrowFunction(attr) && !ts.isJsxElement(attr)) attr = attr.parent;
  if (attr && ts.isJsxAttribute(attr)) {
    const name = attr.name.getText();
    if (SPOKEN.test(name)) return true;
    if (UNSEEN.test(name)) return false;
  }
  for (let up = p; up && !ts.isBlock(up); up = up.parent)
    if (ts.isPropertyAssignment(up) && up.name.getText() === 'keys') return false;
  const call = parentCall(node);
  if (call && /setAttribute$/.test(call.expression.getText()) && SPOKEN.test(call.arguments[0].text ?? ''))
    return node !== call.arguments[0];
  if (call && UNSEEN_CALLS.test(call.expression.getText())) return false;
  if (
    ts.isPropertyAssignment(p) &&
    /^(icon|id|key|keys|kind|cursor|name|type|event|font|color|colour|fill|class|method|group|help|spread|cursor)$/.test(
      p.name.getText(),
    )
  )
    return /\s/.test(text) && !/^(font|cursor)$/.test(p.name.getText());
  if (ts.isPropertyAssignment(p) && /^(label|title|text|words|note|hint|empty|say)$/.test(p.name.getText()))
    return true;
  return !CODE.test(text.replaceAll('\u0000', 'x'));
}

function textOf(node) {
  if (ts.isTemplateExpression(node))
    return node.head.text + node.templateSpans.map((s) => '\u0000' + s.literal.text).join('');
  return node.text;
}

const isWords = (text) => letters.test(text) && !UNITS.test(text.trim());

/** All visible literals of a file, as nodes. */
function find(file) {
  const out = [];
  const visit = (node) => {
    if (
      ts.isStringLiteral(node) ||
      ts.isNoSubstitutionTemplateLiteral(node) ||
      ts.isTemplateExpression(node) ||
      ts.isJsxText(node)
    ) {
      const text = textOf(node);
      if (seen(node, text.trim())) out.push(node);
    }
    ts.forEachChild(node, visit);
  };
  visit(file);
  return out;
}

function* sources(folder = src) {
  for (const name of readdirSync(folder, { recursive: true, encoding: 'utf8' }).sort())
    if (/\.tsx?$/.test(name) && !SILENT.test(name)) {
      const path = `${folder}/${name}`;
      yield { name, path, file: ts.createSourceFile(path, readFileSync(path, 'utf8'), ts.ScriptTarget.Latest, true) };
    }
}

let count = 0;
for (const { name, file } of sources())
  for (const node of find(file)) {
    count++;
    const line = file.getLineAndCharacterOfPosition(node.getStart()).line + 1;
    console.error(`src/${name}:${line}: ${node.getText().replace(/\s+/g, ' ')}`);
  }
if (count) {
  console.error(`${count} texts that a person can see stand outside of src/texts.`);
  process.exit(1);
}
