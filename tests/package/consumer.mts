// A program that only has to compile: what users write, and mistakes that the types must catch.
import { MandolineError, compiledModule, describe, init } from 'mandoline-wasm';
import type {
  CutMesh,
  CutMeshArrays,
  GridInput,
  Location,
  Mandoline,
  Mesh,
  MeshArrays,
  Progress,
  ResolvedMesh,
  WindingRule,
} from 'mandoline-wasm';
import {
  cellArrays,
  cellColors,
  cellEdgeArrays,
  cellEdgeGeometry,
  cellGeometry,
  edgeGeometry,
  meshFromGeometry,
  meshFromObject,
  sliceGeometry,
  untouchedCells,
  untouchedEdgeGeometry,
  untouchedGeometry,
} from 'mandoline-wasm/three';
import * as inline from 'mandoline-wasm/inline';
import { MandolineError as WorkerError, createWorker } from 'mandoline-wasm/worker';
import { BoxGeometry, type BufferGeometry, Matrix4, Object3D } from 'three';

const mesh: Mesh = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], triangles: new Uint16Array([0, 1, 2]) };
const byCells: GridInput = { cells: 8 };
const grids: GridInput[] = [
  { min: [0, 0, 0], max: [1, 1, 1], cells: [2, 2, 2] },
  { origin: [0, 0, 0], spacing: [1, 1, 1], cells: [2, 2, 2] },
  { planes: [[0, 1], [0, 1, 3], new Float64Array(2)] },
];

async function core(): Promise<void> {
  const module: WebAssembly.Module = await compiledModule();
  await init(inline);
  const mandoline: Mandoline = await init({ wasm: await compiledModule() });
  const cutMesh: CutMesh = mandoline.cut(mesh, byCells, { snapTolerance: 0.01, progress: ({ done, total }: Progress) => done < total });
  for (const grid of [cutMesh.grid, ...grids]) mandoline.cut(mesh, grid);
  const prepared: MeshArrays = mandoline.prepare(mesh, { intersections: 'refuse' });
  mandoline.cut(prepared, { cells: 3 });
  const resolved: ResolvedMesh = mandoline.resolve(mesh, { progress: () => {} });
  const rule: WindingRule = 'nonZero';
  const solids: MeshArrays[] = [mandoline.boundary(resolved, rule), mandoline.boundary(cutMesh)];
  const estimated: CutMeshArrays = mandoline.estimateInside(mesh, cutMesh, { threshold: 0.4 });
  const { isInside, by } = mandoline.insideRegions(estimated, { rule });
  solids.push(mandoline.boundary(estimated, isInside), mandoline.boundary(estimated, [true]));
  // @ts-expect-error Only a cut-mesh has regions.
  mandoline.boundary(resolved, isInside);
  // @ts-expect-error There is no such word.
  console.log(by === 'guess', mandoline.generalizedWindingNumbers(mesh, [0, 0, 0])[0]);
  console.log(mandoline.cut(resolved, { cells: 3 }), solids, resolved.remaining.crossing);
  // @ts-expect-error Only what was resolved has winding numbers.
  mandoline.boundary(mesh);
  // @ts-expect-error Open meshes have no winding numbers.
  resolved.frontWinding.length;
  const all: Uint32Array = mandoline.triangulate(cutMesh).triangles;
  const one: Uint32Array = mandoline.triangulate(cutMesh, { cell: 0 });
  const where: Location | null = mandoline.cellAt(cutMesh, [0, 0, 0]);
  const bytes = new Blob([await mandoline.write(mesh, cutMesh, 'vtu')]);
  const checks = (await mandoline.validate(mesh, cutMesh)).checks.filter(({ pass }) => !pass);
  console.log(module, all, one, where?.cell, bytes, checks, mandoline.slice(cutMesh, { normal: [0, 0, 1], offset: 0 }).polygonCell);
  // @ts-expect-error There is no such grid.
  mandoline.cut(mesh, { count: 8 });
  // @ts-expect-error There is no such format.
  await mandoline.write(mesh, cutMesh, 'off');
  // @ts-expect-error Open meshes have no winding numbers.
  cutMesh.regionWinding.length;
}

async function inWorker(): Promise<void> {
  const worker = await createWorker();
  const { signal } = new AbortController();
  const cutMesh: CutMesh = await worker.cut(mesh, { cells: 8 }, { signal, transfer: [new ArrayBuffer(8)], snapTolerance: 0 });
  const all: Uint32Array = (await worker.triangulate(cutMesh, undefined, { signal })).triangles;
  const one: Uint32Array = await worker.triangulate(cutMesh, { region: 0 });
  const prepared: Mesh = await worker.prepare(mesh, { signal, intersections: 'assumeNone' });
  const again: CutMesh = await worker.cut(prepared, { cells: 9 }, { signal });
  const resolved: ResolvedMesh = await worker.resolve(mesh, { signal });
  console.log(again, await worker.boundary(resolved, 'odd', { signal }), await worker.boundary(cutMesh));
  // @ts-expect-error It is a promise.
  worker.measure(mesh, cutMesh).faceArea;
  console.log(all, one);
  worker.terminate();
}

async function drawn(): Promise<void> {
  const { cut, cutEdges, measure, slice, triangulate } = await init();
  const input = meshFromGeometry(new BoxGeometry(), new Matrix4());
  const merged: { positions: Float64Array; triangles: Uint32Array } = meshFromObject(new Object3D());
  const cutMesh = cut(input, { cells: 8 });
  const geometries: BufferGeometry[] = [
    cellGeometry(cutMesh, triangulate(cutMesh), { colorBy: 'volume', measures: measure(input, cutMesh), explode: 0.2 }),
    cellGeometry(cutMesh, triangulate(cutMesh), { faces: 'surface', cells: [0], origin: [1, 2, 3] }),
    cellEdgeGeometry(cutMesh, { regions: [1], measures: measure(input, cutMesh), explode: 0.2 }),
    untouchedGeometry(cutMesh, { regions: [0], colorBy: 'region', explode: 0.2 }),
    untouchedEdgeGeometry(cutMesh, { origin: [1, 2, 3] }),
    edgeGeometry(cutMesh, cutEdges(input, cutMesh), [0, 0, 0]),
    sliceGeometry(cutMesh, slice(cutMesh, { normal: [0, 0, 1], offset: 0 }), { colorBy: 'winding' }),
  ];
  const colors: Float32Array = cellColors(cutMesh, 'cell');
  // @ts-expect-error There are no such colours.
  cellColors(cutMesh, 'kind');
  const places: Int32Array = untouchedCells(cutMesh, { regions: new Uint32Array(1) }).gridCell;
  // @ts-expect-error Untouched cells are chosen by region.
  untouchedGeometry(cutMesh, { cells: [0] });
  console.log(merged, places, cellEdgeArrays(cutMesh, { cells: [0] }).vertex);
  console.log(geometries, colors, cellArrays(cutMesh, triangulate(cutMesh)).normal);
}

try {
  await Promise.all([core(), inWorker(), drawn()]);
} catch (error) {
  const known = error instanceof MandolineError && error instanceof WorkerError;
  if (known && error.code === 'selfIntersection') console.log(error.element, error.element2);
  console.log(describe(error));
}
