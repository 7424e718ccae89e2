import type { App } from '../app';
import type { Model } from '../../model/cut_model';
import { layers, ups, type Settings } from '../../model/settings';
import { upOf } from '../../model/shown';
import { axes } from '../../model/slices';
import { Check } from './controls/check';
import { Choice } from './controls/choice';
import { Direction } from './controls/direction';
import { NumberField } from './controls/number_field';
import { Section } from './controls/section';
import { Select } from './controls/select';
import { Explosion } from './explosion';
import { SliceRow } from './slice_row';
import { insideOf, isOutside } from '../../model/inside';
import { plural, real } from '../../model/format';

const layerNames: Record<(typeof layers)[number], string> = {
  surface: 'surface',
  gridFaces: 'grid-faces',
  edges: 'edges',
  untouched: 'untouched cells',
  cutCells: 'cut-cells',
  outside: 'outside',
};

/** How the cut-mesh is shown, but for what the bar has. */
export function ViewPanel({ app }: { app: App }) {
  return (
    <Section app={app} id="view" title="View">
      <Slices app={app} />
      <FreePlane app={app} />
      <Explosion app={app} part="regions" label="Explode by region" />
      <Upwards app={app} />
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
      <legend>Slice along an axis</legend>
      {axes.map((name) => (
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

const upNames: Record<Settings['up'], string> = { auto: 'guessed', x: 'x', y: 'y', z: 'z' };

function Upwards({ app }: { app: App }) {
  const options = ups.map((name) => [name, upNames[name]] as const);
  return <Choice name="up" legend="Upwards" options={options} value={app.settings.up} onChange={(up) => app.changeUp(up)} />;
}

/** Where the plane of the bar's slice faces. */
function FreePlane({ app }: { app: App }) {
  const { on, normal } = app.settings.slices.free;
  if (!on) return null;
  return (
    <Direction
      name="free"
      legend="Turn the slice"
      up={upOf(app.settings, app.model)}
      direction={normal}
      onTurn={(to) => app.changeSlice('free', { normal: to })}
    />
  );
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
      onChange={(cell) => void app.inspector.pin(cell)}
    />
  );
}
