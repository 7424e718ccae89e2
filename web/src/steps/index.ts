// The steps of the algorithm on the current mesh, worked out from the cut-mesh's arrays alone. Runs in the page's worker: no DOM.
//
// The engine calls
//   stepPicture(mesh, cutMesh, faceTriangles, request, origin)
// with the mesh that was cut, mandoline.triangulate(cutMesh), and the model's origin. A request without an item picks an interesting one, and
// the picture's `choices.request` names it. A request for an item that does not exist (any more) picks one, too.
