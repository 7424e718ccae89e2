// A table of OpenFOAM's snappyHexMesh and of the program in build/ about the same surfaces, with the same h:
// `node .ci/snappy.mjs`, where MANDOLINE_MESHES names the folder of the meshes.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import { meshFolder } from '../tests/mesh_folder.mjs';
import { fail } from '../tests/steps.mjs';
import { makeLaminarCase, runIcoFoam, runSimpleFoam } from './laminar_foam.mjs';
import { timed, tryFoam, writeControls, writeInput } from './openfoam.mjs';

const n = 64; // grid cells on a side of a cube three times as long as the surface
const levels = 2; // of larger cells away from it
const solids = ['common_spot', 'igltut_bunny', 'gcherchi_armadillo'];
const sheets = ['codim_skirt8K', 'lagrange_moebius-160-10', 'codim_mat60x60'];

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => a.map((value, axis) => value - b[axis]);

/** The surface as .obj text without groups, its exact volume and area, its longest side, the corners of the cube about it, and h. */
function readSurface(name) {
  const lines = gunzipSync(readFileSync(join(meshFolder, `${name}.obj.gz`)))
    .toString()
    .split('\n');
  const rows = (key) => lines.filter((line) => line.startsWith(`${key} `)).map((line) => line.trim().split(/\s+/).slice(1));
  const points = rows('v').map((row) => row.slice(0, 3).map(Number));
  const faces = rows('f').map((row) => row.map((word) => Number.parseInt(word, 10)));
  let [volume, area] = [0, 0];
  for (const [a, ...others] of faces.map((face) => face.map((v) => points[v - 1])))
    for (let i = 1; i < others.length; ++i) {
      const normal = cross(minus(others[i - 1], a), minus(others[i], a));
      volume += dot(minus(a, points[0]), normal) / 6;
      area += Math.hypot(...normal) / 2;
    }
  const used = faces.flat().map((v) => points[v - 1]);
  const [low, high] = [Math.min, Math.max].map((end) =>
    [0, 1, 2].map((axis) => used.reduce((best, point) => end(best, point[axis]), used[0][axis])),
  );
  const size = Math.max(...minus(high, low));
  const corner = (side) => low.map((value, axis) => (value + high[axis]) / 2 + side * 1.5 * size);
  const text = [...points.map((point) => `v ${point.join(' ')}`), ...faces.map((face) => `f ${face.join(' ')}`)].join('\n');
  const box = [corner(-1), corner(1)];
  return { text: `${text}\n`, volume, area, size, box, h: (3 * size) / n, isSheet: sheets.includes(name) };
}

/** The octree's largest cells, as blockMesh takes them. */
function blocks([low, high]) {
  const corners = Array.from({ length: 8 }, (_, i) => {
    const isHigh = [i % 4 === 1 || i % 4 === 2, i % 4 > 1, i > 3];
    return `(${low.map((value, axis) => (isHigh[axis] ? high[axis] : value)).join(' ')})`;
  });
  const count = n / 2 ** levels;
  const sides = { xMin: '0 4 7 3', xMax: '1 2 6 5', yMin: '0 1 5 4', yMax: '3 7 6 2', zMin: '0 3 2 1', zMax: '4 5 6 7' };
  const patches = Object.entries(sides).map(([side, face]) => `${side} { type patch; faces ((${face})); }`);
  return `vertices (${corners.join(' ')}); blocks (hex (0 1 2 3 4 5 6 7) (${count} ${count} ${count}) simpleGrading (1 1 1));
boundary (${patches.join(' ')});`;
}

// Its own defaults, but no layers at the walls, and between levels 2 cells as in our octree instead of 3.
const defaults = (name) => `#includeEtc "caseDicts/mesh/generation/${name}.cfg"\n`;
const snappy = (inside) => `${defaults('snappyHexMeshDict')}addLayers false;
geometry { surface.obj { type triSurfaceMesh; name surface; } }
castellatedMeshControls { refinementSurfaces { surface { level (${levels} ${levels}); } } refinementRegions {}
  nCellsBetweenLevels 2; locationInMesh (${inside.join(' ')}); }
addLayersControls { layers {} relativeSizes true; expansionRatio 1; finalLayerThickness 0.3; minThickness 0.1; }`;

