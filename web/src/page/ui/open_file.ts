import type { App } from '../app';
import { ask } from '../ask';
import { fileError } from '../../model/failure';

const unreadable = "The browser can't read it: it is a folder, or it was moved or changed meanwhile. Open a file that holds a mesh.";

export async function openFile(app: App, file: File): Promise<void> {
  const bytes = await ask(
    app.state,
    file.arrayBuffer().catch(() => Promise.reject(fileError(file.name, unreadable))),
    'mesh',
  );
  if (bytes) await app.open({ kind: 'file', name: file.name }, bytes);
}
