// Serves a folder as any static host does, optionally below a sub-path and with headers of its own.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize, resolve, sep } from 'node:path';

const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.css': 'text/css',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
};

/** The file that a path below the sub-path names; folders have an index.html. */
function fileAt(folder, path) {
  const file = join(folder, normalize(decodeURIComponent(path)));
  if (file !== folder && !file.startsWith(folder + sep)) return null;
  const status = statSync(file, { throwIfNoEntry: false });
  if (!status) return null;
  return status.isDirectory() ? fileAt(file, 'index.html') : file;
}

/**
 * Starts the server on a free port. Returns { url, requests, close }: `url` ends with the sub-path and a slash, `requests` lists the paths
 * asked for with their status and time (Date.now()).
 */
export async function serveFolder({ folder, subPath = '/', headers = {} }) {
  const root = resolve(folder);
  const base = `/${subPath}/`.replace(/\/+/g, '/');
  const requests = [];
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const file = pathname.startsWith(base) ? fileAt(root, pathname.slice(base.length)) : null;
    const status = file ? 200 : 404;
    requests.push({ path: pathname, status, at: Date.now() });
    response.writeHead(status, { 'Content-Type': types[file && extname(file)] ?? 'application/octet-stream', ...headers });
    if (file) createReadStream(file).pipe(response);
    else response.end();
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return {
    url: `http://127.0.0.1:${server.address().port}${base}`,
    requests,
    close: () =>
      new Promise((closed) => {
        server.close(closed);
        server.closeAllConnections();
      }),
  };
}
