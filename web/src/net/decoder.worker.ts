// Runs in a worker: text in, object out, number columns as Float64Array.
const COLUMNS = new Set(['x_m', 'y_m', 'heading_rad', 'vx_mps', 'vy_mps']);

self.onmessage = (e: MessageEvent<{ id: number; text: string }>) => {
  const { id, text } = e.data;
  const moved: Transferable[] = [];
  try {
    const value = JSON.parse(text, (key, v: unknown) => {
      if (!COLUMNS.has(key) || !Array.isArray(v)) return v;
      const a = Float64Array.from(v as number[]);
      moved.push(a.buffer);
      return a;
    }) as unknown;
    self.postMessage({ id, value }, { transfer: moved });
  } catch (error) {
    self.postMessage({ id, error: String(error) });
  }
};
