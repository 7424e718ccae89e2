import { DoubleSide, ShaderMaterial, Vector3, Vector4, type BufferGeometry, type IUniform, Mesh } from 'three';
import type { Smoke, Wind } from '../../../model/wind';
import type { Look } from '../layer';
import { rampTexture, topSpeed } from './colors';

export type WindUniforms = ReturnType<typeof makeWindUniforms>;

/** Shared by all that is drawn of a wind. */
export function makeWindUniforms() {
  return {
    ramp: { value: rampTexture() },
    topSpeed: { value: topSpeed },
    /** Of the ramp: 0 for speeds, 1 for pressures. */
    row: { value: 0 },
    sections: { value: [0, 1, 2, 3].map(() => new Vector4()) },
    sectionCount: { value: 0 },
    /** Half the extent of the tunnel. */
    reach: { value: new Vector3() },
    /** Longest side of the mesh. */
    size: { value: 1 },
  };
}

export function setWindUniforms(uniforms: WindUniforms, { sections, origin, half, size }: Wind, { settings }: Look): void {
  uniforms.row.value = Number(settings.wind.show === 'pressure');
  uniforms.sectionCount.value = sections.length;
  sections.forEach(({ plane: { normal, offset } }, s) => {
    const atOrigin = normal.reduce((sum, n, d) => sum + n * origin[d], 0);
    uniforms.sections.value[s].set(normal[0], normal[1], normal[2], offset - atOrigin);
  });
  uniforms.reach.value.set(half[0], half[1], half[2]);
  uniforms.size.value = size;
}

export function setSmokeUniforms(uniforms: WindUniforms, { size }: Smoke): void {
  uniforms.row.value = uniforms.sectionCount.value = 0;
  uniforms.size.value = size;
}

/** Ribbons along the wind, which let through what is behind them, wherever their shader puts them. */
export function makeRibbons<Geometry extends BufferGeometry>(
  geometry: Geometry,
  shader: { uniforms: Record<string, IUniform>; vertexShader: string; fragmentShader: string },
): Mesh<Geometry, ShaderMaterial> {
  const material = new ShaderMaterial({ ...shader, side: DoubleSide, transparent: true, depthWrite: false });
  const ribbons = new Mesh(geometry, material);
  ribbons.frustumCulled = false;
  return ribbons;
}

/** In vertex shaders: a point of a ribbon in clip space, so many pixels aside from a line that leads `ahead` there. */
export const ribbonChunk = /* glsl */ `
uniform vec2 viewport;

vec4 besideLine(vec3 point, vec3 ahead, float pixels) {
  vec4 seen = modelViewMatrix * vec4(point, 1.0);
  vec4 here = projectionMatrix * seen;
  vec4 there = projectionMatrix * (seen + modelViewMatrix * vec4(ahead, 0.0));
  vec2 along = (there.xy / there.w - here.xy / here.w) * viewport;
  vec2 across = length(along) > 1e-6 ? normalize(vec2(-along.y, along.x)) : vec2(0.0);
  here.xy += across * pixels * 2.0 / viewport * here.w;
  return here;
}
`;

/** In fragment shaders: the colour of a speed, and what lies beyond sections. */
export const windChunk = /* glsl */ `
uniform sampler2D ramp;
uniform float topSpeed;
uniform float row;
uniform vec4 sections[4];
uniform int sectionCount;

vec3 speedColor(float speed) {
  return pow(texture2D(ramp, vec2((clamp(speed / topSpeed, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.25 + 0.5 * row)).rgb, vec3(2.2));
}

/** How far beyond a section other than this one a point is; negative if it is not. */
float beyondSections(vec3 point, int own) {
  float beyond = -1e30;
  for (int s = 0; s < sectionCount; s++) if (s != own) beyond = max(beyond, dot(sections[s].xyz, point) - sections[s].w);
  return beyond;
}
`;

/** A key light from above left of the eye, a weak one from the other side, and light from everywhere, more from above. */
export const windLightChunk = /* glsl */ `
varying vec3 vView;

float light() {
  vec3 n = normalize(cross(dFdx(vView), dFdy(vView)));
  if (dot(n, vView) > 0.0) n = -n;
  float key = max(0.0, dot(n, normalize(vec3(-0.3, 0.5, 0.81))));
  float fill = max(0.0, dot(n, normalize(vec3(0.8, -0.1, 0.4))));
  return 0.42 + 0.5 * key + 0.14 * fill + 0.12 * n.y;
}
`;
