// 3MF files: a zip archive with XML, which the page reads by itself.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { strToU8, zipSync } from 'three/examples/jsm/libs/fflate.module.js';
import { corners, expectedCorners, faces, parse, points, refuses } from './parsed_files.mjs';

/** A model with the tetrahedron as object 1. */
function threeMfModel({ objects = '', items = '<item objectid="1"/>', mesh = threeMfMesh() } = {}) {
  return `<?xml version="1.0"?>
<!-- <object id="9"> -->
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:p="http://production">
<metadata name="Title">a &lt;b&gt;</metadata>
<resources><object id="1" type="model">${mesh}</object>${objects}</resources><build>${items}</build></model>`;
}

/** A file with that model; `before` and `parts` are more files of the archive. */
function threeMf({ before = {}, parts = {}, ...model } = {}) {
  const type = 'http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel';
  const files = {
    ...before,
    '_rels/.rels': `<Relationships><Relationship Id='r' Type='${type}' Target='/3D/main.model'/></Relationships>`,
    '3D/other.model': '<model/>',
    '3D/main.model': threeMfModel(model),
    ...parts,
  };
  return zipSync(
    Object.fromEntries(Object.entries(files).map(([name, content]) => [name, typeof content === 'string' ? strToU8(content) : content])),
  );
}

function threeMfMesh(triangles = faces) {
  const vertices = points.map(([x, y, z]) => `<vertex x="${x}" y='${y}' z = "${z}" />`);
  const corners = triangles.map(([a, b, c]) => `<m:triangle v1="${a}" v2="${b}" v3="${c}" pid="v1" p1="7"/>`);
  return `<mesh><vertices>${vertices.join('')}</vertices>\n<triangles>${corners.join('\n')}</triangles></mesh>`;
}

/** From object `first` on, `count` + 1 objects, each made of the one before it, twice or so; the first is made of `inner`. */
function twice(first, inner, count, times = 2) {
  const made = (id) => `<component objectid="${id === first ? inner : id - 1}"/>`.repeat(times);
  return Array.from(
    { length: count + 1 },
    (_, at) => `<object id="${first + at}"><components>${made(first + at)}</components></object>`,
  ).join('');
}

const upTo = (name, file) => Buffer.from(file).subarray(0, Buffer.from(file).indexOf(name));

