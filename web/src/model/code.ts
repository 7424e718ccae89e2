// The present state of the page as code that runs as it is: JavaScript for Node, and the command line. Both write the same files.
import { inFileName, stemOf } from './formats';
import { gridAround } from './grid_around';
import { meetsInside, type SlicedModel } from './meets_inside';
import type { Model } from './cut_model';
import { activePlanes, inWorld } from './planes';
import type { Settings } from './settings';
import type { SliceName } from './slices';
import type { Vector3 } from './vector';
import { smokeBox, smokeFraction, smokeViscosity } from './smoke_box';
import { windMargin } from './wind';

/** What the code says of a cut beside the settings. */
export type CodeModel = SlicedModel & Pick<Model, 'name' | 'isReadHere' | 'origin' | 'meshMin' | 'meshMax' | 'estimateMs'>;

export interface Code {
  /** The file with the mesh that both read. */
  file: string;
  /** Whether it is the very file that was opened; else it has to be saved first. */
  isOpened: boolean;
  javascript: string;
  commandLine: string;
}

/** A plane that meets what is inside, in world units. */
interface Section {
  name: SliceName;
  normal: Vector3;
  offset: number;
}

export function codeOf(settings: Settings, model: CodeModel): Code {
  const { file, isOpened } = meshFile(settings, model);
  const sections = sectionsOf(settings, model);
  return {
    file,
    isOpened,
    javascript: javascript(settings, model, file, sections),
    commandLine: commandLine(settings, model, file, sections),
  };
}

/** The package and the command line read neither glTF nor 3MF; what moves, or isn't a file, is there once it is saved. */
function meshFile({ source, pose }: Settings, { name, isReadHere }: CodeModel): Pick<Code, 'file' | 'isOpened'> {
  if (source.kind === 'file' && !pose && !isReadHere) return { file: name, isOpened: true };
  const stem = inFileName(stemOf(name));
  return { file: `${stem || 'mesh'}${pose ? `-${pose.motion}` : ''}.obj`, isOpened: false };
}

/** A plane beside all that is inside has no outlines. */
function sectionsOf(settings: Settings, model: CodeModel): Section[] {
  const planes = activePlanes(model, settings).filter((plane) => meetsInside(model, plane));
  return inWorld(planes, model.origin).map((plane, at) => ({ name: planes[at].name, ...plane }));
}

/** While a mesh moves, its grid has room for all of the motion. */
function gridOf({ grid, pose }: Settings, { grid: { planes, cells } }: CodeModel): Settings['grid'] {
  if ('min' in grid || !pose) return grid;
  const end = (at: number): Vector3 => [planes[0].at(at) ?? 0, planes[1].at(at) ?? 0, planes[2].at(at) ?? 0];
  return { min: end(0), max: end(-1), cells };
}

/** The same of the wind tunnel. */
function tunnelOf({ wind: { cells }, pose }: Settings, { meshMin, meshMax }: CodeModel): Settings['grid'] {
  return pose ? gridAround({ min: meshMin, max: meshMax }, cells, windMargin) : { cells };
}

function javascript(settings: Settings, model: CodeModel, file: string, sections: readonly Section[]): string {
  const { wind } = settings;
  const isInside = sections.length > 0 && model.regions.some((region) => region.isInside);
  const calls = ['cut', 'readMesh', 'write'];
  if (model.estimateMs !== null) calls.push('estimateInside');
  if (isInside) calls.push('insideRegions');
  if (sections.length > 0) calls.push('outlines', 'writeOutlines');
  if (wind.on && !wind.smoke) calls.push('writeLines');
  return [
    "import { readFile, writeFile } from 'node:fs/promises';",
    "import { init } from 'mandoline-wasm';",
    ...(wind.on ? ["import { initPhysics } from 'mandoline-wasm/physics';"] : []),
    '',
    `const { ${calls.sort().join(', ')} } = await init();`,
    `const mesh = await readMesh(await readFile(${quoted(file)}), { name: ${quoted(file)} });`,
    ...cutLines(settings, model),
    ...(isInside ? ['', "const { isInside } = insideRegions(cutMesh, { rule: 'nonZero' });"] : []),
    ...sections.flatMap((section) => sliceLines(section, isInside)),
    ...(wind.on ? ['', ...(wind.smoke ? smokeLines(settings, model) : flowLines(settings, model))] : []),
    '',
  ].join('\n');
}

function cutLines(settings: Settings, model: CodeModel): string[] {
  const snap = settings.snapTolerance > 0 ? `, { snapTolerance: ${settings.snapTolerance} }` : '';
  const cut = `cut(mesh, ${gridObject(gridOf(settings, model))}${snap})`;
  return [
    `const cutMesh = ${model.estimateMs === null ? cut : `estimateInside(mesh, ${cut})`};`,
    "console.log(cutMesh.cellRegion.length, 'cut-cells,', cutMesh.regionCount, 'regions');",
    "await writeFile('cells.vtu', await write(mesh, cutMesh, 'vtu'));",
  ];
}

function gridObject(grid: Settings['grid'], margin = ''): string {
  if (!('min' in grid)) return `{ cells: ${grid.cells}${margin} }`;
  return `{ min: ${list(grid.min)}, max: ${list(grid.max)}, cells: ${list(grid.cells)} }`;
}

function list(numbers: Vector3): string {
  return `[${numbers.join(', ')}]`;
}

