// The collection of meshes that some tests use: a folder named by the environment variable MANDOLINE_MESHES, with the files and a
// manifest.csv that has a line for each. Without the variable these tests are skipped; a folder without a manifest fails them.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

export const meshFolder = process.env.MANDOLINE_MESHES;

/** For a test's option `skip`. */
export const skipWithoutMeshes = meshFolder ? false : 'MANDOLINE_MESHES is not set';

/** The manifest's lines as objects by its titles; none without a folder. */
export function meshList() {
  if (!meshFolder) return [];
  const [titles, ...rows] = readFileSync(join(meshFolder, 'manifest.csv'), 'utf8').trim().split(/\r?\n/).map(fieldsOf);
  return rows.map((row) => Object.fromEntries(titles.map((title, i) => [title, row[i]])));
}

/** The fields of a line, some in quotes. */
function fieldsOf(line) {
  return [...line.matchAll(/(?:^|,)(?:"([^"]*)"|([^,]*))/g)].map(([, quoted, plain]) => quoted ?? plain);
}
