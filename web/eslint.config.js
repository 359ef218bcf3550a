import tseslint from 'typescript-eslint';

// Layers, top to bottom. A file may import from its own layer and from those below, never upwards.
const LAYERS = ['app', 'actions', 'edit', 'draw', 'net', 'model'];

const layerRules = LAYERS.map((layer, i) => ({
  files: [`src/${layer}/**/*.ts`],
  rules: {
    'no-restricted-imports': [
      'error',
      {
        patterns: LAYERS.slice(0, i).map((upper) => ({
          group: [`**/${upper}/*`],
          message: `${layer}/ lies below ${upper}/ and must not import from it.`,
        })),
      },
    ],
  },
}));

export default tseslint.config(
  { ignores: ['dist', 'node_modules'] },
  ...tseslint.configs.recommended,
  {
    rules: {
      '@typescript-eslint/no-non-null-assertion': 'off',
      eqeqeq: ['error', 'always', { null: 'ignore' }],
      'no-console': 'error',
    },
  },
  { files: ['test/**'], rules: { 'no-console': 'off' } },
  {
    files: ['src/model/**/*.ts'],
    rules: { 'no-restricted-globals': ['error', 'document', 'window', 'fetch', 'localStorage'] },
  },
  ...layerRules,
);
