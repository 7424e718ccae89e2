// Surfaces that move, to be cut at any moment: functions of a mesh and of the phase, which counts periods from 0.
import type { MeshArrays } from './gallery/mesh';
import { boundsOf, type Bounds } from './grid_around';
import type { Vector3 } from './vector';

/** A wave runs through the mesh; its parts turn, like gears; one part passes through the others, or a copy of the mesh through the mesh. */
export const motions = ['wave', 'turn', 'pass'] as const;
export type Motion = (typeof motions)[number];

/** A moment of a motion. */
export interface Pose {
  motion: Motion;
  phase: number;
}

export interface Mover {
  /** The mesh never leaves it. */
  bounds: Bounds;
  at(phase: number): MeshArrays;
}

/** Of the longest side. */
const waveHeight = 0.06;
const waveLength = 0.8;
const passWay = 0.6;

/** `triangleComponent` says which triangles move together. */
export function makeMover(mesh: MeshArrays, triangleComponent: ArrayLike<number>, motion: Motion): Mover {
  if (motion === 'wave') return wave(mesh);
  if (motion === 'turn') return turning(mesh, triangleComponent);
  return passing(mesh, triangleComponent);
}

function sidesOf({ min, max }: Bounds): number[] {
  return max.map((x, d) => x - min[d]);
}

/** The axes from the longest side of a box to the shortest. */
function axesBySide(bounds: Bounds): number[] {
  const sides = sidesOf(bounds);
  return [0, 1, 2].sort((a, b) => sides[b] - sides[a]);
}

function grown({ min, max }: Bounds, reach: readonly number[]): Bounds {
  const moved = ([x, y, z]: Vector3, sign: number): Vector3 => [x + sign * reach[0], y + sign * reach[1], z + sign * reach[2]];
  return { min: moved(min, -1), max: moved(max, 1) };
}

/** Along the longest side, up and down the shortest. */
function wave(mesh: MeshArrays): Mover {
  const bounds = boundsOf(mesh);
  const [along, , across] = axesBySide(bounds);
  const longest = sidesOf(bounds)[along];
  const turns = 1 / (waveLength * longest || 1);
  const at = (phase: number): MeshArrays => {
    const positions = Float64Array.from(mesh.positions);
    for (let v = 0; v < positions.length; v += 3) {
      const place = (positions[v + along] - bounds.min[along]) * turns;
      positions[v + across] += waveHeight * longest * Math.sin(2 * Math.PI * (phase - place));
    }
    return { positions, triangles: mesh.triangles };
  };
  return { bounds: grown(bounds, unit(across, waveHeight * longest)), at };
}

function unit(axis: number, length: number): number[] {
  return [0, 1, 2].map((d) => (d === axis ? length : 0));
}

interface Part {
  bounds: Bounds;
  center: number[];
  /** It turns about this axis, along its shortest side. */
  axis: number;
  radius: number;
}

/** Neighbouring parts turn in opposite directions, each as fast as its size lets gears turn: the largest once per period. */
function turning(mesh: MeshArrays, triangleComponent: ArrayLike<number>): Mover {
  const owner = vertexParts(mesh, triangleComponent);
  const parts = partsOf(mesh, owner);
  const largest = Math.max(...parts.map(({ radius }) => radius));
  const at = (phase: number): MeshArrays => {
    const positions = Float64Array.from(mesh.positions);
    const turns = parts.map(({ radius }, part) => {
      const angle = ((part % 2 === 0 ? 2 : -2) * Math.PI * phase * largest) / (radius || 1);
      return [Math.cos(angle), Math.sin(angle)];
    });
    owner.forEach((part, vertex) => {
      if (part < 0) return;
      const { axis, center } = parts[part];
      const [cos, sin] = turns[part];
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      const [x, y] = [positions[3 * vertex + u] - center[u], positions[3 * vertex + v] - center[v]];
      positions[3 * vertex + u] = center[u] + cos * x - sin * y;
      positions[3 * vertex + v] = center[v] + sin * x + cos * y;
    });
    return { positions, triangles: mesh.triangles };
  };
  return { bounds: around(parts.map(sweptBox)), at };
}

