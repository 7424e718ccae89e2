/**
 * Tells when the GPU has drawn what it was given, and how long that took. Uploads wait inside the browser for a GPU that is behind, and block
 * the page meanwhile, so it is given nothing new before.
 */
export class GpuPace {
  private fence: WebGLSync | null = null;
  private markedAt = 0;
  private isPicture = false;
  /** How long the last picture took of which isBehind has told that it is done, in ms: as accurate as that is asked often. */
  took = 0;

  constructor(private readonly gl: WebGL2RenderingContext) {}

  /** After drawing, or after anything else that it has to do. */
  mark(isPicture = true): void {
    if (this.fence) this.gl.deleteSync(this.fence);
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    this.markedAt = performance.now();
    this.isPicture = isPicture;
  }

  /** With a new context nothing is left to wait for. */
  reset(): void {
    this.fence = null;
  }

  get isBehind(): boolean {
    if (!this.fence) return false;
    if (this.gl.clientWaitSync(this.fence, 0, 0) === this.gl.TIMEOUT_EXPIRED) return true;
    this.gl.deleteSync(this.fence);
    this.fence = null;
    if (this.isPicture) this.took = performance.now() - this.markedAt;
    return false;
  }
}
