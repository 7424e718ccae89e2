import type { App } from '../app';
import { colorings, layers, sliceNames } from '../../model/settings';
import type { ColorBy, Model, SliceName } from '../../model/types';
import { Check } from './controls/check';
import { Choice } from './controls/choice';
import { NumberField } from './controls/number_field';
import { Section } from './controls/section';
import { Select } from './controls/select';
import { Slider } from './controls/slider';
import { insideOf, isOutside } from '../../model/inside';
import { plural, real } from '../../model/format';

const colorNames: Record<ColorBy, string> = {
  region: 'region',
  winding: 'winding number',
  cell: 'cell',
  volume: 'volume',
  kind: 'face type',
};
const layerNames: Record<(typeof layers)[number], string> = {
  surface: 'surface',
  gridFaces: 'grid-faces',
  edges: 'edges',
  untouched: 'untouched cells',
  cutCells: 'cut-cells',
  outside: 'outside',
};

/** How the cut-mesh is shown. */
export function ViewPanel({ app }: { app: App }) {
  return (
    <Section app={app} id="view" title="View">
      <Slices app={app} />
      <Explosion app={app} />
      <Coloring app={app} />
      <Visibility app={app} />
      <OneRegion app={app} />
      <PinByNumber app={app} />
      <div class="row">
        <button type="button" id="fit" onClick={() => app.fit()}>
          Fit view
        </button>
        <button type="button" id="reset-look" onClick={() => app.resetLook()}>
          Reset view
        </button>
      </div>
    </Section>
  );
}

const sliceModes = [
  ['whole', 'whole'],
  ['flat', 'cut flat'],
] as const;

function Slices({ app }: { app: App }) {
  const { sliceMode } = app.settings;
  return (
    <fieldset class="slices">
      <legend>Slice</legend>
      {sliceNames.map((name) => (
        <SliceRow key={name} app={app} name={name} />
      ))}
      <Choice
        name="slice-mode"
        legend="Sliced cells"
        options={sliceModes}
        value={sliceMode}
        onChange={(mode) => app.change({ sliceMode: mode })}
      />
    </fieldset>
  );
}

function SliceRow({ app, name }: { app: App; name: SliceName }) {
  const { on, position } = app.settings.slices[name];
  return (
    <div class={on ? 'slice' : 'slice off'}>
      <Check id={`slice-${name}`} label={name} checked={on} onChange={(checked) => app.changeSlice(name, { on: checked })} />
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
      <button type="button" id={`slice-${name}-flip`} class="quiet" aria-label={`Flip the ${name} plane`} onClick={() => app.flip(name)}>
        flip
      </button>
    </div>
  );
}

const explosions = [
  ['cells', 'by cell'],
  ['regions', 'by region'],
] as const;

function Explosion({ app }: { app: App }) {
  const { explode } = app.settings;
  return (
    <fieldset>
      <legend>Explode</legend>
      {explosions.map(([key, label]) => (
        <Slider
          key={key}
          id={`explode-${key}`}
          label={label}
          min={0}
          max={1}
          step={0.01}
          value={explode[key]}
          format={(x) => `${Math.round(100 * x)}%`}
          onInput={(value) => app.change({ explode: { ...app.settings.explode, [key]: value } })}
        />
      ))}
    </fieldset>
  );
}

function Coloring({ app }: { app: App }) {
  const options = colorings.map((name) => [name, colorNames[name]] as const);
  const { colorBy } = app.settings;
  return <Select id="color-by" label="Colour by" options={options} value={colorBy} onChange={(name) => app.change({ colorBy: name })} />;
}

function Visibility({ app }: { app: App }) {
  const { show } = app.settings;
  return (
    <fieldset>
      <legend>Show</legend>
      <div class="checks">
        {layers.map((layer) => (
          <Check
            key={layer}
            id={`show-${layer}`}
            label={layerNames[layer]}
            checked={show[layer]}
            onChange={(checked) => app.changeShow({ [layer]: checked })}
          />
        ))}
      </div>
    </fieldset>
  );
}

function OneRegion({ app }: { app: App }) {
  const { region } = app.settings.show;
  const choose = (value: string) => app.changeShow({ region: value === '' ? null : Number(value) });
  const options = app.model ? regionOptions(app.model) : [];
  return <Select id="region" label="Region" options={options} value={region === null ? '' : String(region)} onChange={choose} />;
}

function regionOptions(model: Model): [string, string][] {
  const { regions } = model;
  const options = regions.slice(0, 500).map(({ id, volume, cutCells }): [string, string] => {
    const name = model.insideBy === 'winding' && isOutside(model, id) ? `${id}, outside` : String(id);
    return [String(id), `${name} · ${insideOf(model, id)} · volume ${real(volume)} · ${plural(cutCells, 'cut-cell')}`];
  });
  return [['', `all (${regions.length})`], ...options];
}

function PinByNumber({ app }: { app: App }) {
  const { model } = app;
  return (
    <NumberField
      id="pin-number"
      label="Pin cut-cell"
      min={0}
      max={model ? model.counts.cutCells - 1 : undefined}
      optional
      disabled={!model}
      value={app.state.pinned.value?.cell ?? null}
      onChange={(cell) => void app.pin(cell)}
    />
  );
}