/** Per vertex: the component that uses it first, or -1. */
function vertexParts({ positions, triangles }: MeshArrays, triangleComponent: ArrayLike<number>): Int32Array {
  const parts = new Int32Array(positions.length / 3).fill(-1);
  for (let corner = triangles.length - 1; corner >= 0; corner--) parts[triangles[corner]] = triangleComponent[Math.floor(corner / 3)];
  return parts;
}

function partsOf({ positions }: MeshArrays, owner: Int32Array): Part[] {
  const boxes: { min: number[]; max: number[] }[] = [];
  owner.forEach((part, vertex) => {
    if (part < 0) return;
    boxes[part] ??= { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
    for (let d = 0; d < 3; d++) {
      boxes[part].min[d] = Math.min(boxes[part].min[d], positions[3 * vertex + d]);
      boxes[part].max[d] = Math.max(boxes[part].max[d], positions[3 * vertex + d]);
    }
  });
  // A component whose vertices all belong to others too has no box, and does not move by itself.
  const parts = Array.from(boxes, (box): Part => {
    const bounds = (box ?? { min: [0, 0, 0], max: [0, 0, 0] }) as unknown as Bounds;
    return { bounds, center: bounds.min.map((x, d) => 0.5 * x + 0.5 * bounds.max[d]), axis: axesBySide(bounds)[2], radius: 0 };
  });
  owner.forEach((part, vertex) => {
    if (part < 0) return;
    const { axis, center } = parts[part];
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    parts[part].radius = Math.max(
      parts[part].radius,
      Math.hypot(positions[3 * vertex + u] - center[u], positions[3 * vertex + v] - center[v]),
    );
  });
  return parts;
}

function sweptBox({ bounds, center, axis, radius }: Part): Bounds {
  const end = (own: Vector3, sign: number): Vector3 => {
    const [x, y, z] = center.map((c, d) => (d === axis ? own[d] : c + sign * radius));
    return [x, y, z];
  };
  return { min: end(bounds.min, -1), max: end(bounds.max, 1) };
}

function around(boxes: readonly Bounds[]): Bounds {
  const each = (of: (d: number) => number): Vector3 => [of(0), of(1), of(2)];
  return {
    min: each((d) => Math.min(...boxes.map(({ min }) => min[d]))),
    max: each((d) => Math.max(...boxes.map(({ max }) => max[d]))),
  };
}

/** The first component stays, all others move along the longest side and back. A mesh of one component meets a copy of itself, turned. */
function passing(mesh: MeshArrays, triangleComponent: ArrayLike<number>): Mover {
  const owner = vertexParts(mesh, triangleComponent);
  const isOne = owner.every((part) => part <= 0);
  const whole = isOne ? withCopy(mesh) : mesh;
  const first = isOne ? mesh.positions.length / 3 : 0;
  const moves = (vertex: number) => (isOne ? vertex >= first : owner[vertex] > 0);
  const bounds = boundsOf(whole);
  const [along] = axesBySide(bounds);
  const way = passWay * sidesOf(bounds)[along];
  const at = (phase: number): MeshArrays => {
    const positions = Float64Array.from(whole.positions);
    const shift = way * Math.sin(2 * Math.PI * phase);
    for (let vertex = 0; vertex < positions.length / 3; vertex++) if (moves(vertex)) positions[3 * vertex + along] += shift;
    return { positions, triangles: whole.triangles };
  };
  return { bounds: grown(bounds, unit(along, way)), at };
}

/** With a copy that is turned by a quarter about the longest side. */
function withCopy(mesh: MeshArrays): MeshArrays {
  const bounds = boundsOf(mesh);
  const [axis] = axesBySide(bounds);
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const center = bounds.min.map((x, d) => 0.5 * x + 0.5 * bounds.max[d]);
  const count = mesh.positions.length;
  const positions = new Float64Array(2 * count);
  positions.set(mesh.positions);
  for (let at = 0; at < count; at += 3) {
    positions[count + at + axis] = mesh.positions[at + axis];
    positions[count + at + u] = center[u] - (mesh.positions[at + v] - center[v]);
    positions[count + at + v] = center[v] + (mesh.positions[at + u] - center[u]);
  }
  const triangles = new Uint32Array(2 * mesh.triangles.length);
  triangles.set(mesh.triangles);
  for (let corner = 0; corner < mesh.triangles.length; corner++) {
    triangles[mesh.triangles.length + corner] = mesh.triangles[corner] + count / 3;
  }
  return { positions, triangles };
}
