// glTF and GLB, by three's loader. It is given nothing but triangles to load, all of them in the file: no images, skins, animations or
// other files.
import { MeshBasicMaterial } from 'three';
import { GLTFLoader, type GLTFLoaderPlugin, type GLTFParser } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { meshFromObject } from 'mandoline-wasm/three';
import type { MeshArrays } from '../model/gallery';
import { checkedGltf, type Checked } from './gltf_checks';

export async function readGltf(bytes: ArrayBuffer): Promise<MeshArrays> {
  const { json, binary } = checkedGltf(await unpacked(bytes));
  const loader = new GLTFLoader().register((parser) => trianglesOnly(parser, binary));
  // Its words are meant for programmers.
  const { scene } = await loader.parseAsync(json as never, '').catch(() => {
    throw new Error('It is damaged, or made in a way that is not read. Save it again as glTF 2.0, or as OBJ, STL or PLY.');
  });
  return meshFromObject(scene);
}

async function unpacked(bytes: ArrayBuffer): Promise<ArrayBuffer> {
  const [first, second] = new Uint8Array(bytes);
  if (first !== 0x1f || second !== 0x8b) return bytes;
  const unpacking = new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
  return unpacking.catch(() => {
    throw new Error('Damaged gzip data. Pack it again, or open the file unpacked.');
  });
}

/** Takes out of the file what isn't needed, before any of it is loaded, and gives what lies in the binary chunk. */
function trianglesOnly({ json }: GLTFParser, binary: Checked['binary']): GLTFLoaderPlugin {
  delete json.animations;
  delete json.extensionsRequired;
  const material = new MeshBasicMaterial();
  for (const node of json.nodes ?? []) {
    delete node.skin;
    delete node.camera;
  }
  const isInChunk = ({ buffer }: { buffer: number }) => binary !== null && buffer === 0 && json.buffers[0].uri === undefined;
  const loadBufferView = async (id: number) => {
    const { byteOffset = 0, byteLength } = json.bufferViews[id];
    return binary?.slice(byteOffset, byteOffset + byteLength) as ArrayBuffer;
  };
  return {
    name: 'TRIANGLES_ONLY',
    loadMaterial: () => Promise.resolve(material),
    loadBufferView: (id) => (isInChunk(json.bufferViews[id]) ? loadBufferView(id) : null),
  };
}
