// What is shown, as a GLB file.
import { BufferGeometry, Float32BufferAttribute, Group, Mesh, MeshStandardMaterial, type Object3D } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';
import type { Model, Settings } from '../types';
import type { CutCells } from './cut_cells';
import type { ViewPlane } from './planes';

export interface Shown {
  model: Model;
  settings: Settings;
  planes: readonly ViewPlane[];
  cells: CutCells;
  parts: Object3D[];
}

export async function exportGlb(shown: Shown): Promise<Blob> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute([], 3));
  const scene = new Group();
  scene.add(new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true })));
  const bytes = await new GLTFExporter().parseAsync(scene, { binary: true });
  return new Blob([bytes as ArrayBuffer], { type: 'model/gltf-binary' });
}
