// Compiles all shaders while the first mesh is being cut, a few at a time: what is asked of the GPU while it compiles blocks the page.
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
  /** What is with the compiler and has yet to be taken over: that of the first picture, then all else. */
  private readonly batches: Program[][] = [];
  private readonly known = new Set<Program>();
  private awaited: Program[] | null = null;
  private isOver = false;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly camera: Camera,
  ) {}

  /** Hands shaders to the compiler: those of the first picture, then the others. */
  async compile(first: Pass, others: readonly Pass[]): Promise<void> {
    const { renderer } = this;
    // Makes what waits for the GPU while that has nothing else to do: the targets, and an extension that textures ask for.
    for (const { target } of [...others, first]) renderer.setRenderTarget(target);
    renderer.extensions.has('OES_texture_float_linear');
    await this.compilePass(first);
    this.addBatch();
    for (const pass of others) await this.compilePass(pass);
    this.addBatch();
  }

  /** Leaves what is not compiled yet to the pictures that need it: the graphics context is lost, and programs with it, or it has failed. */
  forget(): void {
    this.isOver = true;
  }

  private addBatch(): void {
    const programs = (this.renderer.info.programs ?? []) as Program[];
    this.batches.push(programs.filter((program) => !this.known.has(program)));
    for (const program of programs) this.known.add(program);
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

  /** Takes over a part of what has been compiled, to be called when the GPU has caught up. Gives whether there is more in this batch. */
  takeOver(): boolean {
    if (this.isOver) return false;
    const [programs] = this.batches;
    if (!programs) return true;
    if (this.awaited !== programs) {
      // Has the GPU wait for its compiler, not the page.
      for (const { program } of programs) this.renderer.getContext().validateProgram(program as globalThis.WebGLProgram);
      this.awaited = programs;
      return true;
    }
    const end = performance.now() + most;
    // Their uniforms are asked for once, by default when they are first used.
    while (programs.at(-1)?.isReady() && performance.now() < end) programs.pop()?.getUniforms();
    if (programs.length === 0) this.batches.shift();
    return programs.length > 0;
  }
}
