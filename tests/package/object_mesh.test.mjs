// meshFromObject: scenes of three.js, and what its loaders make of files that Mandoline itself doesn't read.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init } from 'mandoline-wasm';
import { meshFromGeometry, meshFromObject } from 'mandoline-wasm/three';
import {
  BatchedMesh,
  Bone,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  LineSegments,
  Matrix4,
  Mesh,
  Points,
  Scene,
  Skeleton,
  SkinnedMesh,
  Uint16BufferAttribute,
} from 'three';
import { GLTFExporter } from 'three/addons/exporters/GLTFExporter.js';
import { strToU8, zipSync } from 'three/addons/libs/fflate.module.js';
import { ThreeMFLoader } from 'three/addons/loaders/3MFLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { volumeOf } from './meshes.mjs';

const { cut, measure, readMesh } = await init();

/** A unit cube whose lowest corner is 0, 0, 0, without its seams. */
function cube() {
  const geometry = new BufferGeometry();
  const corners = Array.from({ length: 8 }, (_, i) => [i & 1, (i >> 1) & 1, i >> 2]);
  geometry.setAttribute('position', new Float32BufferAttribute(corners.flat(), 3));
  const sides = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ];
  return geometry.setIndex(sides.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]));
}

/** Lowest and highest coordinates. */
function bounds({ positions }) {
  const [min, max] = [[0, 0, 0].fill(Infinity), [0, 0, 0].fill(-Infinity)];
  positions.forEach((x, i) => {
    min[i % 3] = Math.min(min[i % 3], x);
    max[i % 3] = Math.max(max[i % 3], x);
  });
  return [min, max];
}

test('all meshes of a scene are merged, each at its place in the world', () => {
  const [first, second] = [new Mesh(cube()), new Mesh(cube().toNonIndexed())];
  first.position.x = 1;
  second.scale.set(2, 3, 4);
  const group = new Group().add(second);
  group.position.set(0, 0, 10);
  const scene = new Scene().add(first, group);
  const mesh = meshFromObject(scene);
  assert.equal(mesh.positions.length, 3 * (8 + 36));
  assert.equal(mesh.triangles.length, 3 * (12 + 12));
  assert.equal(volumeOf(mesh), 25);
  assert.deepEqual(bounds(mesh), [
    [0, 0, 0],
    [2, 3, 14],
  ]);
  assert.deepEqual(bounds(meshFromObject(second)), [
    [0, 0, 10],
    [2, 3, 14],
  ]);
  assert.equal(cut(mesh, { cells: 6 }).regionCount, 3);
});

test('a mesh alone is what meshFromGeometry gives, also of interleaved attributes', () => {
  const buffer = new InterleavedBuffer(Float32Array.of(0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9), 4);
  const geometry = new BufferGeometry().setAttribute('position', new InterleavedBufferAttribute(buffer, 3, 0));
  for (const each of [geometry, new BoxGeometry(1, 2, 3)]) assert.deepEqual(meshFromObject(new Mesh(each)), meshFromGeometry(each));
});

test('mirrored meshes stay outward', () => {
  const mesh = new Mesh(cube());
  mesh.scale.x = -1;
  assert.equal(volumeOf(meshFromObject(mesh)), 1);
  const mirror = new Group().add(mesh);
  mirror.scale.y = -2;
  assert.equal(volumeOf(meshFromObject(mirror)), 2);
});

test('each instance of an InstancedMesh is there', () => {
  const instances = new InstancedMesh(cube(), undefined, 3);
  for (let k = 0; k < 3; ++k) instances.setMatrixAt(k, new Matrix4().makeTranslation(2 * k, 0, 0));
  instances.setMatrixAt(2, new Matrix4().makeScale(-2, 1, 1));
  instances.position.y = 5;
  const mesh = meshFromObject(instances);
  assert.equal(mesh.triangles.length, 3 * 36);
  assert.equal(volumeOf(mesh), 4);
  assert.deepEqual(bounds(mesh), [
    [-2, 5, 0],
    [3, 6, 1],
  ]);
});

