import type { App } from '../app';
import type { SliceName } from '../../model/slices';
import { Check } from './controls/check';
import { Icon } from './controls/icon';
import { Slider } from './controls/slider';

interface Props {
  app: App;
  name: SliceName;
  /** What the box is called. */
  label?: string;
}

/** Whether a plane slices, where it is, and which side it hides. */
export function SliceRow({ app, name, label = name }: Props) {
  const { on, position } = app.settings.slices[name];
  return (
    <div class={on ? 'slice' : 'slice off'}>
      <Check id={`slice-${name}`} label={label} checked={on} onChange={(checked) => app.changeSlice(name, { on: checked })} />
      <Slider
        id={`slice-${name}-position`}
        label={`Position of the ${name} plane`}
        hideLabel
        min={0}
        max={1}
        step={0.002}
        value={position}
        onInput={(value) => app.changeSlice(name, { position: value, on: true })}
      />
      <button
        type="button"
        id={`slice-${name}-flip`}
        class="quiet"
        aria-label={`Flip the ${name} plane`}
        title="Flip"
        onClick={() => app.flip(name)}
      >
        <Icon name="flip" />
      </button>
    </div>
  );
}
