// What JavaScript knows of the C++ structs that it gets and gives, from the public headers: `fields` of a struct tells what it has, the
// declarations its types, and the comments what they mean. Writes their interfaces (results.d.ts) and the kinds of their members, with the
// words of enumerations (fields.js), into src/; with --check only looks whether these are as they would be written.
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const packageFolder = dirname(fileURLToPath(import.meta.url));
const headerFolder = join(dirname(packageFolder), 'src', 'include', 'mandoline');

// Of mandoline-wasm/physics; all others belong to the main entry.
const physicsHeaders = ['coarsen.h', 'cell_complex.h', 'refine.h', 'merge.h', 'operators.h', 'poisson.h', 'flow.h', 'unsteady.h'];
// JavaScript has no calls that give what they describe.
const leftOut = ['cut_share.h', 'distributed.h', 'recut.h'];

// Calls give these with more: their whole is in index.d.ts, or the word means what is put in.
const names = {
  Mesh: 'MeshArrays',
  CutMesh: 'CutMeshArrays',
  ResolvedMesh: 'ResolvedMeshArrays',
  Measures: 'MeasureArrays',
  Condition: 'ConditionKind',
  CsrMatrix: 'SparseMatrix',
};

// Strings that are one of some words.
const words = { 'StageTime.stage': 'Stage', 'Progress.stage': 'Stage | (string & {})' };

const arrays = {
  double: 'Float64Array',
  float: 'Float32Array',
  uint32_t: 'Uint32Array',
  int32_t: 'Int32Array',
  uint8_t: 'Uint8Array',
  int8_t: 'Int8Array',
  int64_t: 'Float64Array',
};
const scalars = { bool: 'boolean', double: 'number', 'std::string': 'string', 'const char*': 'string' };
const integers = ['int', 'uint32_t', 'int32_t', 'int64_t', 'uint64_t', 'size_t'];
for (const type of integers) scalars[type] = 'number';

const width = 140;
const nameOf = (type) => names[type] ?? type;

/** Whole lines at the depth of the struct, with the code of functions left out, as { code, doc, group, isSpaced } of its members. */
function membersOf(lines) {
  const members = new Map();
  let [doc, group, isSpaced, code, depth, last] = [[], [], false, '', 0, []];
  for (const line of lines) {
    const [, text, comment] = line.match(/^\s*(.*?)\s*(\/\/.*)?$/);
    if (depth === 0 && !text && comment?.startsWith('///<')) for (const member of last) member.doc.push(comment.slice(4).trim());
    else if (depth === 0 && !text && comment?.startsWith('///')) doc.push(comment.slice(3).trim());
    else if (depth === 0 && !text && comment) group.push(comment.slice(2).trim());
    else if (!text) isSpaced = true;
    if (!text) continue;
    code = `${code} ${text}`.trim();
    depth += text.split('{').length - text.split('}').length;
    if (depth > 0 || !/[;}]$/.test(code)) continue;
    const [, type, declared] = code.match(/^((?:const char\*)|[\w:]+(?:<[^()]*>)?) (\w[^()]*);$/) ?? [];
    last = declared
      ? declared
          .replace(/\{.*?\}| = [^,]+/g, '')
          .split(', ')
          .map((name) => ({ name, type, doc, group: [], isSpaced: false }))
      : [];
    if (last.length) Object.assign(last[0], { group, isSpaced });
    if (comment?.startsWith('///<')) doc.push(comment.slice(4).trim());
    for (const member of last) members.set(member.name, member);
    [doc, group, isSpaced, code] = [[], [], false, ''];
  }
  return members;
}

