// What the gallery offers. Apart from the generators, so that the page can list it without them.
export interface GalleryEntry {
  /** Stands in links, so it stays. */
  name: string;
  title: string;
  /** What to look at. */
  line: string;
  /** How it opens, so that its point is seen: a link's hash without its mesh. */
  preset: string;
}

export const gallery: readonly GalleryEntry[] = [
  {
    name: 'bunny',
    title: 'Stanford bunny',
    preset: 'n=24&x=0.56,1&slice=flat&explode=0.12,0&camera=17.6,14.4,13.4,-1.6,4.9,0',
    line: 'A scan, cut open: grid cells within, and cut-cells that follow the surface exactly.',
  },
  {
    name: 'bunny-in-wind',
    title: 'Wind tunnel',
    preset: 'n=24&explode=0,0&wind=1,0,0&flow=speed',
    line: 'Air flows about the bunny through octree cells and its cut-cells. Turn the arrow: the flow follows.',
  },
  {
    name: 'adaptive-grid',
    title: 'Adaptive grid',
    preset: 'n=24&explode=0,0&z=0.5,1&slice=flat&wind=1,0,0&flow=speed&camera=6,9,36,0.5,3.9,0',
    line: 'Small cells at the surface, large ones away from it: an octree around the cut-cells (Figures 1 and 23, Section 5.3).',
  },
  {
    name: 'passing-tori',
    title: 'Passing rings',
    preset: 'n=16&color=region&pose=pass,0.08',
    line: 'One ring moves through another, and every picture is cut anew: where they overlap is a region of its own.',
  },
  {
    name: 'turning-gears',
    title: 'Turning gears',
    preset: 'n=20&color=region&pose=turn,0',
    line: 'Two gears turn in a grid that stands still: every picture is cut anew, whatever the teeth come to lie in.',
  },
  {
    name: 'hilbert',
    title: 'Hollow Hilbert curve',
    preset: 'n=4&z=0.62,1&slice=flat&camera=4.49,3.86,10.2,1.5,1.45,1',
    line: 'A tube inside a tube: on a coarse grid, several tunnels pierce each cut-cell (Figure 18, Section 5.1).',
  },
  {
    name: 'wavy-plane',
    title: 'Wavy plane',
    preset: 'n=10&z=0.5,1&slice=flat&explode=0.1,0&color=cell&show=surface,gridFaces,edges,cutCells,outside&camera=1.17,2.01,3.29,0,0,-0.3',
    line: 'An open sheet: it splits grid cells in two, but ends inside those at its rim (Figure 20, Section 5.4).',
  },
  {
    name: 'wavy-slab',
    title: 'Wavy slab',
    preset: 'n=10&z=0.5,1&slice=flat&explode=0.1,0&color=cell&show=surface,gridFaces,edges,cutCells,outside&camera=1.17,2.01,3.29,0,0,-0.3',
    line: 'A layer thinner than a grid cell: cells are split into several pieces, some of them very thin (Figure 18, Section 5.1).',
  },
  {
    name: 'wedge',
    title: 'Wedge',
    preset: 'n=2&explode=0.5,0&region=1&camera=1.88,3.08,3.54,0,-0.05,0',
    line: 'A tetrahedral notch in each of two grid cells, through the face between them (Figure 21a, Section 5.5).',
  },
  {
    name: 'empty-cone',
    title: 'Empty cones',
    preset:
      'n=2&z=0.53,1&slice=flat&explode=0.08,0&color=region&show=surface,gridFaces,edges,untouched,cutCells,outside&camera=1.46,1.74,3.62,0,0,0',
    line: 'Hollow cones whose mouths, open to the outside, lie exactly in an axial plane (Figure 21b, Section 5.5).',
  },
  {
    name: 'claw',
    title: 'Claw',
    preset:
      'n=2&y=0.5,1&slice=flat&explode=0,0&color=region&show=surface,edges,untouched,cutCells,outside&camera=0.929,1.73,1.75,0,-0.32,0',
    line: 'A single curve around three prongs and along the webs between them bounds three faces (Figures 17 and 21c, Section 5.5).',
  },
  {
    name: 'oscillator',
    title: 'Oscillator',
    preset:
      'n=2&y=0.5,1&slice=flat&explode=0,0&color=region&show=surface,edges,untouched,cutCells,outside&camera=0.929,1.73,1.75,0,-0.32,0',
    line: "The top swings through the middle plane several times: the plane's faces are rings within rings (Figure 21d, Section 5.5).",
  },
  {
    name: 'nested-spheres',
    title: 'Nested spheres',
    preset: 'n=10&z=0.5545,1&slice=flat&color=region&camera=1.55,1.08,4.27,0,-0.05,0',
    line: 'Spheres inside spheres, alternately solid and hollow: five surfaces make six regions, the smallest within a single grid cell.',
  },
  {
    name: 'thin-bowl',
    title: 'Thin bowl',
    preset: 'n=12&z=0.5,1&slice=flat&color=cell&show=surface,gridFaces,edges,cutCells,outside&camera=1.04,0.734,3.98,0,-0.5,-0.2',
    line: 'A wall far thinner than a grid cell: it still has its own inside, and no cut-cell reaches through it.',
  },
  {
    name: 'double-bubble',
    title: 'Double bubble',
    preset: 'n=12&z=0.5,1&slice=flat&color=region&camera=2.21,1.42,6.82,0,-0.1,0',
    line: 'Three sheets meet along the rim of the wall: non-manifold and without winding numbers, yet with three regions.',
  },
  {
    name: 'moebius-strip',
    title: 'Möbius strip',
    preset: 'n=12&explode=0.1,0&color=cell&show=surface,edges,cutCells,outside&camera=2.68,3.33,3.55,0.2,-0.05,0',
    line: 'A sheet with one side and one edge: the cells on its two sides are neighbours around the edge. It bounds nothing.',
  },
  {
    name: 'torus-knot',
    title: 'Torus knot',
    preset: 'n=14&explode=0.4,0&color=cell',
    line: 'A knotted tube: strands that share a grid cell become separate cut-cells.',
  },
  {
    name: 'chain',
    title: 'Chain',
    preset: 'n=14&color=region',
    line: 'Three linked rings that do not touch: three regions inside, one around them.',
  },
  {
    name: 'noisy-sphere',
    title: 'Noisy sphere',
    preset: 'n=4&explode=0.4,0&color=cell',
    line: 'Spikes everywhere: the coarser the grid, the more of them each cut-cell keeps (Figure 19, Section 5.2).',
  },
  {
    name: 'gears',
    title: 'Gears',
    preset: 'n=20&color=region',
    line: 'Sharp edges, flat sides and narrow gaps: the teeth do not touch, so the two gears stay separate regions.',
  },
  {
    name: 'aligned-steps',
    title: 'Aligned steps',
    preset: 'n=22&explode=0.2,0&color=volume',
    line: 'Every face lies exactly in an axial plane: pieces of the surface replace grid-faces, and no slivers appear.',
  },
  {
    name: 'trumpet',
    title: 'Trumpet',
    preset: 'n=12&z=0.5,1&slice=flat&camera=1.39,1.29,4.28,0,0,0',
    line: 'Open at both ends, with a wall of no thickness: cells are cut along it, and where its inside ends is an estimate.',
  },
  {
    name: 'pages',
    title: 'Three pages',
    preset: 'n=8&y=0.5,1&slice=flat&color=cell&show=surface,gridFaces,edges,cutCells,outside&camera=0.985,4.04,2.64,-0.2,-0.45,0.1',
    line: 'Three sheets that share an edge: cells at the spine are cut into three, cells at the rims only in part.',
  },
  {
    name: 'crate',
    title: 'Crate',
    preset: 'n=9&y=0.5,1&slice=flat&color=cell&show=surface,gridFaces,edges,cutCells,outside&camera=2.27,8.57,5.08,-0.1,-0.4,0',
    line: 'Walls that cross at shared edges: up to four sheets meet at an edge, and top and bottom are open.',
  },
  {
    name: 'crossing-tori',
    title: 'Crossing tori',
    preset: 'n=16&free=0.5,0,0.894,0.447&slice=flat&color=winding&camera=0.828,5.24,4.69,0,-0.05,0',
    line: 'Two rings, each through the wall of the other: where they overlap are regions of their own, of winding number 2.',
  },
  {
    name: 'pushed-blob',
    title: 'Blob pushed through itself',
    preset: 'n=16&free=0.5,-0.591,0,0.806&slice=flat&color=winding&camera=-2.1,1.33,4.83,0.15,0,0',
    line: 'One side of a lumpy blob is pushed in until it comes out at the other, inside out: its tip has winding number −1.',
  },
  {
    name: 'teapot',
    title: 'Utah teapot',
    preset: 'n=32&z=0.5,1&slice=flat&explode=0,0',
    line: "Newell's 32 patches as they are: spout and handle stick through the wall, and around the lid is a gap. What is inside is an estimate.",
  },
  {
    name: 'klein-bottle',
    title: 'Klein bottle',
    preset: 'n=16&z=0.5,1&slice=flat&camera=2.5,3.47,7.42,-0.2,1.5,0',
    line: 'A closed surface with one side, which passes through itself in a ring: its inside is told by parity.',
  },
  {
    name: 'boys-surface',
    title: "Boy's surface",
    preset: 'n=14&y=0.66,1&slice=flat&camera=1.22,4.65,3.34,0,-1.05,0',
    line: 'A closed surface with one side that crosses itself along three loops, which meet in a triple point.',
  },
];
