import { Color, DataTexture, LinearFilter, SRGBColorSpace, type Scene } from 'three';
import type { Uniforms } from './material';

/** Backgrounds go from top to bottom; `shade` is how dark shadows are. */
const schemes = {
  light: { background: ['#f4f2ee', '#ebe8e2'], line: '#2a3440', box: '#2a3440', accent: '#e0218a', shade: 0.5 },
  dark: { background: ['#1b2028', '#12151a'], line: '#0d1116', box: '#c3ccd6', accent: '#ff4fa8', shade: 0.75 },
};

export function setScheme(dark: boolean, scene: Scene, uniforms: Uniforms): void {
  const { background, line, box, accent, shade } = dark ? schemes.dark : schemes.light;
  if (scene.background instanceof DataTexture) scene.background.dispose();
  scene.background = gradient(background);
  uniforms.lineColor.value.set(line);
  uniforms.boxColor.value.set(box);
  uniforms.accent.value.set(accent);
  uniforms.shade.value = shade;
}

function gradient(colors: readonly string[]): DataTexture {
  const bytesOf = (color: string) => new Color(color).convertLinearToSRGB().toArray();
  const bytes = [...colors].reverse().flatMap((color) => [...bytesOf(color).map((x) => Math.round(255 * x)), 255]);
  const texture = new DataTexture(Uint8Array.from(bytes), 1, colors.length);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
