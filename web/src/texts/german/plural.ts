// German counts as English does: one, and all else. A module of its own, for the words may wait for nothing.

export const plural = (n: number, forms: { readonly one: string; readonly other: string }): string =>
  n === 1 ? forms.one : forms.other;
