// A mesh of our own to cut.
import { writeFileSync } from 'node:fs';
import { path } from './steps.mjs';

/** A closed tube along the (2, 3) torus knot, as OBJ. */
function torusKnot(slices = 240, corners = 16, radius = 0.4) {
  const centre = (u) => [(2 + Math.cos(3 * u)) * Math.cos(2 * u), (2 + Math.cos(3 * u)) * Math.sin(2 * u), Math.sin(3 * u)];
  const minus = (a, b) => a.map((x, d) => x - b[d]);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => a.map((x) => x / Math.hypot(...a));
  const lines = [];
  for (let i = 0; i < slices; i++) {
    const u = (2 * Math.PI * i) / slices, p = centre(u);
    const tangent = unit(minus(centre(u + 1e-3), centre(u - 1e-3)));
    const out = unit(cross(tangent, cross(minus(p, [2 * Math.cos(2 * u), 2 * Math.sin(2 * u), 0]), tangent))); // away from the torus's ring
    const side = cross(tangent, out);
    for (let j = 0; j < corners; j++) {
      const v = (2 * Math.PI * j) / corners, c = radius * Math.cos(v), s = radius * Math.sin(v);
      lines.push(`v ${p.map((x, d) => x + c * out[d] + s * side[d]).join(' ')}`);
    }
  }
  const id = (i, j) => (i % slices) * corners + (j % corners) + 1;
  for (let i = 0; i < slices; i++)
    for (let j = 0; j < corners; j++) lines.push(`f ${id(i, j)} ${id(i, j + 1)} ${id(i + 1, j + 1)} ${id(i + 1, j)}`);
  return `${lines.join('\n')}\n`;
}

/** Writes the knot into the folder, from the project's top; returns the file's path from there. */
export function writeTorusKnot(folder) {
  writeFileSync(path(folder, 'torus-knot.obj'), torusKnot());
  return `${folder}/torus-knot.obj`;
}
