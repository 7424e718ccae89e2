import { useState } from 'preact/hooks';
import type { App } from '../app';
import { ask } from '../ask';
import { escaped } from '../../model/markup';
import { activePlanes } from '../../model/planes';
import type { PictureOptions } from '../../model/view';
import type { WindFormat } from '../../model/wind';
import { addressOf } from '../link';
import { download } from './download';
import { blobOf, useSaving } from './saving';
import { CopyButton } from './controls/copy_button';
import { Check } from './controls/check';
import { Section } from './controls/section';
import { Select } from './controls/select';

interface Format {
  /** Also the end of its name. */
  format: string;
  /** What the file's name ends with besides. */
  about?: string;
  label: string;
  what: string;
  make: () => Promise<Blob | null>;
}

/** The flow that is drawn. */
function windFormats(app: App): Format[] {
  const written = (format: WindFormat, type: string) => async () => blobOf(await app.windTunnel.write(format), type);
  return [
    { format: 'csv', about: 'wind', label: 'CSV', what: 'flow in cells', make: written('csv', 'text/csv') },
    { format: 'vtu', about: 'wind', label: 'VTU', what: 'flow for ParaView', make: written('vtu', 'application/xml') },
    { format: 'obj', about: 'wind', label: 'OBJ', what: 'streamlines', make: written('obj', 'text/plain') },
  ];
}

/** What the planes that are on cut. */
function sliceFormats(app: App): Format[] {
  const { model, settings } = app;
  const planes = model ? activePlanes(model, settings) : [];
  return planes.map(({ name }) => ({
    format: 'svg',
    about: `slice-${name}`,
    label: 'SVG',
    what: name === 'free' ? 'drawing of the slice' : `drawing of slice ${name}`,
    make: () => ask(app.state, app.view.files.svg(name)),
  }));
}

const pictureSizes = [
  ['1', 'as on the screen'],
  ['2', 'twice as wide and high'],
  ['4', '4 times as wide and high'],
] as const;
type PictureSize = (typeof pictureSizes)[number][0];

/** Saves the result and the view as files, or as a link. */
export function SavePanel({ app }: { app: App }) {
  const [size, setSize] = useState<PictureSize>('1');
  const [isTransparent, setTransparent] = useState(false);
  const { files } = app.view;
  const written = (format: 'json' | 'vtu' | 'obj', type: string) => async () => blobOf(await app.write(format), type);
  const formats: Format[] = [
    { format: 'json', label: 'JSON', what: 'all arrays', make: written('json', 'application/json') },
    { format: 'vtu', label: 'VTU', what: 'cells for ParaView', make: written('vtu', 'application/xml') },
    { format: 'obj', label: 'OBJ', what: 'surface by region', make: written('obj', 'text/plain') },
    { format: 'glb', label: 'GLB', what: 'visible geometry', make: () => ask(app.state, files.glb(false)) },
    { format: 'glb', about: 'cells', label: 'GLB', what: 'each cell an object', make: () => ask(app.state, files.glb(true)) },
    ...sliceFormats(app),
    ...(app.state.wind.value ? windFormats(app) : []),
    { format: 'png', label: 'PNG', what: 'picture', make: () => picture(app, { times: Number(size), isTransparent }) },
  ];
  return (
    <Section app={app} id="save" title="Save">
      <ul class="savers">
        {formats.map((format) => (
          <li key={format.what}>
            <Saver app={app} {...format} />
          </li>
        ))}
      </ul>
      <Select id="picture-size" label="Picture" options={pictureSizes} value={size} onChange={setSize} />
      <Check id="picture-transparent" label="picture without background" checked={isTransparent} onChange={setTransparent} />
      <Links app={app} />
    </Section>
  );
}

/** Says where there is no room for as many pixels as were asked for. */
async function picture(app: App, options: PictureOptions): Promise<Blob | null> {
  const made = await ask(app.state, app.view.files.png(options));
  if (!made) return null;
  if (made.isSmaller) {
    app.state.notice(`This browser can't draw that many pixels. The picture has as many as it can: ${made.width} × ${made.height}.`);
  }
  return made.blob;
}

function Saver({ app, format, about, label, what, make }: Format & { app: App }) {
  const { model } = app;
  const [isSaving, save] = useSaving(async () => {
    const blob = await make();
    if (blob && model) download(blob, model, format, about);
  });
  return (
    <button type="button" id={`save-${about ? `${about}-` : ''}${format}`} disabled={isSaving || !model} onClick={() => void save()}>
      <strong>{label}</strong>
      <small>{what}</small>
    </button>
  );
}

/** The page as it is now, as an address and as a part of another page. */
function Links({ app }: { app: App }) {
  const note = app.settings.source.kind === 'file' ? 'The file itself is not included.' : '';
  return (
    <>
      <CopyButton name="link" label="Copy link" text={() => addressOf(app.settings)} note={note} field="Link to this view" />
      <CopyButton name="embed" label="Copy to embed" text={() => embedding(app)} note={note || 'Paste it into a web page.'} field="HTML" />
    </>
  );
}

function embedding({ settings, mesh }: App): string {
  const title = `${mesh?.name ?? 'A mesh'}, cut by Mandoline`;
  return `<iframe src="${escaped(addressOf(settings, true))}" title="${escaped(title)}" width="800" height="500" style="border: 0"></iframe>`;
}