test('skinned and morphed meshes are taken as they stand', () => {
  const morphed = new Mesh(cube());
  const lifted = Array.from({ length: 24 }, (_, i) => (i % 3 === 2 && i >= 12 ? 2 : 0));
  morphed.geometry.morphAttributes.position = [new Float32BufferAttribute(lifted, 3)];
  morphed.geometry.morphTargetsRelative = true;
  morphed.updateMorphTargets();
  morphed.morphTargetInfluences[0] = 0.5;
  assert.equal(volumeOf(meshFromObject(morphed)), 2);

  const geometry = cube();
  geometry.setAttribute(
    'skinIndex',
    new Uint16BufferAttribute(
      Array.from({ length: 32 }, (_, i) => (i % 4 === 0 && i >= 16 ? 1 : 0)),
      4,
    ),
  );
  geometry.setAttribute(
    'skinWeight',
    new Float32BufferAttribute(
      Array.from({ length: 32 }, (_, i) => (i % 4 === 0 ? 1 : 0)),
      4,
    ),
  );
  const bones = [new Bone(), new Bone()];
  const skinned = new SkinnedMesh(geometry);
  const scene = new Scene().add(...bones, skinned);
  scene.updateMatrixWorld(true);
  skinned.bind(new Skeleton(bones));
  bones[1].position.z = 3;
  assert.equal(volumeOf(meshFromObject(skinned)), 4);
});

test('what is no mesh is left out, and what is not visible in the object', () => {
  const [hidden, shown] = [new Mesh(cube()), new Mesh(cube())];
  hidden.visible = false;
  const scene = new Scene().add(new Points(cube()), new LineSegments(cube()), new Mesh(new BufferGeometry()), hidden, shown);
  assert.equal(meshFromObject(scene).triangles.length, 36);
  assert.equal(meshFromObject(hidden).triangles.length, 36);
  scene.remove(shown);
  assert.equal(meshFromObject(scene).triangles.length, 0);
});

test("meshes that can't be taken are named", () => {
  const bad = new Mesh(cube());
  bad.name = 'door';
  bad.geometry.index.setX(4, 8);
  const scene = new Scene().add(bad);
  assert.throws(() => meshFromObject(scene), {
    code: 'badIndex',
    stage: 'meshFromObject',
    element: 1,
    message: /"door": triangle 1 .*vertex 8/,
  });
  bad.geometry = cube();
  bad.geometry.attributes.position.setY(3, NaN);
  assert.throws(() => meshFromObject(scene), { code: 'nonFiniteCoordinate', element: 3, message: /"door": vertex 3/ });
  const batched = new BatchedMesh(1, 8, 36);
  assert.throws(() => meshFromObject(batched), { code: 'badArgument', message: /BatchedMesh/ });
  for (const wrong of [undefined, null, {}, cube(), 'scene']) {
    assert.throws(() => meshFromObject(wrong), { code: 'badArgument', stage: 'meshFromObject', message: /must be an Object3D/ });
  }
  assert.throws(() => meshFromObject({ scene }), { code: 'badArgument', message: /give its scene/ });
});

test('a geometry with a last triangle that lacks corners gives the others', () => {
  const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(15), 3));
  assert.equal(meshFromObject(new Mesh(geometry)).triangles.length, 3);
});

/** GLTFExporter makes its file by a browser's FileReader. */
class FileReaderOfBlobs {
  async readAsArrayBuffer(blob) {
    this.result = await blob.arrayBuffer();
    this.onloadend();
  }
}

