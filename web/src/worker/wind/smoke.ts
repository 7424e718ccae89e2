// A flow in time about a mesh, stepped on merged cells in a box that reaches far behind it. Its velocities are told on the grid of the cut.
import type { CutMesh } from 'mandoline-wasm';
import type { CellComplex, FlowStepper, MergedCells, SolveStatus } from 'mandoline-wasm/physics';
import type { LoadedMesh } from '../../model/calls';
import { pageError } from '../../model/failure';
import { longestSide, smokeBox, smokeFraction, smokeViscosity } from '../../model/smoke_box';
import type { Vector3 } from '../../model/vector';
import type { Smoke, SmokeRequest, SmokeState } from '../../model/wind';
import { posed } from '../posed';
import type { Package } from './package';
import { openRegions } from './tunnel';

/** How far the flow at the beginning differs from that of the wind, of its speed: without that, a wake behind what is symmetric stays so. */
const gust = 0.15;
/** What is drawn doesn't show more. */
const tolerance = 1e-4;
/** Steps are long. */
const courant = 0.8;

/** Steps, and tells the states that it comes to. */
export class SmokeFlow {
  private constructor(
    private readonly stepper: FlowStepper,
    private readonly told: Told,
    private readonly wind: Vector3,
    private readonly size: number,
  ) {}

  static async begin(pack: Package, loaded: LoadedMesh, request: SmokeRequest): Promise<{ flow: SmokeFlow; smoke: Smoke }> {
    const { physics, mandoline } = pack;
    const { direction } = request;
    const mesh = posed(mandoline, loaded, request.pose);
    const { min, max } = mesh.bounds;
    const size = longestSide(mesh.bounds);
    const box = smokeBox(mesh.bounds, direction);
    const cutMesh = mandoline.cut(mesh, box, { keep: true });
    const whole = await physics.cellComplex(mesh, cutMesh);
    const merged = await physics.mergeSmallCells(cutMesh, whole, { fraction: smokeFraction });
    const united = await physics.uniteWalls(cutMesh, merged.cells);
    const { cells, wholeCell } = await physics.subComplex(united, openCells(united, cutMesh));
    const wind = [direction[0], direction[1], direction[2]] as [number, number, number];
    const stepper = await physics.createFlowStepper(cells, wind, {
      viscosity: smokeViscosity(mesh.bounds),
      corrections: 0,
      tolerance,
      courant,
    });
    stepper.start(gusty(stepper.flow().cellVelocity, cells, size));
    const flow = new SmokeFlow(stepper, new Told(cutMesh, whole, merged, wholeCell), direction, size);
    const origin = min.map((x, d) => (x + max[d]) / 2);
    return {
      flow,
      smoke: {
        direction,
        origin,
        size,
        half: max.map((x, d) => (x - min[d]) / 2),
        corner: box.min.map((x, d) => x - origin[d]),
        side: (box.max[0] - box.min[0]) / box.cells[0],
        counts: box.cells,
        cells: cells.cellVolume.length,
        begin: flow.state(),
      },
    };
  }

  step(): SmokeState {
    const { status } = this.stepper.step();
    if (status !== 'converged') throw pageError('The smoke has stopped', `${reasons[status]} Try another direction of the wind.`);
    return this.state();
  }

  end(): void {
    this.stepper.free();
  }

  private state(): SmokeState {
    const { time, cellVelocity } = this.stepper.flow();
    const [{ pressure, viscous }] = this.stepper.forces();
    const unit = (this.size * this.size) / 2;
    const force = pressure.map((x, d) => (x + viscous[d]) / unit);
    const drag = force.reduce((sum, x, d) => sum + x * this.wind[d], 0);
    const lift = Math.hypot(...force.map((x, d) => x - drag * this.wind[d]));
    return { time, velocity: this.told.velocities(cellVelocity), drag, lift };
  }
}

