// The problem document of a refusal.
import type { Problem } from './types';

export const problemOf = async (reply: Response): Promise<Problem> =>
  problemIn(await reply.text().catch(() => ''), reply.status, reply.statusText);

/** The problem in a refusal's body, or one made from its status. */
export function problemIn(text: string, status: number, title = ''): Problem {
  const fallback: Problem = { code: `http-${status}`, title: title || 'Refused', status };
  try {
    const body = JSON.parse(text) as Partial<Problem>;
    return body && typeof body === 'object' ? { ...fallback, ...body } : fallback;
  } catch {
    return fallback;
  }
}

/** The first fault, in the server's own words. */
export const faultOf = (p: Problem): string => p.errors?.[0]?.detail ?? p.reason ?? p.detail ?? p.title ?? p.code;

/** Codes after which the same request is sent again. */
const ASK_AGAIN = new Set(['busy', 'too-many-requests']);

/** Milliseconds after which the server asks for the same request again; null where it would refuse that too. */
export const waitOf = (p: Problem): number | null => (ASK_AGAIN.has(p.code) ? (p.retry_after_ms ?? 1000) : null);
