// A few real meshes, where there are any.
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { meshFolder } from '../tests/mesh_folder.mjs';

export const scans = ['common_spot', 'common_fandisk', 'codim_feline']
  .map((name) => join(meshFolder ?? '', `${name}.obj.gz`))
  .filter(existsSync);