const reasons: Record<Exclude<SolveStatus, 'converged'>, string> = {
  iterationLimit: 'The solver did not come to an end.',
  incompatible: 'As much as flows in can not flow out.',
  unresolved: 'Rounding decides what it is in some cells.',
  breakdown: 'The flow came to rest, or its numbers became too large or too small.',
};

/** Those of regions that reach the box: nothing flows in the others. */
function openCells(cells: CellComplex, { regionCount }: CutMesh): Uint32Array {
  const isOpen = openRegions(cells, regionCount);
  return Uint32Array.from(cells.cellRegion.keys()).filter((cell) => isOpen[cells.cellRegion[cell]]);
}

/** The velocities with waves across them. */
function gusty(velocity: Float64Array, { cellCentroid }: CellComplex, size: number): Float64Array {
  return velocity.map((value, at) => {
    const [x, y, z] = [0, 1, 2].map((d) => cellCentroid[at - (at % 3) + d] / size);
    return value + gust * [Math.sin(3 * y + 2 * z), Math.sin(3 * x + 2 * z), Math.sin(4 * x + 2 * y)][at % 3];
  });
}

/** Layers of cells in bodies that have the velocities beside them, for what lies between these and the surface. */
const layers = 2;

/** How velocities of merged cells make those of grid cells. */
class Told {
  /** Per part of a grid cell: the grid cell, the merged cell, and its share of the grid cell. */
  private readonly place: number[] = [];
  private readonly cell: number[] = [];
  private readonly share: number[] = [];
  /** Pairs of a grid cell in a body and one beside it, and the share of the latter in the former. */
  private readonly beside: { to: number; from: number; share: number }[] = [];
  private readonly count: number;

  constructor({ grid }: CutMesh, whole: CellComplex, { mergedCell }: MergedCells, wholeCell: Uint32Array) {
    const [nx, ny, nz] = grid.cells;
    this.count = nx * ny * nz;
    const known = new Float64Array(this.count);
    const own = new Map(Array.from(wholeCell, (cell, at) => [cell, at]));
    mergedCell.forEach((merged, part) => {
      const cell = own.get(merged);
      if (cell === undefined || whole.cellVolume[part] <= 0) return;
      const [x, y, z] = whole.cellCorner.subarray(3 * part, 3 * part + 3);
      this.place.push(x + nx * (y + ny * z));
      this.cell.push(cell);
      this.share.push(whole.cellVolume[part]);
      known[x + nx * (y + ny * z)] += whole.cellVolume[part];
    });
    this.place.forEach((place, part) => (this.share[part] /= known[place]));
    for (let layer = 0; layer < layers; layer++) this.addLayer(known, [nx, ny, nz]);
  }

  /** Of cells that have no velocity, beside those that have one. */
  private addLayer(known: Float64Array, counts: Vector3): void {
    const strides = [1, counts[0], counts[0] * counts[1]];
    const first = this.beside.length;
    for (let to = 0; to < this.count; to++) {
      if (known[to] > 0) continue;
      const sides = strides.flatMap((stride, d) => {
        const at = Math.floor(to / stride) % counts[d];
        return [...(at > 0 ? [to - stride] : []), ...(at + 1 < counts[d] ? [to + stride] : [])];
      });
      const from = sides.filter((side) => known[side] > 0);
      for (const side of from) this.beside.push({ to, from: side, share: 1 / from.length });
    }
    for (const { to } of this.beside.slice(first)) known[to] = 1;
  }

  velocities(cellVelocity: Float64Array): Float32Array {
    const result = new Float32Array(3 * this.count);
    const { place, cell, share } = this;
    for (let part = 0; part < place.length; part++) {
      for (let d = 0; d < 3; d++) result[3 * place[part] + d] += share[part] * cellVelocity[3 * cell[part] + d];
    }
    for (const { to, from, share: part } of this.beside) for (let d = 0; d < 3; d++) result[3 * to + d] += part * result[3 * from + d];
    return result;
  }
}
