// Where the camera stands: where the settings have it, around all that is shown, or at what is drawn instead of the model.
import type { Vector3 } from 'three';
import type { Model } from '../../model/cut_model';
import type { Instead } from '../../model/instead';
import type { Settings } from '../../model/settings';
import { shownRegions, upOf } from '../../model/shown';
import type { View } from '../../model/view';
import type { Camera } from './camera';
import { cellPoints, framedPoints, insteadPoints, type Extent } from './extent';
import type { Look } from './layer';
import { fromWorld, haveSameSpace, toWorld } from './scene_space';
import { Visit } from './visit';

type Shown = Pick<Look, 'model' | 'settings' | 'shifts' | 'instead'>;

/** Of the picture, what a cell fills that one flies to. */
const cellShare = 0.25;

export class Framing {
  /** The camera was moved, by the person. */
  onMoved: View['onCamera'] = () => {};
  private readonly visit: Visit;
  private isFramed = false;
  /** The camera of the settings, where it stands. */
  private known = '';
  /** What decides how far the picture has to reach. */
  private reach = '';

  constructor(
    private readonly camera: Camera,
    private readonly shown: () => Shown | null,
  ) {
    this.visit = new Visit(camera);
    camera.onMoved = () => this.tell();
  }

  /** The next look is seen as a whole, unless it has a camera. */
  forget(): void {
    this.isFramed = false;
  }

  /** The camera keeps looking at the same place, and so does where it goes back to. */
  keep(from: Model, to: Model): void {
    if (haveSameSpace(from, to)) return;
    const move = (point: Vector3) => fromWorld(to, toWorld(from, point));
    this.camera.transform(move);
    this.visit.transform(move);
  }

  follow(settings: Settings): void {
    const { camera, explode, show, wind } = settings;
    const shown = this.shown();
    const model = shown?.model;
    if (model) this.camera.setUp(upOf(settings, model));
    if (camera && model && JSON.stringify(camera) !== this.known) {
      this.known = JSON.stringify(camera);
      this.isFramed = true;
      this.camera.place({ position: fromWorld(model, camera.position), target: fromWorld(model, camera.target) });
    }
    const reach = JSON.stringify([explode, explode.regions > 0 && model?.id, show.outside, wind.on, wind.smoke]);
    const isOther = reach !== this.reach;
    this.reach = reach;
    if (!this.isFramed) this.frame();
    // Until the person moves the camera, exploded parts, the outside and the wind's arrow stay in view.
    else if (isOther && this.camera.isFramed && !shown?.instead) this.frameShown(true);
  }

  frame(): void {
    if (!this.shown()) return;
    this.isFramed = true;
    this.known = '';
    this.frameShown(false);
  }

  private frameShown(keepDirection: boolean): void {
    const extent = this.extent();
    if (extent) this.camera.frame(framedPoints(extent), keepDirection);
  }

  private extent(): Extent | null {
    const shown = this.shown();
    return shown && { ...shown, regions: shownRegions(shown.model, shown.settings) };
  }

  /** Flies to a cell, or to where all is seen. */
  flyToCell(cell: number | null): void {
    const extent = this.extent();
    if (!extent || this.shown()?.instead) return;
    if (cell === null) this.camera.flyTo(framedPoints(extent));
    else this.camera.flyTo(cellPoints(extent, cell), cellShare);
  }

  /** Goes to what is drawn instead of the model, unless it is there, or back. */
  visitInstead(instead: Instead | null, former: Instead | null): void {
    const model = this.shown()?.model;
    const isNew = instead !== null && (former === null || subjectOf(instead) !== subjectOf(former));
    if (isNew && model) this.visit.begin(insteadPoints(model, instead));
    else if (!instead) this.visit.end(() => this.frameShown(true));
  }

  private tell(): void {
    const shown = this.shown();
    if (!shown || shown.instead) return;
    const { position } = this.camera.camera;
    const camera = { position: toWorld(shown.model, position), target: toWorld(shown.model, this.camera.controls.target) };
    this.known = JSON.stringify(camera);
    this.onMoved(camera);
  }
}

/** The same for pictures of the same thing, made of different cuts. */
function subjectOf(instead: Instead): string {
  return JSON.stringify(instead.kind === 'crossings' ? instead.kind : instead.choices.request);
}
