// What can be saved of the view: pictures, meshes, drawings, films.
import type { Scene, WebGLRenderer } from 'three';
import { pageError } from '../../model/failure';
import type { Engine } from '../../model/engine';
import { inWorld, planeOf } from '../../model/planes';
import { upOf } from '../../model/shown';
import type { SliceName } from '../../model/slices';
import type { Picture, PictureOptions, Recording, ViewFiles } from '../../model/view';
import { sliceSvg } from '../../model/slice_svg';
import type { Layer, Look } from './layer';
import type { Caps } from './layers/caps';
import type { Gizmo } from './layers/gizmo';
import type { Shadow } from './layers/shadow';
import type { Loop } from './loop';
import { takePicture } from './picture';
import { record } from './recorder';
import type { WindTunnel } from './wind';

/** The parts of the view that files are made of. */
interface FileParts {
  renderer: WebGLRenderer;
  scene: Scene;
  loop: Loop;
  ofModel: readonly Layer[];
  caps: Caps;
  slice: Engine['slice'];
  shadow: Shadow;
  gizmo: Gizmo;
  windTunnel: WindTunnel;
  /** What has been prepared. */
  look(): Look | null;
  /** Draws with so many times the pixels of the screen per side. */
  draw(times: number): void;
}

/** What writes GLB files, loaded when the first one is saved, or ahead. */
export const loadExport = () => import('./export');

export class Files implements ViewFiles {
  constructor(private readonly parts: FileParts) {}

  /** Without handles, and in one task, so that the canvas is never seen otherwise than it was. */
  png(options: PictureOptions): Promise<Picture> {
    const { renderer, scene, loop, shadow, gizmo, windTunnel, draw } = this.parts;
    const hadGizmo = gizmo.object.visible;
    loop.prepare();
    shadow.redraw();
    gizmo.object.visible = windTunnel.hasHandle = false;
    try {
      return takePicture(renderer, scene, options, draw);
    } finally {
      gizmo.object.visible = hadGizmo;
      windTunnel.hasHandle = true;
      loop.draw();
    }
  }

  async glb(isByCell: boolean): Promise<Blob> {
    const look = this.look('The mesh');
    const { exportGlb } = await loadExport();
    return exportGlb(look, this.parts.ofModel, isByCell);
  }

  async svg(name: SliceName): Promise<Blob> {
    const look = this.look('The slice');
    const { model, settings } = look;
    const planes = inWorld([planeOf(model, settings, name)], model.origin);
    const [slice] = await this.parts.slice(planes, true);
    const { polygons, tint } = this.parts.caps.section(look, slice);
    if (polygons.length === 0) throw pageError('The slice is empty', 'The plane meets no cell that is shown. Move it, or show more.');
    const title = `${model.name}, ${model.grid.cells.join(' × ')} grid`;
    const svg = sliceSvg({ title, slice, normal: planes[0].normal, up: upOf(settings, model), polygons, tint });
    return new Blob([svg], { type: 'image/svg+xml' });
  }

  record(): Recording {
    return record(this.parts.renderer.domElement);
  }

  /** Of what is to be saved. */
  private look(what: string): Look {
    this.parts.loop.prepare();
    const look = this.parts.look();
    if (look) return look;
    throw pageError(`${what} can't be saved`, 'Nothing is shown yet.');
  }
}
