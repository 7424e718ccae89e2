import type { ComponentChildren } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import type { App } from '../app';
import { loadCode } from '../code';
import type { Code } from '../../model/code';
import { saveAs } from './download';
import { blobOf, useSaving } from './saving';
import { CopyButton } from './controls/copy_button';
import { Section } from './controls/section';

/** What makes the same outside the page. */
export function CodePanel({ app }: { app: App }) {
  const { model, settings, state } = app;
  const [writer, setWriter] = useState<Awaited<ReturnType<typeof loadCode>> | 'missing' | null>(null);
  const isOpen = state.sections.isOpen('code');
  useEffect(() => {
    if (isOpen) void loadCode().then(setWriter, () => setWriter('missing'));
  }, [isOpen]);
  const isThere = writer !== null && writer !== 'missing';
  const code = model && isOpen && isThere && !state.cutError.value ? writer.codeOf(settings, model) : null;
  return (
    <Section app={app} id="code" title="Use this in code">
      {writer === 'missing' ? (
        <p class="hint">The code can't be shown: a part of the page can't be loaded.</p>
      ) : code ? (
        <>
          <MeshFile app={app} code={code} />
          <Block name="javascript" title="JavaScript" copy="Copy JavaScript" text={code.javascript}>
            Save it as <code>cut.mjs</code> beside the mesh; then <code>npm install mandoline-wasm</code> and <code>node cut.mjs</code>. In
            a browser, fetch the mesh instead of reading it.
          </Block>
          <Block name="command-line" title="Command line" copy="Copy commands" text={code.commandLine}>
            For the program <code>mandoline</code>, built from source, in the folder with the mesh.
          </Block>
        </>
      ) : (
        isThere && <p class="hint">Nothing is cut with these settings.</p>
      )}
    </Section>
  );
}

/** The file that the code reads. */
function MeshFile({ app, code: { file, isOpened } }: { app: App; code: Code }) {
  const [isSaving, save] = useSaving(async () => {
    const blob = blobOf(await app.writeMesh(), 'text/plain');
    if (blob) saveAs(blob, file);
  });
  if (isOpened) return <p class="line">This makes what you see now. It reads {file}, the file that you opened.</p>;
  return (
    <div class="row">
      <span class="line">This makes what you see now. It reads the mesh from a file:</span>
      <button type="button" id="save-mesh" disabled={isSaving} onClick={() => void save()}>
        Save {file}
      </button>
    </div>
  );
}

interface BlockProps {
  name: string;
  title: string;
  /** What the button says. */
  copy: string;
  text: string;
  /** How to run it. */
  children: ComponentChildren;
}

function Block({ name, title, copy, text, children }: BlockProps) {
  return (
    <div class="code">
      <h3>{title}</h3>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by the keyboard */}
      <pre id={`${name}-text`} role="region" aria-label={`${title} for this view`} tabIndex={0}>
        {text}
      </pre>
      <p class="hint">{children}</p>
      <CopyButton name={name} label={copy} text={() => text} field={title} />
    </div>
  );
}