/** What fields() visits: the struct whose fields come first, and { name, isOptional, flag } of each member. */
function fieldsOf(struct, body) {
  const [, code] = body.match(/static void fields\(auto& self, const auto& f\) \{([\s\S]*?)\}\s*$/) ?? [];
  if (code === undefined) {
    if (/\bfields\(/.test(body)) throw new Error(`${struct}: fields(auto& self, const auto& f) must be its last member`);
    return undefined;
  }
  const result = { bases: [], fields: [] };
  for (const call of code
    .split(';')
    .map((text) => text.replace(/\s+/g, ' ').trim())
    .filter(Boolean)) {
    const [, base] = call.match(/^(\w+)::fields\(self\.\w+, f\)$/) ?? [];
    const [, name, member, optional, items, flag] =
      call.match(/^f\((?:ArrayInfo\{)?"(\w+)"[^}"]*?\}?, (?:self\.(\w+)|(Optional)\(self\.(\w+)(?:, &self\.(\w+))?\))\)$/) ?? [];
    if (base) result.bases.push(base);
    else if (name && name === (member ?? items)) result.fields.push({ name, isOptional: optional !== undefined, flag });
    else throw new Error(`${struct}: can't read ${call}`);
  }
  return result;
}

/** The structs with fields() and the enumerations of a header. */
function readHeader(file) {
  const text = readFileSync(join(headerFolder, file), 'utf8');
  const docBefore = (index) =>
    text
      .slice(0, index)
      .match(/((?:\/\/\/.*\n)*)$/)[1]
      .replace(/^\/\/\/ ?/gm, '')
      .trimEnd()
      .split('\n');
  const structs = [...text.matchAll(/^struct (\w+)(?: : \w+)? \{\n([\s\S]*?)^\};/gm)].flatMap((match) => {
    const [, name, body] = match;
    const visited = fieldsOf(name, body);
    return visited ? [{ name, file, doc: docBefore(match.index), members: membersOf(body.split('\n')), ...visited }] : [];
  });
  const enums = [...text.matchAll(/^enum class (\w+)(?: : \w+)? \{\n([\s\S]*?)^\};/gm)].map((match) => {
    const members = membersOf(
      match[2].replace(/^( *\w+),?( *\/\/.*)?$/gm, (_, word, doc) => `int ${word.trim()};${doc ?? ''}`).split('\n'),
    );
    return { name: match[1], file, doc: docBefore(match.index), members };
  });
  return { structs, enums };
}

const headers = readdirSync(headerFolder)
  .filter((file) => file.endsWith('.h') && !leftOut.includes(file))
  .sort()
  .map(readHeader);
const structs = headers.flatMap((header) => header.structs);
const enums = new Map(headers.flatMap((header) => header.enums).map((one) => [one.name, one]));

/** What comments of C++ say, as those of TypeScript say it: a sentence, or several, in paragraphs. */
function sentence(lines) {
  if (!lines.some(Boolean)) return '';
  const text = lines
    .map((line) => line || '\n')
    .join(' ')
    .replace(/ \n /g, '\n')
    .replace(/\b(\w+)::(\w+)/g, (_, type, word) => (enums.has(type) ? `"${word}"` : `${type}.${word}`));
  const capital = text.replace(/^./, (letter) => letter.toUpperCase());
  return /[.:]$/.test(capital) ? capital : `${capital}.`;
}

function wrapped(text, most) {
  const lines = [''];
  for (const word of text.split(' ')) {
    const line = lines[lines.length - 1];
    if (line && line.length + 1 + word.length > most) lines.push(word);
    else lines[lines.length - 1] = line ? `${line} ${word}` : word;
  }
  return lines;
}

function comment(text, indent) {
  if (!text) return [];
  if (indent.length + text.length + 7 <= width && !text.includes('\n')) return [`${indent}/** ${text} */`];
  const paragraphs = text.split('\n').map((paragraph) => wrapped(paragraph, width - indent.length - 3));
  const lines = paragraphs.flatMap((paragraph, i) => (i > 0 ? ['', ...paragraph] : paragraph));
  return [`${indent}/**`, ...lines.map((line) => `${indent} * ${line}`.trimEnd()), `${indent} */`];
}

/** The type of a member: { ts, kind }, the latter as in fields.js. */
function typeOf(struct, { name, isOptional }) {
  const member = struct.members.get(name);
  if (!member) throw new Error(`${struct.name}.${name}: no declaration was found in ${struct.file}`);
  const { type } = member;
  const [, item] = type.match(/^std::vector<(.*)>$/) ?? [];
  const array = arrays[item] ?? (enums.has(item) ? 'Uint8Array' : undefined);
  const absent = isOptional ? ' | null' : '';
  if (array) return { ts: `${array}<ArrayBuffer>${absent}`, kind: `${array}${absent}` };
  if (item) return { ts: `${scalars[item] ?? nameOf(item)}[]`, kind: 'array' };
  const [, number] = type.match(/^std::array<(\w+), 3>$/) ?? [];
  if (number) return { ts: '[number, number, number]', kind: integers.includes(number) ? 'integer[3]' : 'number[3]' };
  if (type === 'Fingerprint') return { ts: type, kind: type };
  const scalar = words[`${struct.name}.${name}`] ?? scalars[type];
  return scalar ? { ts: scalar, kind: integers.includes(type) ? 'integer' : scalars[type] } : { ts: nameOf(type), kind: nameOf(type) };
}

/** What the comment of a member says, with the numbers of words, and when it is null instead of an empty array. */
function docOf(struct, { name, isOptional, flag }) {
  const { type, doc } = struct.members.get(name);
  if (type === 'Fingerprint') return { text: sentence([`${name === 'fingerprint' ? 'that' : 'the fingerprint'} ${doc.join(' ')}`]) };
  const reason =
    flag &&
    struct.members
      .get(flag)
      .doc.join(' ')
      .replace(/^whether/, 'null unless');
  const text = doc.join(' ').replace(/; empty unless \w+$/, (all) => (flag ? `. ${sentence([reason])}` : all));
  const [, item] = type.match(/^std::vector<(\w+)>$/) ?? [];
  const named = item && [...enums.keys()].find((word) => item === word || new RegExp(`: ${word}$`).test(text));
  const numbered = named && [...enums.get(named).members.keys()].map((word, i) => `${i}: ${word}`).join(', ');
  const whole = named ? `${text.replace(`: ${named}`, '')}: ${nameOf(named)} as a number (${numbered})` : text;
  return {
    text: sentence([isOptional ? whole.replace(/\b(e)mpty (?=if|unless)/gi, (_, e) => (e === 'e' ? 'null ' : 'Null ')) : whole]),
    named,
  };
}

/** { name, lines, used } of an interface; `used`: the names of other types in it. */
function interfaceOf(struct) {
  const lines = comment(sentence(struct.doc), '');
  const bases = struct.bases.map(nameOf);
  const used = new Set(bases);
  lines.push(`export interface ${nameOf(struct.name)}${bases.length ? ` extends ${bases.join(', ')}` : ''} {`);
  for (const [i, field] of struct.fields.entries()) {
    const { ts } = typeOf(struct, field);
    const { group, isSpaced } = struct.members.get(field.name);
    const { text, named } = docOf(struct, field);
    if (isSpaced && i > 0) lines.push('');
    lines.push(...group.map((line) => `  // ${line}`), ...comment(text, '  '), `  ${field.name}${ts === 'Fingerprint' ? '?' : ''}: ${ts};`);
    for (const [word] of ts.matchAll(/\b[A-Z]\w+/g)) used.add(word);
    if (named) used.add(nameOf(named));
  }
  return { name: nameOf(struct.name), lines: [...lines, '}'], used };
}

function unionOf({ name, doc, members }) {
  const lines = [...comment(sentence(doc), ''), `export type ${nameOf(name)} =`];
  for (const [word, { doc: meaning }] of members) lines.push(...comment(sentence(meaning), '  '), `  | '${word}'`);
  return [...lines.slice(0, -1), `${lines.at(-1)};`];
}

const note = '// Written by wasm/results.mjs from the headers in src/include/mandoline: change those.';
const isPhysics = ({ file }) => physicsHeaders.includes(file);
const isMain = (one) => !isPhysics(one);

/** The text of results.d.ts. Types that are not in it are taken from `own`, the entry beside it, or are the main entry's. */
function typesOf(isIncluded, own, main) {
  const interfaces = structs.filter(isIncluded).map(interfaceOf);
  const used = new Set(interfaces.flatMap((one) => [...one.used]));
  const unions = [...enums.values()].filter((one) => isIncluded(one) && used.has(nameOf(one.name)));
  const here = new Set([...interfaces, ...unions].map(({ name }) => nameOf(name)));
  const foreign = [...used].filter((name) => !here.has(name) && !/Array$|^ArrayBuffer$/.test(name)).sort();
  const isOfMain = (name) => own !== main && structs.some((struct) => nameOf(struct.name) === name && isMain(struct));
  const imports = [main, own].flatMap((entry, isOwn) => {
    const list = foreign.filter((name) => isOfMain(name) === !isOwn);
    return list.length ? [`import type { ${list.join(', ')} } from '${entry}';`] : [];
  });
  const blocks = [[note, ...imports], ...interfaces.map(({ lines }) => lines), ...unions.map(unionOf)];
  return `${blocks.map((lines) => lines.join('\n')).join('\n\n')}\n`;
}

/** The text of fields.js: the kind of each member of a struct, and the words of an enumeration in the order of their numbers. */
function fieldsFile(isIncluded) {
  const allFields = (struct) => [
    ...struct.bases.flatMap((base) => allFields(structs.find(({ name }) => name === base))),
    ...struct.fields.map((field) => `  ${field.name}: '${typeOf(struct, field).kind}',`),
  ];
  const kinds = structs.filter(isIncluded).map((struct) => [`export const ${struct.name} = {`, ...allFields(struct), '};'].join('\n'));
  const lists = [...enums.values()].filter(isIncluded).map(({ name, members }) => {
    const list = [...members.keys()].map((word) => `'${word}'`);
    const line = `export const ${name} = [${list.join(', ')}];`;
    return line.length <= width ? line : [`export const ${name} = [`, ...list.map((word) => `  ${word},`), '];'].join('\n');
  });
  return `${[note, ...kinds, ...lists].join('\n\n')}\n`;
}

const files = {
  'results.d.ts': typesOf(isMain, './index.js', './index.js'),
  'fields.js': fieldsFile(isMain),
  'physics/results.d.ts': typesOf(isPhysics, './index.js', '../index.js'),
  'physics/fields.js': fieldsFile(isPhysics),
};
const isChanged = (name) => {
  const file = join(packageFolder, 'src', name);
  return !existsSync(file) || readFileSync(file, 'utf8') !== files[name];
};
const changed = Object.keys(files).filter(isChanged);
if (process.argv.includes('--check') && changed.length) {
  console.error(`Not as the headers have it: ${changed.join(', ')}. Run node wasm/results.mjs.`);
  process.exit(1);
}
for (const name of changed) writeFileSync(join(packageFolder, 'src', name), files[name]);
