// Which mesh is loaded, and the files that meshes came from.
import { isAbort } from '../model/failure';
import type { Engine } from '../model/engine';
import type { Source } from '../model/settings';
import { asPageError } from './failure';
import type { State } from './state';
import type { Work } from './work';

export class Meshes {
  /** What was opened from files, by their names, for the way back. */
  private readonly files = new Map<string, Blob>();
  private loads = 0;

  constructor(
    private readonly engine: Engine,
    private readonly state: State,
    private readonly work: Work,
  ) {}

  /** Files can be opened again as long as the page is there. */
  canOpen(source: Source): boolean {
    return source.kind !== 'file' || this.files.has(source.name);
  }

  private fileOf(source: Source): Blob | undefined {
    return source.kind === 'file' ? this.files.get(source.name) : undefined;
  }

  /**
   * Failures are shown in the end; the outcome is "superseded" if a newer mesh was asked for meanwhile. `file`: what is opened for the first
   * time. One that can't be read doesn't take the place of an earlier one of its name.
   */
  load(source: Source, file = this.fileOf(source)): Promise<'loaded' | 'failed' | 'cancelled' | 'superseded'> {
    const load = ++this.loads;
    const isOld = () => load !== this.loads;
    return this.work.doing('loading', async () => {
      try {
        const bytes = await file?.arrayBuffer();
        if (isOld()) return 'superseded'; // no longer wanted by the time that its file has been read
        const mesh = await this.engine.load(source, bytes);
        if (isOld()) return 'superseded';
        if (file && source.kind === 'file') this.files.set(source.name, file);
        this.state.mesh.value = mesh;
        return 'loaded';
      } catch (error) {
        if (isOld()) return 'superseded';
        if (isAbort(error)) return 'cancelled';
        this.work.fail();
        this.work.alertInTheEnd(asPageError(error));
        return 'failed';
      }
    });
  }
}
