import type { App } from '../app';
import { colorings, type ColorBy } from '../../model/settings';
import { Icon } from './controls/icon';
import { NumberField } from './controls/number_field';
import { Select } from './controls/select';
import { Slider } from './controls/slider';
import { Explosion } from './explosion';
import { SliceRow } from './slice_row';

const colorNames: Record<ColorBy, string> = {
  region: 'region',
  winding: 'winding number',
  cell: 'cell',
  volume: 'volume',
  kind: 'face type',
};

/** What is changed most often, at the foot of the stage. */
export function Bar({ app }: { app: App }) {
  const { colorBy } = app.settings;
  return (
    <div id="bar" role="group" aria-label="Cut and look">
      <Resolution app={app} />
      <SliceRow app={app} name="free" label="Slice" />
      <Explosion app={app} part="cells" label="Explode" />
      <Select
        id="color-by"
        label="Colour by"
        options={colorings.map((name) => [name, colorNames[name]] as const)}
        value={colorBy}
        onChange={(name) => app.change({ colorBy: name })}
      />
      <WindToggle app={app} />
      <PlayButton app={app} />
    </div>
  );
}

function Resolution({ app }: { app: App }) {
  const { grid } = app.settings;
  const cells = 'min' in grid ? Math.max(...grid.cells) : grid.cells;
  const set = (value: number) => void app.setGrid({ cells: value });
  return (
    <div class="with-number">
      <Slider id="cells" label="Cells" min={1} max={128} step={1} value={cells} onInput={set} />
      <NumberField id="cells-number" label="Cells along the longest side" hideLabel min={1} max={512} value={cells} onChange={set} />
    </div>
  );
}

function WindToggle({ app }: { app: App }) {
  return (
    <label class="toggle">
      <input
        id="wind-on"
        type="checkbox"
        checked={app.settings.wind.on}
        onChange={({ currentTarget }) => app.changeWind({ on: currentTarget.checked })}
      />
      <span>
        <Icon name="wind" />
        <span class="word">Wind</span>
      </span>
    </label>
  );
}

/** Plays what the panel about motion names. */
function PlayButton({ app }: { app: App }) {
  const isPlaying = app.state.playing.value !== null;
  const toggle = () => {
    if (isPlaying) app.player.pause();
    else void app.player.play();
  };
  return (
    <button type="button" id="play" disabled={!app.model} onClick={toggle}>
      <Icon name={isPlaying ? 'pause' : 'play'} />
      <span class="word">{isPlaying ? 'Pause' : 'Play'}</span>
    </button>
  );
}
