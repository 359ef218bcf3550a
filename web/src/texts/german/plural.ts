// German has the plural forms of English: one, and other. A separate module, since the words may wait for nothing.

export const plural = (n: number, forms: { readonly one: string; readonly other: string }): string =>
  n === 1 ? forms.one : forms.other;
