// Marks on the selected cut-cells that are too small to be seen, in front of everything else.
import { BufferGeometry, Points, ShaderMaterial } from 'three';
import { activePlanes, isBeyond } from '../../../model/planes';
import { isAll } from '../../../model/volumes';
import { refill } from '../buffers';
import { shiftAlong } from '../explosion';
import type { Layer, Look } from '../layer';
import type { Uniforms } from '../material';
import type { CutCells } from './cut_cells';

/** In CSS pixels: the width of a mark, that of the pinned cell's, and the size of cells that need none. */
const [width, widthPinned, seen] = [7, 15, 5];

export class Marks implements Layer {
  readonly object: Points<BufferGeometry, ShaderMaterial>;
  private readonly pixelRatio = { value: 1 };

  constructor(
    { accent, stageHeight, pinned }: Uniforms,
    private readonly cells: CutCells,
  ) {
    const uniforms = { accent, stageHeight, pinned, pixelRatio: this.pixelRatio };
    const material = new ShaderMaterial({ uniforms, vertexShader, fragmentShader, transparent: true, depthTest: false, depthWrite: false });
    this.object = new Points(new BufferGeometry(), material);
    this.object.frustumCulled = false;
  }

  dependsOn({ model, settings }: Look): readonly unknown[] {
    const { show, volumes, explode, slices, sliceMode } = settings;
    return [model.id, show, volumes, explode, ...(isAll(volumes) ? [] : [slices, sliceMode])];
  }

  setLook(look: Look): void {
    this.object.visible = !isAll(look.settings.volumes);
    if (!this.object.visible) return;
    const marked = this.markedCells(look);
    const { centroid, region, volume } = look.model.cells;
    const position = new Float32Array(3 * marked.length);
    marked.forEach((cell, at) => {
      for (let d = 0; d < 3; d++) {
        const middle = centroid[3 * cell + d];
        position[3 * at + d] = middle + shiftAlong(d, look, middle, region[cell]);
      }
    });
    refill(this.object.geometry, {
      position: { array: position, size: 3 },
      size: { array: Float32Array.from(marked, (cell) => Math.cbrt(volume[cell])), size: 1 },
      cell: { array: Float32Array.from(marked), size: 1 },
    });
  }

  private markedCells({ model, settings }: Look): number[] {
    const planes = activePlanes(model, settings);
    const { centroid, region } = model.cells;
    const isKept = (cell: number) => !isBeyond(planes, centroid[3 * cell], centroid[3 * cell + 1], centroid[3 * cell + 2]);
    return Array.from(region.keys()).filter((cell) => this.cells.isShown(cell) && isKept(cell));
  }

  setPixelRatio(ratio: number): void {
    this.pixelRatio.value = ratio;
  }
}

const vertexShader = /* glsl */ `
uniform float stageHeight;
uniform float pixelRatio;
uniform int pinned;
attribute float size;
attribute float cell;

void main() {
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  float pixels = size * length(modelViewMatrix[0].xyz) * 0.5 * stageHeight * projectionMatrix[1][1] / max(-place.z, 1e-6);
  bool isPinned = int(cell) == pinned;
  gl_PointSize = pixelRatio * (isPinned ? ${widthPinned}.0 : ${width}.0);
  // Beyond the far plane, nothing is drawn.
  gl_Position = isPinned || pixels < ${seen}.0 ? projectionMatrix * place : vec4(0.0, 0.0, 2.0, 1.0);
}
`;

const fragmentShader = /* glsl */ `
uniform vec3 accent;

void main() {
  float off = 2.0 * length(gl_PointCoord - 0.5);
  if (off > 1.0) discard;
  gl_FragColor = vec4(accent, 0.85);
  #include <colorspace_fragment>
}
`;
