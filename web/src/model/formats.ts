// Apart from their readers, which the worker alone needs.
export const formats = ['obj', 'stl', 'ply', 'off', 'glb', 'gltf'] as const;
export type Format = (typeof formats)[number];

/** A 3MF file is packed by itself. */
export const fileExtensions: readonly string[] = [...formats.flatMap((format) => [`.${format}`, `.${format}.gz`]), '.3mf'];

const extension = new RegExp(`(\\.(${formats.join('|')}|3mf))?(\\.gz)?$`, 'i');

/** The name of a file without what says its format. */
export function stemOf(name: string): string {
  return name.replace(extension, '');
}

/** A text for the name of a file: letters and digits of any script stay. */
export function inFileName(text: string): string {
  return text.replaceAll(/[^\p{L}\p{M}\p{N}_.-]+/gu, '-');
}
