// Where meshes come from: the gallery, an address, a file.
import type { Mandoline } from 'mandoline-wasm';
import type { Calls, LoadedMesh } from '../model/calls';
import { checkExtent } from './extent';
import { fileError, isPageError, pageError } from '../model/failure';
import { boundsOf } from '../model/grid_around';
import { galleryMesh, type MeshArrays } from '../model/gallery';
import type { Source } from '../model/settings';
import { guessUp } from './up';

type MeshFile = MeshArrays & Pick<LoadedMesh, 'isReadHere'>;

export async function loadMesh(mandoline: Mandoline, { id, source, bytes }: Calls['load']['ask']): Promise<LoadedMesh> {
  const isGallery = source.kind === 'gallery';
  const mesh = isGallery ? { ...(await galleryMesh(source.name)), isReadHere: false } : await readFile(mandoline, source, bytes);
  const name = nameOf(source);
  const bounds = boundsOf(mesh);
  checkExtent(bounds, `${name} can't be drawn`);
  // The gallery's meshes stand along y.
  const up = isGallery ? 'y' : guessUp(name, mesh, bounds);
  return { id, name, ...mesh, bounds, up };
}

function nameOf(source: Source): string {
  return source.kind === 'url' ? fileName(source.url) : source.name;
}

function fileName(url: string): string {
  if (!URL.canParse(url, self.location.href)) throw pageError("The URL can't be read", `"${url}" is not a valid URL.`);
  const name = new URL(url, self.location.href).pathname.split('/').pop() ?? '';
  try {
    return decodeURIComponent(name) || url;
  } catch {
    return name; // A stray % that encodes nothing.
  }
}

async function readFile(mandoline: Mandoline, source: Exclude<Source, { kind: 'gallery' }>, given?: ArrayBuffer): Promise<MeshFile> {
  const name = nameOf(source);
  const bytes = source.kind === 'url' ? await fetched(source.url) : given;
  if (!bytes) throw pageError(`${name} is not here any more`, 'A link keeps only the name of a file. Open the file again.');
  return readMesh(mandoline, bytes, name);
}

async function fetched(url: string): Promise<ArrayBuffer> {
  const title = "The URL can't be read";
  const response = await fetch(url).catch((error: unknown) => {
    const why = "the server can't be reached, or it doesn't allow other pages to read it";
    throw pageError(title, `Nothing came from ${url}: ${why} (${String(error)}).`);
  });
  if (!response.ok) throw pageError(title, `${url} responded with ${response.status} ${response.statusText}.`);
  return response.arrayBuffer();
}

/** What the package doesn't read is read here, by what is fetched when it is needed. */
export async function readMesh(mandoline: Mandoline, bytes: ArrayBuffer, name: string): Promise<MeshFile> {
  try {
    const read = isGltf(bytes, name) ? readGltf : is3mf(bytes, name) ? read3mf : null;
    const mesh = await (read ? read(bytes) : mandoline.readMesh(bytes, { name }));
    if (mesh.triangles.length === 0) throw new Error('It has no triangles.');
    return { ...mesh, isReadHere: read !== null };
  } catch (error) {
    throw isPageError(error) ? error : fileError(name, whatIsWrong(error, name));
  }
}

async function readGltf(bytes: ArrayBuffer): Promise<MeshArrays> {
  const reader = await import('./gltf').catch(() => notLoaded('glTF'));
  return reader.readGltf(bytes);
}

async function read3mf(bytes: ArrayBuffer): Promise<MeshArrays> {
  const reader = await import('./three_mf').catch(() => notLoaded('3MF'));
  return reader.read3mf(bytes);
}

function notLoaded(format: string): never {
  throw new Error(`What reads ${format} could not be loaded. Check the connection, then open the file again.`);
}

/** A zip archive that is called one, or names the file of a model at its beginning or end; of others the package tells what they are. */
function is3mf(bytes: ArrayBuffer, name: string): boolean {
  const start = textAt(bytes);
  if (!start.startsWith('PK\x03\x04')) return false;
  return /\.3mf$/i.test(name) || /\.model/i.test(start + textAt(bytes.slice(-100_000), 100_000));
}

/** By content if that is enough, else by name. */
function isGltf(bytes: ArrayBuffer, name: string): boolean {
  const start = textAt(bytes).trimStart();
  return start.startsWith('glTF') || start.startsWith('{') || /\.(glb|gltf)(\.gz)?$/i.test(name);
}

function textAt(bytes: ArrayBuffer, length = 1000): string {
  return new TextDecoder('latin1').decode(bytes.slice(0, length));
}

/** The package's messages start with the name, which the title says already. */
function whatIsWrong(error: unknown, name: string): string {
  const text = error instanceof Error ? error.message : String(error);
  const flaw = text.startsWith(`${name}: `) ? text.slice(name.length + 2) : text;
  return flaw.charAt(0).toUpperCase() + flaw.slice(1);
}
