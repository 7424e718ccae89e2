// Flows through a tunnel, of winds of length 1. A flow is linear in its wind, so that those of winds along the axes give all others: the
// wind can be turned without solving again. Where the surface divides the tunnel that isn't so, since there the wind is held back.
import type { Flow, SolveStatus } from 'mandoline-wasm/physics';
import { pageError } from '../../model/failure';
import type { Vector3 } from '../../model/vector';
import type { Package } from './package';
import type { Tunnel } from './tunnel';

/** What is drawn of a flow. */
export type Velocities = Pick<Flow, 'wind' | 'cellVelocity' | 'cellGradient' | 'throttled'>;

/** The flow of a wind in this direction, solved or combined. */
export function flowOf(pack: Package, tunnel: Tunnel, direction: Vector3): Promise<Velocities> | Velocities {
  return combined(tunnel, direction) ?? solvedFlow(pack, tunnel, direction);
}

/** The same, solved for this very wind. */
export async function solvedFlow({ physics }: Package, tunnel: Tunnel, direction: Vector3): Promise<Flow> {
  const wind = [direction[0], direction[1], direction[2]] as [number, number, number];
  const known = [...tunnel.axes, tunnel.other].find((flow) => flow?.wind.every((x, d) => x === wind[d]));
  if (known) return known;
  const flow = await physics.solveFlow(tunnel.cells, wind);
  if (flow.status !== 'converged') throw notSolved(flow.status);
  const axis = axisOf(wind);
  if (axis === null) tunnel.other = flow;
  else tunnel.axes[axis] = flow;
  return flow;
}

/** Solves for the wind along an axis for which there is no flow yet; whether that was of use. */
export async function solveAhead(pack: Package, tunnel: Tunnel): Promise<boolean> {
  const axis = tunnel.axes.indexOf(null);
  if (axis < 0 || isThrottled(tunnel)) return false;
  await solvedFlow(
    pack,
    tunnel,
    [0, 1, 2].map((d) => Number(d === axis)),
  );
  return true;
}

function axisOf(wind: Vector3): number | null {
  return wind.filter((x) => x === 0).length === 2 && wind.includes(1) ? wind.indexOf(1) : null;
}

function isThrottled({ axes, other }: Tunnel): boolean {
  return [...axes, other].some((flow) => flow && flow.throttled.length > 0);
}

function combined(tunnel: Tunnel, direction: Vector3): Velocities | null {
  if (isThrottled(tunnel)) return null;
  const terms = direction.map((factor, d) => ({ factor, flow: tunnel.axes[d] })).filter(({ factor }) => factor !== 0);
  if (terms.some(({ flow }) => !flow)) return null;
  const sum = (key: 'cellVelocity' | 'cellGradient') => {
    const values = new Float64Array(tunnel.cells.cellRegion.length * (key === 'cellVelocity' ? 3 : 6));
    for (const { factor, flow } of terms) {
      const own = (flow as Flow)[key];
      for (let at = 0; at < values.length; at++) values[at] += factor * own[at];
    }
    return values;
  };
  const [x, y, z] = direction;
  return { wind: [x, y, z], cellVelocity: sum('cellVelocity'), cellGradient: sum('cellGradient'), throttled: new Uint32Array(0) };
}

const reasons: Record<Exclude<SolveStatus, 'converged'>, string> = {
  iterationLimit: 'the solver did not come to an end',
  incompatible: 'as much as flows in can not flow out',
  unresolved: 'rounding decides what it is in some cells',
  breakdown: 'its numbers, or the differences between them, are too large or too small',
};

function notSolved(status: Exclude<SolveStatus, 'converged'>): unknown {
  const detail = `There is none to show: ${reasons[status]}. Try another number of cells, or another direction.`;
  return pageError('The flow was not solved', detail);
}