describe('3MF', () => {
  test('by content, whatever its name', async () => {
    for (const name of ['a.3mf', 'a.stl', 'part.zip', 'a']) {
      const mesh = await parse(name, threeMf());
      assert.deepEqual(corners(mesh), expectedCorners);
      assert.ok(mesh.isReadHere, 'not by the package');
    }
  });

  test('objects placed, mirrored, made of others, and in another file of the archive', async () => {
    const file = threeMf({
      objects: '<object id="2"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 5"/></components></object>',
      items: `<item objectid="2" transform="-2 0 0 0 2 0 0 0 2 10 0 0"/><item objectid="3" p:path="/3D/Objects/part.model"/>`,
      parts: { '3D/Objects/part.model': `<model><resources><object id="3">${threeMfMesh()}</object></resources></model>` },
    });
    const found = corners(await parse('a.3mf', file));
    const swapped = [0, 1, 2, 3].flatMap((t) => [0, 2, 1].map((k) => expectedCorners[3 * t + k]));
    assert.deepEqual(
      found.slice(0, 12),
      swapped.map(([x, y, z]) => [10 - 2 * x, 2 * y, 2 * (z + 5)]),
    );
    assert.deepEqual(found.slice(12), expectedCorners);
  });

  test('flat vertices of a stack of slices are no part of a mesh', async () => {
    const slice = '<s:slice ztop="1"><s:vertices><s:vertex x="0" y="0"/><s:vertex x="1" y="0"/></s:vertices></s:slice>';
    const file = threeMf({ objects: `<s:slicestack id="7" zbottom="0">${slice}</s:slicestack>` });
    assert.deepEqual(corners(await parse('a.3mf', file)), expectedCorners);
  });

  test('attributes in any order, and in the values of others', async () => {
    const mesh = threeMfMesh();
    const objects = `<object name="of id='3' and more" id="2">${mesh}</object><object id="3"><mesh/></object>`;
    const file = threeMf({ objects, items: `<item partnumber="a objectid='3'" objectid="2"/>` });
    assert.deepEqual(corners(await parse('a.3mf', file)), expectedCorners);
  });

  test('in UTF-16, of both orders of bytes', async () => {
    const littleEndian = Buffer.from(`\ufeff${threeMfModel()}`, 'utf16le');
    for (const bytes of [littleEndian, Buffer.from(littleEndian).swap16()]) {
      assert.deepEqual(corners(await parse('a.3mf', threeMf({ parts: { '3D/main.model': bytes } }))), expectedCorners);
    }
  });

  test('an object is placed many times', async () => {
    const mesh = await parse('a.3mf', threeMf({ objects: twice(2, 1, 10), items: '<item objectid="12"/>' }));
    assert.equal(mesh.triangles.length, 3 * 4 * 2 ** 11);
    assert.deepEqual(corners(mesh).slice(-12), expectedCorners);
  });

  const refused = {
    'cut off': [threeMf().slice(0, 300), /zip archive.* ends too early/],
    'cut off after its thumbnail': [upTo('3D/', threeMf({ before: { 'Metadata/thumbnail.png': Buffer.alloc(2000) } })), /ends too early/],
    'with nothing placed': [threeMf({ items: '' }), /no object is placed/],
    'without a model': [zipSync({ 'a.txt': strToU8('hello') }), /no 3D model/],
    'with an object that is not there': [
      threeMf({ items: '<item objectid="5"/>' }),
      /object 5 is placed, but 3D\/main.model doesn't have it/,
    ],
    'with a part that is not there': [threeMf({ items: '<item objectid="1" p:path="/3D/gone.model"/>' }), /no file 3D\/gone.model/],
    'with a part that has the name of what all objects have': [
      threeMf({ items: '<item objectid="1" p:path="/__proto__"/>' }),
      /no file __proto__/,
    ],
    'with a vertex that is not there': [
      threeMf({ mesh: threeMfMesh([[0, 1, 4]]) }),
      /triangle 0 of object 1 has vertex 4, but there are 4/,
    ],
    'with a vertex that is not named': [
      threeMf({ mesh: threeMfMesh([...faces, ['', 1, 2]]) }),
      /v1 of triangle 4 of object 1 is "" instead of a number/,
    ],
    'with a coordinate that is not a number': [
      threeMf({ mesh: threeMfMesh().replace('1.5', 'wide') }),
      /x of vertex 1 of object 1 is "wide"/,
    ],
    'with a coordinate that is missing': [threeMf({ mesh: threeMfMesh().replace('x="1.5"', '') }), /x of vertex 1 of object 1 is missing/],
    'with a transform that is not one': [threeMf({ items: '<item objectid="1" transform="1 0 0"/>' }), /"1 0 0" is not a transform/],
    'with an object made of itself': [
      threeMf({ objects: '<object id="2"><components><component objectid="2"/></components></object>', items: '<item objectid="2"/>' }),
      /object 2 is made of itself/,
    ],
    'without triangles': [threeMf({ mesh: threeMfMesh([]) }), /no triangles/],
  };
  for (const [what, [content, detail]] of Object.entries(refused)) {
    test(`${what} it is refused by name`, () => refuses('a.3mf', content, detail));
  }

  test('another archive is named as the package does', () => refuses('a.zip', zipSync({ 'a.txt': strToU8('hello') }), /ZIP archive/));
});

/** In a zip archive, the number at this offset of the first such record. */
function patched(file, record, offset, value) {
  const bytes = Buffer.from(file);
  const at = bytes.indexOf(record, 0, 'latin1');
  assert.ok(at >= 0);
  bytes.writeUIntLE(value, at + offset, value > 0xffff ? 4 : 2);
  return bytes;
}

describe('3MF files that would become huge are refused, soon', () => {
  const leaf = (mesh) => `<object id="2">${mesh}</object>`;
  const bare = threeMfMesh([]).replace('</vertices>', `${'<vertex x="0" y="0" z="0"/>'.repeat(1000)}</vertices>`);
  const manyTriangles = threeMfMesh(Array.from({ length: 1000 }, () => [0, 1, 2]));
  const items = '<item objectid="33"/>';
  for (const [what, content, detail] of [
    ['empty parts', threeMf({ objects: leaf('<mesh/>') + twice(3, 2, 30), items }), /too many parts for/],
    ['vertices alone', threeMf({ objects: leaf(bare) + twice(3, 2, 30), items }), /too many vertices/],
    ['triangles', threeMf({ objects: leaf(manyTriangles) + twice(3, 2, 30), items }), /too many triangles/],
    ['parts within parts', threeMf({ objects: twice(2, 1, 40, 1), items: '<item objectid="42"/>' }), /too many parts within parts/],
    [
      'the same, where the innermost are looked at first',
      threeMf({ objects: twice(2, 1, 40, 1), items: '<item objectid="22"/><item objectid="42"/>' }),
      /too many parts within parts/,
    ],
    ['files, once they are unpacked', patched(threeMf(), 'PK\x01\x02', 24, 3e9), /too large for this page once it is unpacked/],
    ['a directory of files that are not there', patched(threeMf(), 'PK\x05\x06', 8, 0xffff), /is not one/],
    ['comments that do not end', threeMf({ objects: '<!-- '.repeat(300_000) }), /no object is placed/],
  ]) {
    test(what, { timeout: 20_000 }, () => refuses('a.3mf', content, detail));
  }
});
