/** The light of all that is shaded: `vView` is where a point is seen, less the eye. */
export const lightChunk = /* glsl */ `
uniform vec3 up;
varying vec3 vView;

vec3 linear(vec3 color) {
  return pow(color, vec3(2.2));
}

/** By the hemisphere, a warm key from above left of the eye, a cool fill from its right, and a rim where the surface turns away. */
vec3 light(vec3 n) {
  vec3 top = mat3(viewMatrix) * up;
  float height = 0.5 + 0.5 * dot(n, top);
  float key = max(0.0, dot(n, normalize(vec3(-0.55, 0.0, 0.7) + 0.75 * top)));
  float fill = max(0.0, dot(n, normalize(vec3(0.8, -0.1, 0.45))));
  float rim = pow(1.0 - abs(dot(n, normalize(vView))), 4.0) * height;
  return mix(vec3(0.26, 0.23, 0.22), vec3(0.46, 0.49, 0.54), height) + key * vec3(0.72, 0.67, 0.59) + fill * vec3(0.10, 0.13, 0.18) + 0.25 * rim;
}
`;