function sliceLines({ name, normal, offset }: Section, isInside: boolean): string[] {
  const plane = `${name}Plane`;
  return [
    '',
    `const ${plane} = { normal: ${list(normal)}, offsets: [${offset}] };`,
    `const ${name}Outlines = { ...${plane}, layers: outlines(cutMesh, ${plane}.normal, ${plane}.offsets) };`,
    `await writeFile('slice-${name}.svg', await writeOutlines(${name}Outlines, 'svg'${isInside ? ', { regions: isInside }' : ''}));`,
  ];
}

function flowLines(settings: Settings, model: CodeModel): string[] {
  return [
    'const { cellComplex, coarsen, inflowSeeds, solveFlow, streamlines, writeCells } = await initPhysics();',
    `const wind = ${list(settings.wind.direction)};`,
    `const tunnel = cut(mesh, ${gridObject(tunnelOf(settings, model), `, margin: ${windMargin}`)});`,
    'const cells = cellComplex(mesh, tunnel, coarsen(tunnel));',
    'const flow = solveFlow(cells, wind);',
    "console.log(cells.cellVolume.length, 'cells in the wind,', flow.status);",
    'const fields = { phi: flow.phi, velocity: flow.cellVelocity, pressure_coefficient: flow.cellPressure };',
    "await writeFile('flow.vtu', writeCells(tunnel, cells, 'vtu', { fields }));",
    `const seeds = inflowSeeds(tunnel.grid, wind, ${lineCount});`,
    "await writeFile('streamlines.obj', await writeLines(streamlines({ mesh, cutMesh: tunnel, cells, flow }, seeds)));",
  ];
}

/** Without the gust that the page begins with. */
function smokeLines({ wind: { direction } }: Settings, { meshMin, meshMax }: CodeModel): string[] {
  const bounds = { min: meshMin, max: meshMax };
  return [
    'const { cellComplex, createFlowStepper, mergeSmallCells, uniteWalls, writeCells } = await initPhysics();',
    `const tunnel = cut(mesh, ${gridObject(smokeBox(bounds, direction))});`,
    `const merged = mergeSmallCells(tunnel, cellComplex(mesh, tunnel), { fraction: ${smokeFraction} });`,
    'const cells = uniteWalls(tunnel, merged.cells);',
    `const stepper = createFlowStepper(cells, ${list(direction)}, { viscosity: ${smokeViscosity(bounds)} });`,
    `for (let i = 0; i < ${smokeSteps} && stepper.step().status === 'converged'; i++);`,
    'const { time, cellVelocity, cellPressure } = stepper.flow();',
    "console.log(cells.cellVolume.length, 'cells in the wind, at time', time);",
    "await writeFile('flow.vtu', writeCells(tunnel, cells, 'vtu', { fields: { velocity: cellVelocity, pressure: cellPressure } }));",
  ];
}

const smokeSteps = 50;

/** Of streamlines: that of the command line. */
const lineCount = 100;
/** As many levels as there may be, as in JavaScript. */
const levels = 24;

function commandLine(settings: Settings, model: CodeModel, file: string, sections: readonly Section[]): string {
  const { snapTolerance, wind } = settings;
  const mesh = word(file);
  const options = [
    gridOptions(gridOf(settings, model)),
    ...(snapTolerance > 0 ? [`--snap-tolerance ${snapTolerance}`] : []),
    ...(model.estimateMs === null ? [] : ['--inside-threshold 0.5']),
  ].join(' ');
  const slices = sections.map((section) => `mandoline slice ${mesh} ${options} ${planeOptions(section)} -o slice-${section.name}.svg`);
  const flows = wind.on ? [`mandoline flow ${mesh} --wind ${wind.direction.join()} ${flowOptions(settings, model)}`] : [];
  return [`mandoline cut ${mesh} ${options} -o cells.vtu`, ...slices, ...flows, ''].join('\n');
}

function flowOptions(settings: Settings, model: CodeModel): string {
  const { wind } = settings;
  if (!wind.smoke) return `${gridOptions(tunnelOf(settings, model))} --coarsen ${levels} --merge 0 -o flow.vtu streamlines.obj`;
  const bounds = { min: model.meshMin, max: model.meshMax };
  const cells = `${gridOptions(smokeBox(bounds, wind.direction))} --coarsen 0 --merge ${smokeFraction} --unite-walls 30`;
  return `${cells} --steps ${smokeSteps} --viscosity ${smokeViscosity(bounds)} -o flow.vtu`;
}

function gridOptions(grid: Settings['grid']): string {
  return 'min' in grid ? `--box ${[...grid.min, ...grid.max].join()} --cells ${grid.cells.join()}` : `--cells ${grid.cells}`;
}

function planeOptions({ name, normal, offset }: Section): string {
  const across = name !== 'free' && normal.includes(1) ? `--axis ${name}` : `--normal ${normal.join()}`;
  return `${across} --heights ${offset}`;
}

/** For JavaScript. */
function quoted(text: string): string {
  const escapes: Record<string, string> = { '\n': '\\n', '\r': '\\r' };
  return `'${text.replaceAll(/['\\\n\r]/g, (letter) => escapes[letter] ?? `\\${letter}`)}'`;
}

/** For a shell; a name that begins with a dash isn't an option. */
function word(file: string): string {
  const path = file.startsWith('-') ? `./${file}` : file;
  return /^[\w./-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
