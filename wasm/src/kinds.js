// What may have twins, for hosts (see host.js).
import { readCutMesh, readMesh } from './arguments.js';

export const cutMesh = {
  read: readCutMesh,
  make: (bindings, arrays, { taken: { isChecked = true } }) => bindings.keepCutMesh(arrays, isChecked),
};

export const prepared = {
  read: readMesh,
  make: (bindings, mesh, { origin: { intersections }, progress }) => bindings.keepMesh(mesh, { intersections, progress }),
};
