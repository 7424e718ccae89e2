// Modules of the page, bundled as the page's own build does it, for tests in Node.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'vite';

const web = fileURLToPath(new URL('../../web', import.meta.url));

/** Imports a TypeScript module of web/src, for example "model/gallery/index.ts". */
export async function importBundled(path) {
  const folder = mkdtempSync(join(tmpdir(), 'mandoline-page-'));
  process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
  await build({
    root: web,
    logLevel: 'error',
    ssr: { noExternal: true },
    build: {
      ssr: join(web, 'src', path),
      outDir: folder,
      minify: false,
      rolldownOptions: { output: { entryFileNames: '[name].mjs', chunkFileNames: '[name].mjs' } },
    },
  });
  return import(pathToFileURL(join(folder, `${basename(path, '.ts')}.mjs`)));
}
