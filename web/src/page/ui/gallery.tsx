import { useEffect, useRef, useState } from 'preact/hooks';
import type { App } from '../app';
import { openEntry } from '../gallery';
import { gallery } from '../../model/gallery/list';

/**
 * The meshes that come with the page, as pictures: one stop of the Tab key, with arrow keys from one to the next. The one that is shown is
 * scrolled to. What to look at is said of the one that is pointed at, or else of the one that is shown.
 */
export function Gallery({ app }: { app: App }) {
  const { source } = app.settings;
  const chosen = source.kind === 'gallery' ? source.name : null;
  const list = useRef<HTMLUListElement>(null);
  /** Where the Tab key leads. */
  const [stop, setStop] = useState(0);
  const [pointed, setPointed] = useState<string | null>(null);
  useEffect(() => {
    reveal(list.current);
    setStop(Math.max(names.indexOf(chosen ?? ''), 0));
  }, [chosen]);
  useEffect(() => {
    if (list.current) return onAppearance(list.current, () => reveal(list.current));
  }, []);
  const move = (event: KeyboardEvent) => {
    const buttons = [...(list.current?.querySelectorAll('button') ?? [])];
    const to = nextStop(event.key, stop, columnsOf(buttons));
    if (to === null) return;
    event.preventDefault();
    setStop(to);
    buttons[to].focus();
  };
  return (
    <>
      <ul
        ref={list}
        class="gallery"
        id="gallery"
        aria-label="Gallery"
        onKeyDown={move}
        onPointerLeave={() => setPointed(null)}
        onFocusOut={() => setPointed(null)}
      >
        {gallery.map((entry, i) => (
          <li key={entry.name}>
            <button
              type="button"
              data-name={entry.name}
              tabIndex={i === stop ? 0 : -1}
              onFocus={() => {
                setStop(i);
                setPointed(entry.name);
              }}
              onPointerEnter={() => setPointed(entry.name)}
              aria-pressed={entry.name === chosen}
              aria-description={entry.line}
              onClick={() => void openEntry(app, entry)}
            >
              <Thumbnail app={app} name={entry.name} />
              <span>{entry.title}</span>
            </button>
          </li>
        ))}
      </ul>
      <GalleryLine name={pointed ?? chosen} />
    </>
  );
}

/** Nothing before the first picture of the page stands; what isn't seen once all else is loaded. */
function Thumbnail({ app, name }: { app: App; name: string }) {
  const wanted = app.state.thumbnails.value;
  const src = wanted === 'none' ? undefined : `thumbnails/${name}.webp`;
  return <img src={src} loading={wanted === 'all' ? 'eager' : 'lazy'} decoding="async" width={128} height={96} alt="" />;
}

function GalleryLine({ name }: { name: string | null }) {
  const entry = gallery.find((other) => other.name === name);
  return (
    <p class="hint gallery-line" id="gallery-line" aria-hidden="true">
      {entry?.line ?? 'Choose a mesh, or open your own.'}
    </p>
  );
}

const names = gallery.map(({ name }) => name);

/** How many there are in a row. */
function columnsOf(buttons: readonly HTMLElement[]): number {
  const second = buttons.findIndex((button) => button.offsetTop > buttons[0].offsetTop);
  return second < 0 ? buttons.length : second;
}

function nextStop(key: string, stop: number, columns: number): number | null {
  if (key === 'Home') return 0;
  if (key === 'End') return names.length - 1;
  const step = { ArrowDown: columns, ArrowRight: 1, ArrowUp: -columns, ArrowLeft: -1 }[key];
  return step === undefined ? null : Math.min(Math.max(stop + step, 0), names.length - 1);
}

function reveal(list: HTMLElement | null): void {
  list?.querySelector('[aria-pressed="true"]')?.scrollIntoView({ block: 'nearest' });
}

/** Calls whenever an element gets a height after it had none. Returns what ends this. */
function onAppearance(element: HTMLElement, call: () => void): () => void {
  let isHidden = true;
  const observer = new ResizeObserver(() => {
    if (isHidden && element.clientHeight > 0) call();
    isHidden = element.clientHeight === 0;
  });
  observer.observe(element);
  return () => observer.disconnect();
}
