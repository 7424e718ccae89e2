import type { GalleryEntry } from '../model/gallery/list';
import { readPreset } from '../model/gallery/preset';
import type { App } from './app';
import { reducedMotion } from './view/reduced_motion';

/** Opens a mesh of the gallery as its preset has it. What has a pose then moves, unless motion is unwanted. */
export async function openEntry(app: App, entry: GalleryEntry): Promise<void> {
  const { settings } = readPreset(entry);
  await app.restore(settings);
  const { pose, source } = settings;
  const isOpen = app.model !== null && app.settings.source === source;
  if (!pose || !isOpen || reducedMotion().matches) return;
  app.state.play.value = pose.motion;
  await app.player.play();
}
