// Why the server says no, as it comes over the wire.
import type { Problem } from './types';

export const problemOf = async (reply: Response): Promise<Problem> =>
  problemIn(await reply.text().catch(() => ''), reply.status, reply.statusText);

/** What a refusal says, where it says anything. */
export function problemIn(text: string, status: number, title = ''): Problem {
  const fallback: Problem = { code: `http-${status}`, title: title || 'Refused', status };
  try {
    const body = JSON.parse(text) as Partial<Problem>;
    return body && typeof body === 'object' ? { ...fallback, ...body } : fallback;
  } catch {
    return fallback;
  }
}

/** The first fault found, in the server's own words. */
export const faultOf = (p: Problem): string => p.errors?.[0]?.detail ?? p.reason ?? p.detail ?? p.title ?? p.code;
