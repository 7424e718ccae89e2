import { Color, DataTexture, LinearFilter, SRGBColorSpace } from 'three';

/** From top to bottom. */
export function gradient(colors: readonly string[]): DataTexture {
  const bytesOf = (color: string) => new Color(color).convertLinearToSRGB().toArray();
  const bytes = [...colors].reverse().flatMap((color) => [...bytesOf(color).map((x) => Math.round(255 * x)), 255]);
  const texture = new DataTexture(Uint8Array.from(bytes), 1, colors.length);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
