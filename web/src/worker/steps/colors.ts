import { regionColor } from 'mandoline-wasm/three';

// Linear RGB. Middle tones, to be seen on light and dark grounds.
export type Color = readonly [number, number, number];

function linear(hex: string): Color {
  const channel = (at: number) => (parseInt(hex.slice(at, at + 2), 16) / 255) ** 2.2;
  return [channel(1), channel(3), channel(5)];
}

export const triEdgeColor = linear('#8794a1');
/** Of a crossing of one, two or three axial planes. */
export const crossingColors: readonly Color[] = ['#e0822b', '#c23fa6', '#d3202f'].map(linear);
/** Of points and lines in planes across an axis. */
export const axisColors: readonly Color[] = ['#d9534f', '#3f9d4c', '#3f78d9'].map(linear);
export const outlineColor = linear('#5b6773');
export const gridColor = linear('#9aa6b2');
export const coplanarColor = linear('#f0b429');

/** A piece has the colour of the region with the same number. */
export function pieceColor(piece: number): Color {
  return regionColor(piece);
}

export function shaded(color: Color, shade: number): Color {
  return [color[0] * shade, color[1] * shade, color[2] * shade];
}
