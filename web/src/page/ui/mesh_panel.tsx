import { useRef } from 'preact/hooks';
import type { App } from '../app';
import { fileExtensions } from '../../model/formats';
import { gallery } from '../../model/gallery/list';
import { plural } from '../../model/format';
import { Gallery } from './gallery';
import { openFile } from './open_file';
import { Section } from './controls/section';

/** Pickers only look at the last extension. */
const fileTypes = [...fileExtensions, '.gz'].join();

/** Which mesh is cut: from the gallery, a file or a URL. */
export function MeshPanel({ app }: { app: App }) {
  return (
    <Section app={app} id="mesh" title="Mesh">
      <MeshLine app={app} />
      <Gallery app={app} />
      <FileButton app={app} />
      <UrlForm app={app} />
    </Section>
  );
}

function MeshLine({ app: { mesh } }: { app: App }) {
  const title = gallery.find(({ name }) => name === mesh?.name)?.title ?? mesh?.name;
  return (
    <p class="line" id="mesh-line" aria-live="polite" data-name={mesh?.name} data-triangles={mesh?.triangles}>
      {mesh && (
        <>
          <strong>{title}</strong> {plural(mesh.triangles, 'triangle')}
        </>
      )}
    </p>
  );
}

function FileButton({ app }: { app: App }) {
  const picker = useRef<HTMLInputElement>(null);
  const open = (input: HTMLInputElement) => {
    const file = input.files?.[0];
    if (file) void openFile(app, file);
    input.value = '';
  };
  return (
    <div class="row">
      <button type="button" id="open-file" onClick={() => picker.current?.click()}>
        Open a file…
      </button>
      <input
        ref={picker}
        type="file"
        id="file"
        accept={fileTypes}
        class="visually-hidden"
        tabIndex={-1}
        aria-label="Mesh file"
        onChange={({ currentTarget }) => open(currentTarget)}
      />
      <span class="hint">or drop one anywhere: OBJ, STL, PLY, OFF, GLB, 3MF</span>
    </div>
  );
}

function UrlForm({ app }: { app: App }) {
  const field = useRef<HTMLInputElement>(null);
  const submit = (event: Event) => {
    event.preventDefault();
    void app.open({ kind: 'url', url: field.current?.value ?? '' });
  };
  return (
    <form class="row" id="url-form" onSubmit={submit}>
      <label for="url" class="visually-hidden">
        URL of a mesh
      </label>
      <input ref={field} type="url" id="url" placeholder="https://…/mesh.obj" required autoComplete="off" spellcheck={false} />
      <button type="submit" id="open-url">
        Load
      </button>
    </form>
  );
}
