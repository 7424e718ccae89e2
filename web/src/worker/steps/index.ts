// The steps of the algorithm on the current mesh, worked out from the cut-mesh's arrays alone. Runs in the page's worker: no DOM.
//
// The engine calls
//   stepPicture(mesh, cutMesh, faceTriangles, request, origin)
// with the mesh that was cut, mandoline.triangulate(cutMesh), and the model's origin. A request without an item picks an interesting one,
// and the picture's `choices.request` names it. A request for an item that does not exist (any more) picks one, too.
import type { CutMesh, FaceTriangles } from 'mandoline-wasm';
import type { Vector3 } from '../../model/vector';
import type { MeshArrays } from '../../model/gallery/mesh';
import type { StepKind, StepPicture, StepRequest } from '../../model/instead';
import { axialPlane, gridCell, triangleFaces } from './pieces';
import { hybridEdges, triEdges } from './edges';
import type { Subject } from './picture';

const steps: Record<StepKind, (subject: Subject, request: StepRequest) => StepPicture> = {
  triEdges,
  hybridEdges,
  triangleFaces,
  axialPlane,
  gridCell,
};

export function stepPicture(
  mesh: MeshArrays,
  cutMesh: CutMesh,
  faceTriangles: FaceTriangles,
  request: StepRequest,
  origin: Vector3,
): StepPicture {
  return steps[request.kind]({ mesh, cutMesh, faceTriangles, origin }, request);
}
