// A mesh at a moment of its motion.
import type { Mandoline } from 'mandoline-wasm';
import type { LoadedMesh } from '../model/calls';
import { makeMover, type Motion, type Mover, type Pose } from '../model/motion';

/** What moved last: most poses are of the same motion. */
let moving: { mesh: LoadedMesh; motion: Motion; mover: Mover } | null = null;

/** With the bounds of all of the motion. */
export function posed(mandoline: Mandoline, mesh: LoadedMesh, pose: Pose | null): LoadedMesh {
  if (!pose) return mesh;
  if (moving?.mesh !== mesh || moving.motion !== pose.motion) {
    moving = { mesh, motion: pose.motion, mover: makeMover(mesh, mandoline.inspect(mesh).triangleComponent, pose.motion) };
  }
  return { ...mesh, ...moving.mover.at(pose.phase), bounds: moving.mover.bounds };
}
