// Colours of speeds and pressures: the same on light and dark.
import { DataTexture } from 'three';
import type { WindColoring } from '../../../model/wind';
import type { Rgb } from '../colors';

/** What is faster has the colour of this, in speeds of the wind. */
export const topSpeed = 2;

type Stop = readonly [at: number, color: Rgb];

/** Slow air is blue, undisturbed air teal, fast air warm. */
const speedStops: readonly Stop[] = [
  [0, [42, 84, 148]],
  [0.7, [24, 122, 146]],
  [1, [47, 160, 150]],
  [1.25, [217, 168, 62]],
  [1.6, [224, 118, 42]],
  [2, [203, 58, 42]],
];

/** Pressure is red, suction blue. */
const pressureStops: readonly Stop[] = [
  [-3, [30, 72, 148]],
  [-1, [88, 150, 200]],
  [0, [190, 184, 170]],
  [0.5, [222, 140, 96]],
  [1, [186, 52, 44]],
];

function colorAt(stops: readonly Stop[], x: number): Rgb {
  const next = Math.max(
    1,
    stops.findIndex(([at]) => at >= x),
  );
  const [[low, from], [high, to]] = [stops[next - 1], stops[next]];
  const share = Math.max(0, Math.min(1, (x - low) / (high - low)));
  return [0, 1, 2].map((c) => Math.round(from[c] + share * (to[c] - from[c]))) as unknown as Rgb;
}

function colorOf(coloring: WindColoring, speed: number): Rgb {
  return coloring === 'pressure' ? colorAt(pressureStops, 1 - speed * speed) : colorAt(speedStops, speed);
}

const steps = 256;

/** A row for speeds, and one for pressures by their speeds. */
export function rampTexture(): DataTexture {
  const data = new Uint8Array(4 * 2 * steps).fill(255);
  (['speed', 'pressure'] as const).forEach((coloring, row) => {
    for (let step = 0; step < steps; step++) data.set(colorOf(coloring, (topSpeed * step) / (steps - 1)), 4 * (row * steps + step));
  });
  const texture = new DataTexture(data, steps, 2);
  texture.needsUpdate = true;
  return texture;
}

/** What the colours mean, as CSS colours. */
export function windLegend(coloring: WindColoring): { label: string; color: string }[] {
  const css = (speed: number) => `rgb(${colorOf(coloring, speed).join(' ')})`;
  if (coloring === 'pressure') {
    return [1, 0.5, 0, -1, -2, -3].map((pressure) => {
      const number = String(pressure).replace('-', '−');
      return { label: pressure === -3 ? `${number} and below` : number, color: css(Math.sqrt(1 - pressure)) };
    });
  }
  return [0, 0.5, 1, 1.5, 2].map((speed) => ({ label: speed === topSpeed ? `${speed} and above` : String(speed), color: css(speed) }));
}
