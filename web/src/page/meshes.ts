// Which mesh is loaded, and the files that meshes came from.
import { isAbort } from '../model/failure';
import type { Engine, MeshInfo } from '../model/engine';
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

  keepFile(name: string, bytes: ArrayBuffer): void {
    this.files.set(name, new Blob([bytes]));
  }

  /** Files can be opened again as long as the page is there. */
  canOpen(source: Source): boolean {
    return source.kind !== 'file' || this.files.has(source.name);
  }

  /** Failures are shown in the end; the outcome is "superseded" if a newer mesh was asked for meanwhile. */
  load(source: Source): Promise<'loaded' | 'failed' | 'cancelled' | 'superseded'> {
    const load = ++this.loads;
    const isOld = () => load !== this.loads;
    return this.work.doing('loading', async () => {
      try {
        const mesh = await this.fetch(source, isOld);
        if (!mesh || isOld()) return 'superseded';
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

  /** Null if it is no longer wanted by the time that its file has been read. */
  private async fetch(source: Source, isOld: () => boolean): Promise<MeshInfo | null> {
    const bytes = source.kind === 'file' ? await this.files.get(source.name)?.arrayBuffer() : undefined;
    return isOld() ? null : this.engine.load(source, bytes);
  }
}
