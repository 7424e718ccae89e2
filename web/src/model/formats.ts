// Apart from their readers, which the worker alone needs.
export const formats = ['obj', 'stl', 'ply', 'off', 'glb', 'gltf'] as const;
export type Format = (typeof formats)[number];

/** A 3MF file is packed by itself. */
export const fileExtensions: readonly string[] = [...formats.flatMap((format) => [`.${format}`, `.${format}.gz`]), '.3mf'];
