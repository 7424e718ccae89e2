// What is loaded before it is asked for, so that it is at hand at once, also offline.
import type { Engine } from '../model/engine';
import type { View } from '../model/view';
import { loadCode } from './code';
import { firstPicture, idle } from './frames';
import type { State } from './state';
import { loadExport } from './view/files';
import { loadControls } from './view/layers/gizmo';
import type { WindTunnel } from './wind';

/**
 * Once the first picture is drawn, one after another, each when the page has nothing else to do. What can't be loaded is asked for again
 * where it is used, and missed there.
 */
export async function loadAhead(engine: Engine, state: State, view: View, wind: WindTunnel): Promise<void> {
  await firstPicture(state, view);
  state.thumbnails.value = 'seen';
  wind.beginAhead();
  for (const load of [() => engine.loadAhead(), loadExport, loadControls, loadCode]) {
    await idle();
    await load().catch(() => {});
  }
  state.thumbnails.value = 'all';
}
