// three.js without the shaders of materials and features that this page never draws, which its first picture would wait for.
import type { Plugin } from 'vite';

/** By their names in three.js: of the background and the materials that are drawn with. */
const drawn = ['background', 'meshbasic', 'meshlambert', 'meshnormal', 'points'].flatMap((name) => [`${name}_vert`, `${name}_frag`]);
/** What the page's own shaders, those of GTAOPass and three.js itself include. */
const included = ['colorspace_fragment', 'colorspace_pars_fragment', 'common', 'packing'];
/** Of features that no material here has: such a chunk is left out if all of it has that condition. */
const unused =
  /^(alphahash|alphamap|alphatest|aomap|batching|bumpmap|cube|displacementmap|emissivemap|envmap|fog|iridescence|lightmap|lightprobes|lights_fragment_maps|morph|normalmap|roughnessmap|shadowm|skin|specularmap|tonemapping)/;

/** Comments and indentation left out. */
function compact(shader: string): string {
  const lines = shader.split('\n').map((line) => line.replace(/\/\/.*/, '').trim());
  return lines.filter(Boolean).join('\n');
}

/** Whether all of it is between #if and #endif. */
function isConditional(shader: string): boolean {
  let depth = 0;
  return shader.split('\n').every((line) => {
    if (line.startsWith('#if')) ++depth;
    else if (line.startsWith('#endif')) --depth;
    else return depth > 0;
    return true;
  });
}

function withCompactShaders(code: string): string {
  const table = code.match(/^const ShaderChunk = \{\n([\s\S]*?)^\};/m)?.[1] ?? '';
  const names = new Map([...table.matchAll(/^\t(\w+): ([\w$]+),?$/gm)].map(([, chunk, name]) => [chunk, name]));
  const textOf = (name: string) => code.match(new RegExp(`^(?:var|const) ${name.replace('$', '\\$')} = (".*");$`, 'm'))?.[1];
  const kept = new Map<string, string>();
  const keep = (chunk: string) => {
    const name = names.get(chunk);
    if (name && kept.has(name)) return;
    const text = name && textOf(name);
    if (!text) throw new Error(`three.js has no shader ${chunk}`);
    const shader = compact(JSON.parse(text));
    if (unused.test(chunk) && isConditional(shader)) return;
    kept.set(name, shader);
    for (const [, other] of shader.matchAll(/#include <(\w+)>/g)) keep(other);
  };
  for (const chunk of [...drawn, ...included]) keep(chunk);
  for (const name of names.values()) {
    const text = textOf(name);
    if (!text) throw new Error(`three.js has no shader ${name}`);
    code = code.replace(`${name} = ${text};`, () => `${name} = ${JSON.stringify(kept.get(name) ?? '')};`);
  }
  return code;
}

/** The build fails if three.js no longer has a shader that is kept. */
export function smallThree(): Plugin {
  return {
    name: 'small-three',
    apply: 'build',
    transform(code, id) {
      if (!/\/three\/build\/three\.module\.js$/.test(id)) return undefined;
      return { code: withCompactShaders(code), map: null };
    },
  };
}
