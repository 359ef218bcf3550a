// How a link with a scene inside is known; reading and writing one comes when it is wanted.

/** The fragment of such a link begins so. */
export const MARK = '#s1=';

export const isShareLink = (hash: string): boolean => hash.startsWith(MARK);
