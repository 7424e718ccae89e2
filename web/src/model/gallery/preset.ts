import { same } from '../same';
import { fromHash } from '../hash';
import { defaultSettings, type Settings, type Source } from '../settings';
import { gallery, type GalleryEntry } from './list';

/** All settings with which an entry opens, read as those of a link are. */
export function readPreset({ name, preset }: GalleryEntry): ReturnType<typeof fromHash> {
  return fromHash(`mesh=${name}&${preset}`);
}

/** Null for what isn't from the gallery. */
export function presetOf(source: Source): Settings | null {
  const entry = source.kind === 'gallery' && gallery.find(({ name }) => name === source.name);
  return entry ? readPreset(entry).settings : null;
}

/** Settings for another mesh: what came with an entry of the gallery goes with it, and what was chosen since stays, as do colours. */
export function withoutPreset(settings: Settings): Settings {
  const preset = presetOf(settings.source);
  if (!preset) return settings;
  const fallback = defaultSettings();
  const own = <K extends keyof Settings>(key: K): Settings[K] => (same(settings[key], preset[key]) ? fallback[key] : settings[key]);
  const [wind, compare] = [own('wind'), own('compare')];
  // What stands beside wind or another way isn't pulled apart.
  const explode = wind.on || compare.way !== 'none' ? settings.explode : own('explode');
  return { ...settings, grid: own('grid'), sliceMode: own('sliceMode'), explode, show: own('show'), compare, wind };
}
