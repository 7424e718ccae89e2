// What the gallery offers. Apart from the generators, so that the page can list it without them.
export interface GalleryEntry {
  /** Stands in links, so it stays. */
  name: string;
  title: string;
  /** What to look at. */
  line: string;
  /** A good resolution to start with: grid cells along the longest side. */
  cells: number;
}

export const gallery: readonly GalleryEntry[] = [
  {
    name: 'bunny',
    title: 'Stanford bunny',
    cells: 16,
    line: 'A scan. Slice it to look inside: the cut-cells follow the surface exactly.',
  },
  {
    name: 'hilbert',
    title: 'Hollow Hilbert curve',
    cells: 4,
    line: 'A tube inside a tube: on a coarse grid, several tunnels pierce each cut-cell (Figure 18, Section 5.1).',
  },
  {
    name: 'wavy-plane',
    title: 'Wavy plane',
    cells: 10,
    line: 'An open sheet: it splits grid cells in two, but ends inside those at its rim (Figure 20, Section 5.4).',
  },
  {
    name: 'wavy-slab',
    title: 'Wavy slab',
    cells: 10,
    line: 'A layer thinner than a grid cell: cells are split into several pieces, some of them very thin (Figure 18, Section 5.1).',
  },
  {
    name: 'wedge',
    title: 'Wedge',
    cells: 2,
    line: 'A tetrahedral notch in each of two grid cells, through the face between them (Figure 21a, Section 5.5).',
  },
  {
    name: 'empty-cone',
    title: 'Empty cones',
    cells: 2,
    line: 'Hollow cones whose mouths, open to the outside, lie exactly in an axial plane (Figure 21b, Section 5.5).',
  },
  {
    name: 'claw',
    title: 'Claw',
    cells: 2,
    line: 'A single curve around three prongs and along the webs between them bounds three faces (Figures 17 and 21c, Section 5.5).',
  },
  {
    name: 'oscillator',
    title: 'Oscillator',
    cells: 2,
    line: "The top swings through the middle plane several times: the plane's faces are rings within rings (Figure 21d, Section 5.5).",
  },
  {
    name: 'nested-spheres',
    title: 'Nested spheres',
    cells: 10,
    line: 'Spheres inside spheres, alternately solid and hollow: five surfaces make six regions, the smallest within a single grid cell.',
  },
  {
    name: 'thin-bowl',
    title: 'Thin bowl',
    cells: 12,
    line: 'A wall far thinner than a grid cell: it still has its own inside, and no cut-cell reaches through it.',
  },
  {
    name: 'double-bubble',
    title: 'Double bubble',
    cells: 12,
    line: 'Three sheets meet along the rim of the wall: non-manifold and without winding numbers, yet with three regions.',
  },
  {
    name: 'moebius-strip',
    title: 'Möbius strip',
    cells: 12,
    line: 'A sheet with one side and one edge: the cells on its two sides are neighbours around the edge. It bounds nothing.',
  },
  {
    name: 'torus-knot',
    title: 'Torus knot',
    cells: 14,
    line: 'A knotted tube: strands that share a grid cell become separate cut-cells.',
  },
  {
    name: 'chain',
    title: 'Chain',
    cells: 14,
    line: 'Three linked rings that do not touch: three regions inside, one around them.',
  },
  {
    name: 'noisy-sphere',
    title: 'Noisy sphere',
    cells: 8,
    line: 'Spikes everywhere: the coarser the grid, the more of them each cut-cell keeps (Figure 19, Section 5.2).',
  },
  {
    name: 'gears',
    title: 'Gears',
    cells: 20,
    line: 'Sharp edges, flat sides and narrow gaps: the teeth do not touch, so the two gears stay separate regions.',
  },
  {
    name: 'aligned-steps',
    title: 'Aligned steps',
    cells: 22,
    line: 'Every face lies exactly in an axial plane: pieces of the surface replace grid-faces, and no slivers appear.',
  },
  {
    name: 'trumpet',
    title: 'Trumpet',
    cells: 12,
    line: 'Open at both ends, with a wall of no thickness: cells are cut along it, and where its inside ends is an estimate.',
  },
  {
    name: 'pages',
    title: 'Three pages',
    cells: 8,
    line: 'Three sheets that share an edge: cells at the spine are cut into three, cells at the rims only in part.',
  },
  {
    name: 'crate',
    title: 'Crate',
    cells: 9,
    line: 'Walls that cross at shared edges: up to four sheets meet at an edge, and top and bottom are open.',
  },
  {
    name: 'crossing-tori',
    title: 'Crossing tori',
    cells: 16,
    line: 'Two rings, each through the wall of the other: where they overlap are regions of their own, of winding number 2.',
  },
  {
    name: 'pushed-blob',
    title: 'Blob pushed through itself',
    cells: 16,
    line: 'One side of a lumpy blob is pushed in until it comes out at the other, inside out: its tip has winding number −1.',
  },
  {
    name: 'teapot',
    title: 'Teapot',
    cells: 18,
    line: 'Spout and handle are simply stuck through the wall of the pot: the cut finds what lies in which of them.',
  },
  {
    name: 'klein-bottle',
    title: 'Klein bottle',
    cells: 16,
    line: 'A closed surface with one side, which passes through itself in a ring: its inside is told by parity.',
  },
  {
    name: 'boys-surface',
    title: "Boy's surface",
    cells: 14,
    line: 'A closed surface with one side that crosses itself along three loops, which meet in a triple point.',
  },
];
