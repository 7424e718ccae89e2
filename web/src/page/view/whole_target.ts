/** Of a square from -1 to 1 that fills what is drawn to; `at` is the place there, 0 to 1. */
export const wholeTargetShader = /* glsl */ `
  varying vec2 at;
  void main() {
    at = uv;
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }`;
