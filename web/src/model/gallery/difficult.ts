// The paper's difficult cases (5.5). Their axial plane of interest is y = 0, which halves their bounding box, so that it is a plane of
// every grid around them with an even number of cells along y.
import { fromPoints, merged, moved, revolved, type MeshArrays, type Point } from './mesh';

/** Two tetrahedra base to base: one tetrahedral notch in each of two grid cells, through the face between them. */
export function wedge(): MeshArrays {
  const points: Point[] = [
    [-0.3, 0, 0.25],
    [0.32, 0, 0.15],
    [-0.02, 0, -0.3],
    [0, -0.8, 0.03],
    [0, 0.8, 0.03],
  ];
  return fromPoints(points, [0, 1, 4, 1, 2, 4, 2, 0, 4, 1, 0, 3, 2, 1, 3, 0, 2, 3]);
}

/** Two cones side by side, one opening upward and one downward: each the difference of two tetrahedra that share the face in the plane. */
export function emptyCones(): MeshArrays {
  const points: Point[] = [
    [0.07, 0, 0.34],
    [0.73, 0, 0.34],
    [0.4, 0, -0.36],
    [0.4, -0.8, 0.1],
    [0.4, -0.45, 0.1],
  ];
  const cone = fromPoints(points, [1, 0, 3, 2, 1, 3, 0, 2, 3, 0, 1, 4, 1, 2, 4, 2, 0, 4]);
  return merged(
    cone,
    moved(cone, ([x, y, z]): Point => [-x, y === 0 ? 0 : -y, z]),
  );
}

/**
 * Three prongs above the plane on one keel below it. Between the prongs the keel reaches up to the plane as webs without width: its outline
 * there is one closed curve around all prongs that runs through the webs twice.
 */
export function claw(): MeshArrays {
  const points: Point[] = [
    [0, -0.75, 0.32],
    [0, -0.75, -0.32],
  ];
  const [front, back] = [0, 1];
  const triangles: number[] = [];
  const prongs = [-0.32, -0.05, 0.22].map((x) => {
    const left = points.push([x, 0, -0.1], [x + 0.05, 0, 0.11], [x + 0.1, 0, -0.1], [x + 0.05, 0.75, 0.005]) - 4;
    return { left, middle: left + 1, right: left + 2, tip: left + 3 };
  });
  prongs.forEach(({ left, middle, right, tip }, k) => {
    triangles.push(left, middle, tip, middle, right, tip, right, left, tip);
    triangles.push(middle, left, front, right, middle, front, left, right, back);
    const next = prongs[k + 1];
    if (next) triangles.push(next.left, right, front, right, next.left, back);
  });
  triangles.push(prongs[0].left, back, front, prongs[2].right, front, back);
  return fromPoints(points, triangles);
}

/** A cylinder whose top swings through the plane several times from its middle outward and ends on it at the rim. */
export function oscillator(): MeshArrays {
  const swings: [number, number][] = [
    [0.255, -0.25],
    [0.19, 0.4],
    [0.13, -0.5],
    [0.065, 0.6],
  ];
  return revolved([[0, -0.75], [0.32, -0.75], [0.32, 0], ...swings, [0, 0.75]], 32);
}
