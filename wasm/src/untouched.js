import { cellColorer } from './colors.js';
import { drawing } from './drawing.js';
import { chosenRegions, shiftAlong } from './selection.js';

/** Calls back with the chosen runs of untouched grid cells along x. */
function forEachRun({ grid, rowRunOffsets, runBegin, runEnd, runRegion }, chosen, visit) {
  const ny = grid.cells[1];
  for (let row = 0; row + 1 < rowRunOffsets.length; ++row) {
    for (let run = rowRunOffsets[row]; run < rowRunOffsets[row + 1]; ++run) {
      if (chosen[runRegion[run]]) visit(runBegin[run], runEnd[run], row % ny, Math.floor(row / ny), runRegion[run]);
    }
  }
}

export function chosenUntouched(cutMesh, regions) {
  const chosen = chosenRegions(cutMesh, regions);
  let count = 0;
  forEachRun(cutMesh, chosen, (begin, end) => {
    count += end - begin;
  });
  const gridCell = new Int32Array(3 * count),
    region = new Uint32Array(count);
  let out = 0;
  forEachRun(cutMesh, chosen, (begin, end, j, k, id) => {
    for (let i = begin; i < end; ++i, ++out) {
      gridCell.set([i, j, k], 3 * out);
      region[out] = id;
    }
  });
  return { gridCell, region };
}

export const untouchedCells = drawing('untouchedCells', [], (cutMesh, { regions }) => {
  return chosenUntouched(cutMesh, regions);
});

/** Gives the colour of an untouched grid cell. It has no id of its own: it takes one after the cut-cells, counted through the grid. */
export function untouchedColorer(cutMesh, colorBy, measures) {
  const {
    grid: { cells, planes },
    cellRegion,
  } = cutMesh;
  const colorOf = cellColorer(cutMesh, colorBy, measures);
  return (gridCell, region) => {
    const [i, j, k] = gridCell;
    return colorOf({
      id: cellRegion.length + i + cells[0] * (j + cells[1] * k),
      region,
      volume: [i, j, k].reduce((volume, c, d) => volume * (planes[d][c + 1] - planes[d][c]), 1),
    });
  };
}

// Corners of a box are numbered by bits: bit d is set on the far side of axis d.
const bits = [0, 1, 2, 3, 4, 5, 6, 7];

/** 4 per side, counter-clockwise as seen from outside; the far side of an axis after the near one. */
const sides = [0, 1, 2].flatMap((d) => {
  const [u, v, far] = [1 << ((d + 1) % 3), 1 << ((d + 2) % 3), 1 << d];
  return [
    [0, v, u | v, u],
    [far, far | u, 7, far | v],
  ];
});

const faces = {
  corners: sides.flat(),
  index: sides.flatMap((_, side) => [0, 1, 2, 0, 2, 3].map((corner) => 4 * side + corner)),
};
const edges = {
  corners: bits,
  index: [1, 2, 4].flatMap((far) => bits.filter((corner) => !(corner & far)).flatMap((near) => [near, near | far])),
};
const boxNormals = sides
  .flatMap((_, side) => {
    return Array(4).fill([0, 1, 2].map((d) => (d === side >> 1 ? 2 * (side & 1) - 1 : 0)));
  })
  .flat();

/** Repeats the numbers of one box, `each`, for all boxes, adding `step` from box to box. */
function repeated(array, each, step) {
  for (let i = 0; i < array.length; ++i) array[i] = each[i % each.length] + step * Math.floor(i / each.length);
  return array;
}

function boxArrays({ grid }, gridCell, { corners, index }, options) {
  const count = gridCell.length / 3;
  const position = new Float32Array(3 * corners.length * count);
  for (let d = 0; d < 3; ++d) {
    const planes = grid.planes[d];
    const shiftOf = shiftAlong(grid, d, options);
    for (let box = 0; box < count; ++box) {
      const near = planes[gridCell[3 * box + d]],
        far = planes[gridCell[3 * box + d] + 1];
      const shift = shiftOf(0.5 * (near + far));
      for (let i = 0; i < corners.length; ++i) {
        position[3 * (corners.length * box + i) + d] = ((corners[i] >> d) & 1 ? far : near) + shift;
      }
    }
  }
  return { position, index: repeated(new Uint32Array(index.length * count), index, corners.length) };
}

/** Boxes with a colour each: { position, normal, color, index }. */
export function untouchedFaces(cutMesh, options) {
  const { gridCell, region } = chosenUntouched(cutMesh, options.regions);
  const colorOf = untouchedColorer(cutMesh, options.colorBy, options.measures);
  const { position, index } = boxArrays(cutMesh, gridCell, faces, options);
  const color = new Float32Array(position.length);
  for (let box = 0; box < region.length; ++box) {
    const own = colorOf(gridCell.subarray(3 * box, 3 * box + 3), region[box]);
    for (let i = 0; i < boxNormals.length; ++i) color[boxNormals.length * box + i] = own[i % 3];
  }
  return { position, normal: repeated(new Float32Array(position.length), boxNormals, 0), color, index };
}

/** { position, index } */
export function untouchedEdges(cutMesh, options) {
  return boxArrays(cutMesh, chosenUntouched(cutMesh, options.regions).gridCell, edges, options);
}
