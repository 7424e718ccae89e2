// Where the camera stands: where the settings have it, around all that is shown, or at what is drawn instead of the model.
import type { Instead, Settings, View } from '../../model/types';
import type { Camera } from './camera';
import { shownBall } from './extent';
import type { Look } from './layer';
import { fromModel, fromWorld, sceneScale, toWorld } from './scene_space';
import { Visit } from './visit';

type Shown = Pick<Look, 'model' | 'settings' | 'shifts' | 'instead'>;

export class Framing {
  /** The camera was moved, by the person. */
  onMoved: View['onCamera'] = () => {};
  private readonly visit: Visit;
  private isFramed = false;
  /** The camera of the settings, where it stands. */
  private known = '';
  private explosion = '';

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

  follow({ camera, explode }: Settings): void {
    const shown = this.shown();
    const model = shown?.model;
    if (camera && model && JSON.stringify(camera) !== this.known) {
      this.known = JSON.stringify(camera);
      this.isFramed = true;
      this.camera.place({ position: fromWorld(model, camera.position), target: fromWorld(model, camera.target) });
    }
    const explosion = JSON.stringify([explode, explode.regions > 0 && model?.id]);
    const isPulled = explosion !== this.explosion;
    this.explosion = explosion;
    if (!this.isFramed) this.frame();
    // Until the person moves the camera, exploded parts stay in view.
    else if (isPulled && this.camera.isFramed && !shown?.instead) this.frameShown(true);
  }

  frame(): void {
    if (!this.shown()) return;
    this.isFramed = true;
    this.known = '';
    this.frameShown(false);
  }

  private frameShown(keepDirection: boolean): void {
    const shown = this.shown();
    if (!shown) return;
    const { model, settings, shifts } = shown;
    const { center, radius } = shownBall(model, settings, shifts);
    this.camera.frame(fromModel(model, center), radius * sceneScale(model), keepDirection);
  }

  /** Goes to what is drawn instead of the model, unless it is there, or back. */
  visitInstead(instead: Instead | null, former: Instead | null): void {
    const model = this.shown()?.model;
    const isNew = instead !== null && (former === null || subjectOf(instead) !== subjectOf(former));
    if (isNew && model) this.visit.begin(fromModel(model, instead.center), instead.radius * sceneScale(model) * 1.2);
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
