import { fromUpright, toUpright, type Up } from '../../../model/up';
import type { Vector3 } from '../../../model/vector';
import { Slider } from './slider';

interface Props {
  /** Of the sliders: it begins their ids. */
  name: string;
  legend: string;
  up: Up;
  /** Unit. */
  direction: Vector3;
  onTurn: (direction: Vector3) => void;
}

const sliders = [
  { angle: 'heading', label: 'around', most: 180 },
  { angle: 'rise', label: 'upward', most: 90 },
] as const;

const degrees = (x: number) => `${Math.round(x)}°`;

/** Turns a direction with two sliders, which arrow keys move; in the picture, a handle is dragged. */
export function Direction({ name, legend, up, direction, onTurn }: Props) {
  const angles = anglesOf(toUpright(direction, up));
  return (
    <fieldset>
      <legend>{legend}</legend>
      {sliders.map(({ angle, label, most }) => (
        <Slider
          key={angle}
          id={`${name}-${angle}`}
          label={label}
          min={-most}
          max={most}
          step={1}
          value={angles[angle]}
          format={degrees}
          onInput={(value) => onTurn(fromUpright(directionOf({ ...angles, [angle]: value }), up))}
        />
      ))}
    </fieldset>
  );
}

/** In degrees: from the right towards the viewer, and upward. */
function anglesOf([x, y, z]: Vector3): { heading: number; rise: number } {
  const toDegrees = 180 / Math.PI;
  return { heading: toDegrees * Math.atan2(z, x), rise: toDegrees * Math.asin(Math.max(-1, Math.min(1, y))) };
}

/** Straight up and down it keeps a trace of where it was headed. */
function directionOf({ heading, rise }: { heading: number; rise: number }): Vector3 {
  const toRadians = Math.PI / 180;
  const [h, r] = [heading * toRadians, Math.max(-89.9, Math.min(89.9, rise)) * toRadians];
  const round = (x: number) => Number(x.toFixed(12));
  return [Math.cos(r) * Math.cos(h), Math.sin(r), Math.cos(r) * Math.sin(h)].map(round);
}
