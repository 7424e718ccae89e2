import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { App } from '../app';
import { ask } from '../ask';
import { toHash } from '../../model/settings';
import type { WindFormat } from '../../model/wind';
import { download } from './download';
import { Section } from './controls/section';

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
  const written = (format: WindFormat, type: string) => async () => {
    const bytes = await app.windTunnel.write(format);
    return bytes && new Blob([bytes as Uint8Array<ArrayBuffer>], { type });
  };
  return [
    { format: 'csv', about: 'wind', label: 'CSV', what: 'flow in cells', make: written('csv', 'text/csv') },
    { format: 'vtu', about: 'wind', label: 'VTU', what: 'flow for ParaView', make: written('vtu', 'application/xml') },
    { format: 'obj', about: 'wind', label: 'OBJ', what: 'streamlines', make: written('obj', 'text/plain') },
  ];
}

/** Saves the result and the view as files, or as a link. */
export function SavePanel({ app }: { app: App }) {
  const written = (format: 'json' | 'vtu' | 'obj', type: string) => async () => {
    const bytes = await app.write(format);
    return bytes && new Blob([bytes as Uint8Array<ArrayBuffer>], { type });
  };
  const formats: Format[] = [
    { format: 'json', label: 'JSON', what: 'all arrays', make: written('json', 'application/json') },
    { format: 'vtu', label: 'VTU', what: 'cells for ParaView', make: written('vtu', 'application/xml') },
    { format: 'obj', label: 'OBJ', what: 'surface by region', make: written('obj', 'text/plain') },
    { format: 'glb', label: 'GLB', what: 'visible geometry', make: () => ask(app.state, app.view.glb()) },
    { format: 'png', label: 'PNG', what: 'screenshot', make: () => ask(app.state, app.view.png()) },
    ...(app.state.wind.value ? windFormats(app) : []),
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
      <LinkRow app={app} />
    </Section>
  );
}

function Saver({ app, format, about, label, what, make }: Format & { app: App }) {
  const [isSaving, setSaving] = useState(false);
  const { model } = app;
  const save = async () => {
    if (!model) return;
    setSaving(true);
    const blob = await make();
    setSaving(false);
    if (blob) download(blob, model, format, about);
  };
  return (
    <button type="button" id={`save-${about ? `${about}-` : ''}${format}`} disabled={isSaving || !model} onClick={() => void save()}>
      <strong>{label}</strong>
      <small>{what}</small>
    </button>
  );
}

function LinkRow({ app }: { app: App }) {
  const [status, setStatus] = useState('');
  /** Shown where the clipboard is out of reach. */
  const [link, setLink] = useState<string | null>(null);
  const field = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => field.current?.select(), [link]);
  const copy = async () => {
    const url = `${location.href.split('#')[0]}#${toHash(app.settings)}`;
    const fileNote = app.settings.source.kind === 'file' ? ' The file itself is not included.' : '';
    try {
      await navigator.clipboard.writeText(url);
      setStatus(`Copied.${fileNote}`);
    } catch {
      setLink(url);
      setStatus(`Copy it from the field below.${fileNote}`);
    }
  };
  return (
    <div class="row">
      <button type="button" id="copy-link" onClick={() => void copy()}>
        Copy link
      </button>
      <span class="hint" aria-live="polite" id="link-status">
        {status}
      </span>
      {link !== null && <input ref={field} id="link" readOnly value={link} aria-label="Link to this view" />}
    </div>
  );
}