test('GLB: what GLTFLoader makes is cut', async () => {
  const [plain, mirrored] = [new Mesh(cube()), new Mesh(cube())];
  plain.rotation.set(0, 0, Math.PI / 2);
  mirrored.scale.set(-2, 1, 1);
  mirrored.position.set(9, 0, 0);
  globalThis.FileReader ??= FileReaderOfBlobs;
  const glb = await new GLTFExporter().parseAsync(new Scene().add(plain, mirrored), { binary: true });
  await assert.rejects(readMesh(glb, { name: 'box.glb' }), { code: 'badFile', message: /glTF/ });
  const { scene } = await new GLTFLoader().parseAsync(glb, '');
  const mesh = meshFromObject(scene);
  const cutMesh = cut(mesh, { cells: 5 });
  assert.deepEqual([...cutMesh.regionWinding].sort(), [0, 1, 1]);
  const { regionVolume } = measure(mesh, cutMesh);
  const enclosed = regionVolume.filter((_, region) => cutMesh.regionWinding[region] === 1).sort();
  assert.ok(Math.abs(enclosed[0] - 1) < 1e-6 && Math.abs(enclosed[1] - 2) < 1e-6);
});

/** As much of a browser's XML as ThreeMFLoader uses here. */
class XmlElement {
  constructor(nodeName, text) {
    this.nodeName = nodeName;
    this.children = [];
    this.attributes = [...text.matchAll(/([\w:]+)="([^"]*)"/g)].map(([, name, value]) => ({ name, value }));
    this.textContent = '';
  }
  getAttribute(name) {
    return this.attributes.find((attribute) => attribute.name === name)?.value ?? null;
  }
  getAttributeNS() {
    return null;
  }
  getElementsByTagNameNS() {
    return [];
  }
  querySelectorAll(path) {
    const [first, ...rest] = path.split(' ');
    const below = this.children.flatMap((child) => [...(child.nodeName === first ? [child] : []), ...child.querySelectorAll(first)]);
    return rest.length === 0 ? below : below.flatMap((element) => element.querySelectorAll(rest.join(' ')));
  }
  querySelector(path) {
    return this.querySelectorAll(path)[0] ?? null;
  }
}

class XmlParser {
  parseFromString(text) {
    const document = new XmlElement('', '');
    const open = [document];
    for (const [, end, name, attributes, empty] of text.matchAll(/<(\/?)([\w:]+)([^>]*?)(\/?)>/g)) {
      if (end) {
        open.pop();
        continue;
      }
      const element = new XmlElement(name, attributes);
      open.at(-1).children.push(element);
      if (!empty) open.push(element);
    }
    document.documentElement = document.children[0];
    return document;
  }
}

function threeMf() {
  const { index, attributes } = cube();
  const vertices = Array.from({ length: 8 }, (_, i) => {
    const [x, y, z] = [attributes.position.getX(i), attributes.position.getY(i), attributes.position.getZ(i)];
    return `<vertex x="${x}" y="${y}" z="${z}"/>`;
  });
  const triangles = Array.from({ length: 12 }, (_, t) => {
    const [a, b, c] = [0, 1, 2].map((k) => index.getX(3 * t + k));
    return `<triangle v1="${a}" v2="${b}" v3="${c}"/>`;
  });
  const model = `<?xml version="1.0"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<resources><object id="1" type="model"><mesh><vertices>${vertices.join('')}</vertices><triangles>${triangles.join('')}</triangles></mesh></object></resources>
<build><item objectid="1"/><item objectid="1" transform="2 0 0 0 1 0 0 0 1 4 0 0"/></build></model>`;
  const type = 'http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel';
  return zipSync({
    '_rels/.rels': strToU8(`<Relationships><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="${type}"/></Relationships>`),
    '3D/3dmodel.model': strToU8(model),
  });
}

test('3MF: what ThreeMFLoader makes is cut', async () => {
  const file = threeMf();
  await assert.rejects(readMesh(file, { name: 'box.3mf' }), { code: 'badFile', message: /3MF/ });
  globalThis.DOMParser ??= XmlParser;
  const mesh = meshFromObject(new ThreeMFLoader().parse(file.buffer));
  assert.equal(volumeOf(mesh), 3);
  assert.deepEqual(bounds(mesh), [
    [0, 0, 0],
    [6, 1, 1],
  ]);
  assert.equal(cut(mesh, { cells: 5 }).regionCount, 3);
});
