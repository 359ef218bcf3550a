import tseslint from 'typescript-eslint';

// Layers, top to bottom. A file may import from its own layer and from those below, never upwards.
const LAYERS = [
  ...['app', 'actions'],
  ...['edit/tools', 'edit/gestures', 'edit/overlay', 'edit/asking', 'edit/moves', 'edit/session', 'edit/document'],
  ...['draw', 'net'],
  ...['model/words', 'model/physics', 'model/document', 'model/base'],
  'texts',
];

/** How an import names another layer: by its path, or from a room beside it by the room alone. */
const named = (upper, layer) => {
  const [top, room] = upper.split('/');
  return room && layer.startsWith(`${top}/`) ? `^\\.\\./${room}/` : `^\\.(.*)/${upper}/`;
};

const upwards = (layer) =>
  LAYERS.slice(0, LAYERS.indexOf(layer)).map((upper) => ({
    regex: named(upper, layer),
    message: `${layer}/ lies below ${upper}/ and must not import from it.`,
  }));

/** Whatever asks the generator knows the interface alone; start-up chooses what stands behind it. */
const BEHIND_THE_GENERATOR = {
  group: ['**/net/http-generator'],
  message: 'Import the interface from net/generator; app/main.ts decides who implements it.',
};

const layerRules = LAYERS.map((layer) => ({
  files: [`**/src/${layer}/**/*.{ts,tsx}`],
  rules: {
    'no-restricted-imports': [
      'error',
      { patterns: [...upwards(layer), ...(/^(edit|actions)\b/.test(layer) ? [BEHIND_THE_GENERATOR] : [])] },
    ],
  },
}));

/** `a.b.value = x` where `a` is not `this`: a signal of somebody else. Its owner has a named method for the change. */
const FOREIGN_SIGNAL = {
  selector:
    ':matches(AssignmentExpression[left.property.name="value"][left.object.type="MemberExpression"]' +
    '[left.object.object.type!="ThisExpression"][left.object.property.name!="current"],' +
    'UpdateExpression[argument.property.name="value"][argument.object.type="MemberExpression"]' +
    '[argument.object.object.type!="ThisExpression"])',
  message: 'A signal is changed by its owner alone, in a method that says what happens.',
};

/** Time is no condition: on a slow machine it is too short, on a fast one it is wasted. */
const NO_SLEEPING = {
  selector: 'CallExpression[callee.property.name="waitForTimeout"]',
  message: 'Wait for a condition instead (`until`).',
};

const LINE_LENGTH = ['error', { code: 120, ignoreUrls: true, ignoreRegExpLiterals: true }];

export default tseslint.config(
  { ignores: ['**/dist', '**/node_modules', '**/out', '**/src/model/base/api.ts'] },
  ...tseslint.configs.recommended,
  {
    rules: {
      '@typescript-eslint/no-non-null-assertion': 'off',
      eqeqeq: ['error', 'always', { null: 'ignore' }],
      'max-len': LINE_LENGTH,
      'no-console': 'error',
    },
  },
  // A text stands on one line, however long.
  { files: ['**/src/texts/**'], rules: { 'max-len': 'off' } },
  { files: ['**/test/**', '**/tools/**', '**/tests/**'], rules: { 'no-console': 'off' } },
  { files: ['**/src/**/*.{ts,tsx}'], rules: { 'no-restricted-syntax': ['error', FOREIGN_SIGNAL] } },
  {
    files: ['**/test/browser/**', '**/tests/browser/**'],
    rules: { 'no-restricted-syntax': ['error', NO_SLEEPING] },
  },
  // The report of a batch is one script in several files: what one declares, another uses.
  {
    files: ['**/cli/batch/page/**'],
    languageOptions: { sourceType: 'script' },
    rules: { '@typescript-eslint/no-unused-vars': ['error', { vars: 'local' }] },
  },
  {
    files: ['**/src/model/**/*.ts'],
    rules: { 'no-restricted-globals': ['error', 'document', 'window', 'fetch', 'localStorage'] },
  },
  ...layerRules,
);
