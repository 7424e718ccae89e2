import type { App } from '../app';
import { Slider } from './controls/slider';

interface Props {
  app: App;
  part: 'cells' | 'regions';
  label: string;
}

/** How far the cells or the regions are pulled apart. */
export function Explosion({ app, part, label }: Props) {
  const { explode } = app.settings;
  return (
    <Slider
      id={`explode-${part}`}
      label={label}
      min={0}
      max={1}
      step={0.01}
      value={explode[part]}
      format={(x) => `${Math.round(100 * x)}%`}
      onInput={(value) => app.change({ explode: { ...app.settings.explode, [part]: value } })}
    />
  );
}
