import { expect, test } from 'vitest';
import { inPairs } from '../../src/edit/tools/importing/file-import';

const file = (name: string): File => new File(['x'], name);

const names = (files: readonly string[]): string[] =>
  inPairs(files.map(file)).map(({ file: f, net }) => (net ? `${f.name} on ${net.name}` : f.name));

test('a recording takes the map of the same drop', () => {
  expect(names(['log_map_archive_a1.json', 'scenario_a1.parquet', 'scene.json'])).toEqual([
    'scenario_a1.parquet on log_map_archive_a1.json',
    'scene.json',
  ]);
  expect(names(['x.fcd.xml.gz', 'town.net.xml'])).toEqual(['x.fcd.xml.gz on town.net.xml']);
  expect(names(['map.gpkg', '2021.05.12_veh-35.db'])).toEqual(['2021.05.12_veh-35.db on map.gpkg']);
});

test('of several maps each goes with the recording of its name', () => {
  const dropped = ['scenario_a.parquet', 'scenario_b.parquet', 'log_map_archive_b.json', 'log_map_archive_a.json'];
  expect(names(dropped)).toEqual([
    'scenario_a.parquet on log_map_archive_a.json',
    'scenario_b.parquet on log_map_archive_b.json',
  ]);
});

test('maps alone and tables stay unpaired', () => {
  expect(names(['town.net.xml', 'motion.parquet', 'log_map_archive_a.json'])).toEqual([
    'town.net.xml',
    'motion.parquet',
    'log_map_archive_a.json',
  ]);
});
