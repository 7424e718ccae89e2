// One shader draws all cells. It looks up per cell what is the same for all of a cell's vertices, so that exploding, colouring and slicing
// only change uniforms and a small texture, never the vertices.
import { BackSide, Color, DoubleSide, FrontSide, ShaderMaterial, Vector2, Vector3, Vector4 } from 'three';
import type { DataTexture, IUniform, Side } from 'three';
import { tableWidth } from './buffers';
import { gridFaceColor } from './colors';
import { lightChunk } from './light';
import { firstBox } from './picking';

export type Uniforms = ReturnType<typeof makeUniforms>;

/** Shared by all materials of a view. */
export function makeUniforms() {
  return {
    cellCenters: { value: null as DataTexture | null },
    cellLooks: { value: null as DataTexture | null },
    regionShifts: { value: null as DataTexture | null },
    explodeCells: { value: 0 },
    explodeRegions: { value: 0 },
    planes: { value: [0, 1, 2, 3].map(() => new Vector4()) },
    planeCount: { value: 0 },
    flatCut: { value: false },
    byKind: { value: false },
    gridFaceColor: { value: new Vector3(...gridFaceColor).divideScalar(255) },
    hovered: { value: -1 },
    pinned: { value: -1 },
    accent: { value: new Color() },
    lineColor: { value: new Color() },
    /** Of boxes around a sheet, seen on the background. */
    boxColor: { value: new Color() },
    /** Mean side of a grid cell. */
    cellSize: { value: 1 },
    /** Whether a sheet is shown, whose two sides are told apart. */
    darkBacks: { value: false },
    /** Height of the picture in CSS pixels. */
    stageHeight: { value: 600 },
    up: { value: new Vector3(0, 1, 0) },
    /** Height of the ground, and the height above it from which on nothing casts a shadow. */
    ground: { value: new Vector2() },
    /** How much is seen of a surface that is only hinted at. */
    faintness: { value: 0.06 },
    /** How dark shadows are, 0 to 1. */
    shade: { value: 0 },
  };
}

type Geometry = 'CELLS' | 'BOXES' | 'CAPS';
export type Purpose = 'FACES' | 'BACKS' | 'LINES' | 'PICK' | 'GHOST' | 'DIMMED' | 'SHADOW';

/** Uniforms of lines: their opacity, the distance from one to the next in the model's units, and the pixels of it below which they fade. */
export function stroke(strength: number, spacing: IUniform<number>, fadeBelow: number) {
  return { strength: { value: strength }, spacing, fadeBelow: { value: fadeBelow } };
}

/** Of lines in axial planes, by default as far from each other as the planes. */
export function gridStroke({ cellSize }: Uniforms, spacing: IUniform<number> = cellSize) {
  return stroke(0.55, spacing, 4);
}

const sides: Record<Purpose, Side> = {
  FACES: FrontSide,
  BACKS: BackSide,
  LINES: FrontSide,
  PICK: DoubleSide,
  GHOST: DoubleSide,
  DIMMED: DoubleSide,
  SHADOW: DoubleSide,
};

export function makeMaterial(geometry: Geometry, purpose: Purpose, shared: Uniforms, own: Record<string, IUniform> = {}): ShaderMaterial {
  const isFaint = purpose === 'GHOST' || purpose === 'DIMMED';
  const isTransparent = purpose === 'LINES' || isFaint;
  const isLit = purpose === 'FACES' || purpose === 'BACKS' || isFaint;
  const material = new ShaderMaterial({
    uniforms: { ...shared, ...own },
    defines: {
      [geometry]: 1,
      [purpose]: 1,
      TABLE_WIDTH: tableWidth,
      FIRST_BOX: firstBox,
      ...(isLit && { LIT: 1 }),
      ...(isFaint && { FAINT: 1 }),
    },
    vertexShader,
    fragmentShader,
    side: geometry === 'CAPS' ? DoubleSide : sides[purpose],
    transparent: isTransparent,
    depthWrite: !isTransparent,
  });
  // Lines lie in front of the faces that they bound, caps before faces in their plane, the front of a face before its neighbour's back.
  const depth = {
    FACES: geometry === 'CAPS' ? 1 : 2,
    BACKS: 3,
    LINES: 0,
    PICK: geometry === 'CAPS' ? 1 : 2,
    GHOST: 2,
    DIMMED: 2,
    SHADOW: 0,
  }[purpose];
  material.polygonOffset = depth > 0;
  material.polygonOffsetFactor = depth / 2;
  material.polygonOffsetUnits = depth;
  return material;
}

