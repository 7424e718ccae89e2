import { computed } from '@preact/signals';
import type { App } from './app';
import { fromHash, toHash } from '../model/hash';
import type { Settings } from '../model/settings';

/** What sliders and handles change, step by step. */
const continuous = ['n', 'box', 'snap', 'x', 'y', 'z', 'free', 'explode', 'pose', 'divider', 'volumes'];
/** In ms: a change has been made once nothing has changed for so long ... */
const pause = 300;
/** ... and a continuous one goes on if it is taken up again within this time. */
const rest = 1000;

/**
 * Keeps the URL in step with the settings, and the settings with the URL: Back and Forward go through what was opened, its cuts and their
 * looks, one change at a time. The camera is part of each.
 */
export async function followLink(app: App): Promise<void> {
  let timer = 0;
  /** The hash of this entry of the history. */
  let known = hashHere();
  /** Whether the settings come from the entry: what its link leaves out isn't a change. */
  let isRead = true;
  let change = { keys: '', at: 0 };

  const isNewChange = (hash: string) => {
    const keys = changedKeys(known, hash).filter((key) => key !== 'camera');
    const goesOn = keys.join() === change.keys && (app.state.isHeld.value || performance.now() - change.at < rest);
    change = { keys: keys.every((key) => continuous.includes(key)) ? keys.join() : '', at: performance.now() };
    return keys.length > 0 && !goesOn;
  };
  const isPlaying = computed(() => app.state.playing.value !== null);
  const write = (isBegin = false) => {
    if (app.state.status.value === 'busy') return; // The look may still be adapted to the mesh.
    if (isPlaying.value && !isBegin) return; // What moves by itself makes no steps.
    const hash = toHash(app.settings);
    const isNew = !isRead && isNewChange(hash);
    isRead = false;
    if (hash === known) return;
    known = hash;
    const url = hash ? `#${hash}` : location.pathname + location.search;
    if (isNew) history.pushState(null, '', url);
    else history.replaceState(null, '', url);
  };
  const writeSoon = () => {
    clearTimeout(timer);
    timer = window.setTimeout(() => write(), pause);
  };
  const read = async () => {
    known = hashHere();
    isRead = true;
    const { settings, problems } = fromHash(known);
    if (problems.length > 0) app.state.notice(`Parts of the link were not understood (${problems.join(', ')}); the rest is shown.`);
    if (settings.source.kind === 'file' && !app.meshes.canOpen(settings.source)) {
      app.state.notice(
        `The link was made from the file ${settings.source.name}, which it does not contain. Open that file to see the same view.`,
      );
    }
    await app.restore(settings);
    write(); // At once: what is clicked next is a step.
  };
  // Of the same change both may tell.
  for (const event of ['popstate', 'hashchange']) addEventListener(event, () => hashHere() !== known && void read());
  for (const event of ['pointerdown', 'pointerup', 'pointercancel']) {
    addEventListener(event, () => (app.state.isHeld.value = event === 'pointerdown'), { capture: true });
  }
  await read();
  // What is opened to play has a step of its own before it moves on.
  isPlaying.subscribe((begins) => (begins ? write(true) : writeSoon()));
  app.state.status.subscribe((status) => status !== 'busy' && writeSoon());
  app.state.settings.subscribe(writeSoon);
}

/** Of the page with these settings, as a page of its own or as a part of another. */
export function addressOf(settings: Settings, isEmbedded = false): string {
  const url = new URL(location.href);
  url.search = isEmbedded ? '?embed' : '';
  url.hash = toHash(settings);
  return url.href;
}

function hashHere(): string {
  return location.hash.slice(1);
}

/** The keys of which two hashes say different things. */
function changedKeys(one: string, other: string): string[] {
  const [a, b] = [new URLSearchParams(one), new URLSearchParams(other)];
  return [...new Set([...a.keys(), ...b.keys()])].filter((key) => a.get(key) !== b.get(key));
}
