// Marks links with a scene inside; reading and writing them is loaded on demand.

/** The fragment of such a link starts with this. */
export const MARK = '#s1=';

export const isShareLink = (hash: string): boolean => hash.startsWith(MARK);