const vertexShader = /* glsl */ `
uniform highp sampler2D regionShifts;
uniform float explodeCells;
uniform float explodeRegions;
uniform vec4 planes[4];
uniform int planeCount;
uniform bool flatCut;
uniform int hovered;
uniform int pinned;
varying vec3 vRest;
varying vec3 vView;
varying vec3 vColor;
varying float vHighlight;
flat varying int vCell;
flat varying vec3 vMiddle;
#ifdef LINES
  uniform float strength;
  uniform float spacing;
  uniform float fadeBelow;
  uniform float stageHeight;
  varying float vStrength;
#endif
#ifdef LIT
  varying vec3 vNormal;
#endif
#ifdef SHADOW
  uniform vec3 up;
  uniform vec2 ground;
  varying float vHeight;
#endif

#ifdef CELLS
  uniform highp sampler2D cellCenters;
  uniform highp sampler2D cellLooks;
  uniform bool isSurface;
  uniform bool byKind;
  uniform vec3 gridFaceColor;
  attribute uint cell;
#endif
#ifdef BOXES
  uniform highp sampler2D boxes;
#endif
#ifdef CAPS
  attribute vec3 center;
  attribute float region;
  attribute vec4 tint;
  attribute float owner;
#endif

ivec2 place(int id) {
  return ivec2(id % TABLE_WIDTH, id / TABLE_WIDTH);
}

void main() {
  vCell = -1;
  bool shown = true;
  vec3 middle;
  float regionId;
  #ifndef BOXES
    vRest = position;
  #endif
  #ifdef CELLS
    vCell = int(cell);
    vec4 centerAndRegion = texelFetch(cellCenters, place(vCell), 0);
    vec4 look = texelFetch(cellLooks, place(vCell), 0);
    middle = centerAndRegion.xyz;
    regionId = centerAndRegion.w;
    vColor = look.rgb;
    #ifdef DIMMED
      shown = look.a > 0.1 && look.a < 0.5;
    #elif !defined(GHOST)
      shown = look.a > 0.5;
    #endif
    #ifndef LINES
      // Pieces of grid-faces are paler, so that they differ from the surface in all colours.
      if (!isSurface) vColor = byKind ? gridFaceColor : mix(vColor, vec3(0.88), 0.22);
    #endif
  #endif
  #ifdef BOXES
    int box = gl_VertexID / 8;
    vCell = -2 - box;
    vec4 lowAndRegion = texelFetch(boxes, place(2 * box), 0);
    vec4 sizeAndColor = texelFetch(boxes, place(2 * box + 1), 0);
    vRest = lowAndRegion.xyz + sizeAndColor.xyz * vec3(gl_VertexID & 1, (gl_VertexID >> 1) & 1, (gl_VertexID >> 2) & 1);
    middle = lowAndRegion.xyz + 0.5 * sizeAndColor.xyz;
    regionId = lowAndRegion.w;
    int packed = int(sizeAndColor.w);
    vColor = mix(vec3(packed & 255, (packed >> 8) & 255, packed >> 16) / 255.0, vec3(0.88), 0.22);
  #endif
  #ifdef CAPS
    vCell = int(owner);
    middle = center;
    regionId = region;
    vColor = tint.rgb;
  #endif
  vHighlight = vCell < 0 ? 0.0 : vCell == pinned ? 0.7 : vCell == hovered ? 0.4 : 0.0;
  vMiddle = middle;
  vec3 moved = vRest;
  #ifndef GHOST
    if (!flatCut) {
      for (int p = 0; p < planeCount; p++) shown = shown && dot(planes[p].xyz, middle) <= planes[p].w;
    }
    moved += explodeCells * middle + explodeRegions * texelFetch(regionShifts, place(int(regionId)), 0).xyz;
  #endif
  vec4 seen = modelViewMatrix * vec4(moved, 1.0);
  vView = seen.xyz;
  #ifdef LINES
    // Lines so dense that they fill the picture would only darken it.
    float pixels = spacing * length(modelViewMatrix[0].xyz) * 0.5 * stageHeight * projectionMatrix[1][1] / max(-seen.z, 1e-6);
    vStrength = strength * smoothstep(0.5 * fadeBelow, 2.0 * fadeBelow, pixels);
  #endif
  #ifdef SHADOW
    vHeight = (dot(moved, up) - ground.x) / ground.y;
  #endif
  #ifdef LIT
    vNormal = vec3(0.0);
    #ifdef CELLS
      if (isSurface) vNormal = mat3(modelViewMatrix) * normal;
    #endif
  #endif
  // Beyond the far plane, nothing of the triangle is drawn.
  gl_Position = shown ? projectionMatrix * seen : vec4(0.0, 0.0, 2.0, 1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform vec4 planes[4];
uniform int planeCount;
uniform bool flatCut;
uniform vec3 accent;
varying vec3 vRest;
varying vec3 vColor;
varying float vHighlight;
flat varying int vCell;
flat varying vec3 vMiddle;
#ifdef CAPS
  uniform int ownPlane;
#endif
#ifdef LINES
  uniform vec3 lineColor;
  varying float vStrength;
#endif

#ifdef SHADOW
  varying float vHeight;
#endif

#ifdef FAINT
  uniform float faintness;
#endif
#ifdef LIT
  uniform bool darkBacks;
  varying vec3 vNormal;

  ${lightChunk}
  vec3 lit(vec3 color) {
    // The facet's normal, from its slope on the screen. The smooth one replaces it unless it bends away: on long slivers it may.
    vec3 n = normalize(cross(dFdx(vView), dFdy(vView)));
    if (dot(n, vView) > 0.0) n = -n;
    float along = dot(vNormal, n) / max(length(vNormal), 1e-6);
    if (darkBacks && along < 0.0) color *= 0.55;
    if (abs(along) > 0.5) n = normalize(along < 0.0 ? -vNormal : vNormal);
    return color * light(n);
  }
#endif

void main() {
  #ifndef GHOST
    if (flatCut) {
      for (int p = 0; p < planeCount; p++) {
        #ifdef CAPS
          if (p == ownPlane) continue;
        #endif
        // What lies in the plane belongs to it on the near side alone: a cell beyond it may end there.
        bool isBeyond = dot(planes[p].xyz, vMiddle) > planes[p].w;
        float slack = isBeyond ? 1e-5 * (length(vRest) + abs(planes[p].w)) : 0.0;
        if (dot(planes[p].xyz, vRest) > planes[p].w - slack) discard;
      }
    }
  #endif
  #ifdef PICK
    int id = vCell < -1 ? FIRST_BOX - 2 - vCell : vCell + 1;
    gl_FragColor = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
  #endif
  #ifdef SHADOW
    float near = 1.0 - clamp(vHeight, 0.0, 1.0);
    gl_FragColor = vec4(near * near, 0.0, 0.0, 1.0);
  #endif
  #ifdef LINES
    gl_FragColor = vec4(mix(lineColor, accent, step(0.01, vHighlight)), max(vStrength, step(0.01, vHighlight)));
    #include <colorspace_fragment>
  #endif
  #ifdef LIT
    gl_FragColor = vec4(lit(mix(linear(vColor), accent, vHighlight)), 1.0);
    #ifdef FAINT
      gl_FragColor.a = faintness;
    #endif
    #include <colorspace_fragment>
  #endif
}
`;