/** Writes what lies outside of a solid, or on both sides of a sheet, and gives the cpu time in seconds, or undefined if it fails. */
function cut(folder, { box, isSheet }, ...more) {
  const options = `--cells ${n} --box=${box.flat().join()} --coarsen ${levels} --merge 0.2 --only ${isSheet ? 'region=0' : 'outside'}`;
  const [surface, report, polyMesh] = ['constant/triSurface/surface.obj', 'report.json', 'constant/polyMesh'].map((file) =>
    join(folder, file),
  );
  const files = [surface, '--report', report, '-o', polyMesh];
  const { status, seconds } = timed(['build/mandoline', 'cut', ...options.split(' '), ...more, ...files]);
  return status === 0 ? seconds : undefined;
}

// Each fills constant/polyMesh of the case, and gives what cut() does.
const meshers = {
  'mandoline, walls united': (folder, surface) => cut(folder, surface, '--unite-walls', '30'),
  mandoline: (folder, surface) => cut(folder, surface),
  snappyHexMesh(folder, { box, h }) {
    writeInput(folder, 'system', 'blockMeshDict', 'dictionary', blocks(box));
    writeInput(folder, 'system', 'meshQualityDict', 'dictionary', defaults('meshQualityDict'));
    writeInput(folder, 'system', 'snappyHexMeshDict', 'dictionary', snappy(box[0].map((low, axis) => low + (0.31 + 0.04 * axis) * h)));
    const runs = [tryFoam(folder, 'blockMesh'), tryFoam(folder, 'snappyHexMesh', '-overwrite')];
    return runs.every(({ status }) => status === 0) ? runs[0].seconds + runs[1].seconds : undefined;
  },
};

/** What checkMesh says, and the area of the wall, both sides of sheets. */
function measure(folder) {
  const { output } = tryFoam(folder, 'checkMesh', '-allTopology');
  const number = (pattern) => Number(output.match(pattern)?.[1] ?? Number.NaN);
  writeControls(folder, {
    precision: 12,
    functions: `wall { type surfaceFieldValue; libs ("libfieldFunctionObjects.so"); log true; writeFields false;
      regionType patch; name surface; operation none; fields (); }`,
  });
  const wall = tryFoam(folder, 'postProcess', '-time', '0').output.match(/total area\s*=\s*(\S+)/)?.[1];
  return {
    cells: number(/^ +cells: +(\d+)/m),
    volume: number(/Total volume = (\S+?)\.? /),
    failed: output.includes('Mesh OK.') ? 0 : number(/Failed (\d+) mesh checks/),
    angle: number(/non-orthogonality Max: (\S+)/),
    wall: Number(wall ?? 0),
  };
}

const text = (value, digits) => (Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : 'fails');
const percent = (value) => `${text(100 * value, 3)} %`;

/** A line of the table: the surface `name` meshed by one of `meshers`. */
function lineOf(name, mesher) {
  const surface = readSurface(name);
  const folder = makeLaminarCase();
  mkdirSync(join(folder, 'constant', 'triSurface'), { recursive: true });
  writeFileSync(join(folder, 'constant', 'triSurface', 'surface.obj'), surface.text);
  const seconds = meshers[mesher](folder, surface);
  if (seconds === undefined) return [name, mesher, 'fails'];
  const { cells, volume, failed, angle, wall } = measure(folder);
  const error = (volume - (3 * surface.size) ** 3 + surface.volume) / surface.volume;
  const courant = runIcoFoam(folder, surface);
  const { iterations, drag } = runSimpleFoam(folder, surface);
  const kept = surface.isSheet ? [percent(wall / 2 / surface.area)] : [percent(wall / surface.area), percent(Math.abs(error))];
  const results = [text(angle, 3), text(courant, 2), text(iterations, 3), text(drag, 3)];
  return [name, mesher, text(seconds, 2), cells, kept.join('; '), text(failed, 2), ...results];
}

if (!meshFolder) fail('MANDOLINE_MESHES has to name the folder of the meshes.');
const titles = 'surface,mesher,cpu s,cells,area kept; error of volume,failed checks,largest angle,Courant number,iterations,drag'.split(
  ',',
);
const print = (line) => console.log(`| ${line.join(' | ')} |`);
print(titles);
print(titles.map(() => '---'));
for (const name of process.argv.length > 2 ? process.argv.slice(2) : [...solids, ...sheets])
  for (const mesher of Object.keys(meshers)) print(lineOf(name, mesher));
