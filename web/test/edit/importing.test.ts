// A dropped file is shown without a wait for the list of scenes.
import { expect, it } from 'vitest';
import { Importing } from '../../src/edit/tools/importing/importing';

type Parts = ConstructorParameters<typeof Importing>;

it('opens the scene of a file before the list of scenes arrives', async () => {
  const steps: string[] = [];
  let listed = (): void => undefined;
  const shows = { show: () => undefined, hide: () => steps.push('done') };
  const importing = new Importing(
    { notices: shows } as unknown as Parts[0],
    { open: async (id: string) => void steps.push(`open ${id}`) } as unknown as Parts[1],
    {
      refresh: () => new Promise<void>((resolve) => (listed = resolve)).then(() => void steps.push('listed')),
    } as unknown as Parts[2],
    {
      request: async () => Response.json({ scenes: [{ id: 'a1', name: 'A', counts: {}, warnings: [] }], skipped: [] }),
    } as unknown as Parts[3],
  );
  const read = importing.files([new File(['{}'], 'scene.json')]);
  await expect.poll(() => steps).toEqual(['open a1']);
  listed();
  await read;
  expect(steps).toEqual(['open a1', 'listed', 'done']);
});
