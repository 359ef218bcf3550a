export function buildCrossing(id?: string, name?: string): { scene: unknown; counts: Record<string, number> };
