// Compiles shaders before they are used, a few at a time: what is asked of the GPU while it compiles blocks the page.
import type { Camera, Material, Object3D, WebGLProgram, WebGLRenderer, WebGLRenderTarget } from 'three';

/** In ms, at a time. */
const most = 10;

/** Drawn to the canvas, or to a target of its own: the shaders differ. */
export interface Pass {
  scene: Object3D;
  target: WebGLRenderTarget | null;
}

/** The types of three.js lack it. */
type Program = WebGLProgram & { isReady(): boolean };

type Drawn = Object3D & { material: Material | Material[] };

/** All that is drawn. */
interface Passes {
  scene: Object3D;
  /** What of the scene the first picture is sure to show. */
  first: readonly Object3D[];
  shadow: { passes: readonly Pass[]; isDue: boolean };
  picker: { pass: Pass };
}

export class Shaders {
  /** Those for which the GPU waits for its compiler, and those that have been taken over. */
  private readonly awaited = new Set<Program>();
  private readonly taken = new Set<Program>();
  private isOver = false;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly camera: Camera,
    private readonly passes: Passes,
  ) {}

  /** Leaves what is not compiled yet to the pictures that need it: the graphics context is lost, and programs with it. */
  forget(): void {
    this.isOver = true;
  }

  /** Whether the next picture can be drawn at once. If not, does a part of the work: to be asked again once the GPU has caught up. */
  areReady(): boolean {
    const { scene, shadow } = this.passes;
    return this.prepare([{ scene, target: null }, ...(shadow.isDue ? shadow.passes : [])], false);
  }

  areReadyToPick(): boolean {
    return this.prepare([this.passes.picker.pass], false);
  }

  /** The same of all pictures that may come, or of what the first one is sure to show. */
  areReadyAhead(isAll: boolean): boolean {
    const { scene, first, shadow, picker } = this.passes;
    if (isAll) return this.prepare([{ scene, target: null }, ...shadow.passes, picker.pass], true);
    return this.prepare(
      first.map((object) => ({ scene: object, target: null })),
      false,
    );
  }

  private prepare(passes: readonly Pass[], isAll: boolean): boolean {
    if (this.isOver || this.renderer.getContext().isContextLost()) return true;
    const end = performance.now() + most;
    const programs = new Set<Program>();
    for (const { scene, target } of passes) {
      for (const object of drawn(scene, isAll)) {
        if (!this.programsOf(object).every(Boolean)) {
          if (performance.now() > end) return false;
          this.renderer.setRenderTarget(target);
          this.renderer.compile(object, this.camera);
          this.renderer.setRenderTarget(null);
        }
        for (const program of this.programsOf(object)) if (program && !this.taken.has(program)) programs.add(program);
      }
    }
    return this.take(programs, end);
  }

  /** Gives whether all of them have been taken over. */
  private take(programs: ReadonlySet<Program>, end: number): boolean {
    let isNew = false;
    for (const program of programs) {
      if (this.awaited.has(program)) continue;
      this.awaited.add(program);
      isNew = true;
      // Has the GPU wait for its compiler, not the page.
      this.renderer.getContext().validateProgram(program.program as globalThis.WebGLProgram);
    }
    if (isNew) return false;
    for (const program of programs) {
      if (!program.isReady() || performance.now() > end) return false;
      // They are asked for once, by default when they are first used.
      program.getUniforms();
      this.taken.add(program);
    }
    return true;
  }

  private programsOf({ material }: Drawn): (Program | undefined)[] {
    const { properties } = this.renderer;
    return [material].flat().map((one) => (properties.get(one) as { currentProgram?: Program }).currentProgram);
  }
}

function drawn(scene: Object3D, isAll: boolean): Drawn[] {
  const objects: Drawn[] = [];
  const take = (object: Object3D) => 'material' in object && objects.push(object as Drawn);
  if (isAll) scene.traverse(take);
  else scene.traverseVisible(take);
  return objects;
}
