// glTF and GLB, by three's loader. It is given nothing but triangles to load, all of them in the file: no images, skins, animations or
// other files.
import { LoadingManager, MeshBasicMaterial } from 'three';
import { GLTFLoader, type GLTFLoaderPlugin, type GLTFParser } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { meshFromObject } from 'mandoline-wasm/three';
import type { MeshArrays } from '../model/gallery';

const compressions: Record<string, string> = {
  KHR_draco_mesh_compression: 'Draco',
  EXT_meshopt_compression: 'meshopt',
  KHR_meshopt_compression: 'meshopt',
};

export async function readGltf(bytes: ArrayBuffer): Promise<MeshArrays> {
  const manager = new LoadingManager();
  manager.setURLModifier((url) => {
    if (url.startsWith('data:')) return url;
    throw new Error(`It needs another file, "${url}". Save the model as one file (GLB, or glTF with embedded buffers).`);
  });
  const loader = new GLTFLoader(manager).register(trianglesOnly);
  const { scene } = await loader.parseAsync(await unpacked(bytes), '');
  return meshFromObject(scene);
}

async function unpacked(bytes: ArrayBuffer): Promise<ArrayBuffer> {
  const [first, second] = new Uint8Array(bytes);
  if (first !== 0x1f || second !== 0x8b) return bytes;
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** Takes out of the file what isn't needed, before any of it is loaded. */
function trianglesOnly({ json }: GLTFParser): GLTFLoaderPlugin {
  for (const extension of json.extensionsRequired ?? []) {
    const compression = compressions[extension];
    if (compression) throw new Error(`It is compressed with ${compression}, which is not read. Save it without compression.`);
  }
  delete json.animations;
  const material = new MeshBasicMaterial();
  for (const node of json.nodes ?? []) {
    delete node.skin;
    delete node.camera;
  }
  return { name: 'TRIANGLES_ONLY', loadMaterial: () => Promise.resolve(material) };
}
