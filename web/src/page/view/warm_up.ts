// Compiles the shaders that the first picture doesn't need once that has stood, a few at a time: what is asked of the GPU while it compiles
// blocks the page.
import type { Camera, Object3D, WebGLProgram, WebGLRenderer, WebGLRenderTarget } from 'three';

/** In ms, at a time. */
const most = 10;

/** Drawn to the canvas, or to a target of its own: the shaders differ. */
export interface Pass {
  scene: Object3D;
  target: WebGLRenderTarget | null;
}

/** The types of three.js lack it. */
type Program = WebGLProgram & { isReady(): boolean };

export class WarmUp {
  /** What is with the compiler and has yet to be taken over; null before all of it is there. */
  private programs: Program[] | null = null;
  private hasBegun = false;
  private isAwaited = false;
  private isOver = false;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly camera: Camera,
    private readonly passes: readonly Pass[],
  ) {}

  /** Leaves what is not compiled yet to the pictures that need it: the graphics context is lost, and programs with it, or it has failed. */
  forget(): void {
    this.isOver = true;
  }

  /** Hands all that is new to the compiler. */
  private async compile(): Promise<void> {
    const programs = () => (this.renderer.info.programs ?? []) as Program[];
    const known = new Set(programs());
    for (const pass of this.passes) await this.compilePass(pass);
    this.programs = programs().filter((program) => !known.has(program));
  }

  private async compilePass({ scene, target }: Pass): Promise<void> {
    const objects: Object3D[] = [];
    scene.traverse((object) => 'material' in object && objects.push(object));
    let end = performance.now() + most;
    for (const object of objects) {
      if (this.isOver) return;
      this.renderer.setRenderTarget(target);
      this.renderer.compile(object, this.camera);
      this.renderer.setRenderTarget(null);
      if (performance.now() < end) continue;
      await new Promise((resolve) => setTimeout(resolve));
      end = performance.now() + most;
    }
  }

  /** Takes over a part of what has been compiled, to be called when the GPU has caught up. Gives whether there is more. */
  takeOver(): boolean {
    if (!this.hasBegun) {
      this.hasBegun = true;
      void this.compile().catch(() => this.forget());
    }
    if (this.isOver) return false;
    const { programs } = this;
    if (!programs) return true;
    if (!this.isAwaited) {
      // Has the GPU wait for its compiler, not the page.
      for (const { program } of programs) this.renderer.getContext().validateProgram(program as globalThis.WebGLProgram);
      this.isAwaited = true;
      return true;
    }
    const end = performance.now() + most;
    // Their uniforms are asked for once, by default when they are first used.
    while (programs.at(-1)?.isReady() && performance.now() < end) programs.pop()?.getUniforms();
    return programs.length > 0;
  }
}
