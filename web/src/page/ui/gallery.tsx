import { useEffect, useRef } from 'preact/hooks';
import type { App } from '../app';
import { gallery } from '../../model/gallery/list';

/** The meshes that come with the page. The one that is shown is scrolled to. */
export function Gallery({ app }: { app: App }) {
  const { source } = app.settings;
  const chosen = source.kind === 'gallery' ? source.name : null;
  const list = useRef<HTMLUListElement>(null);
  useEffect(() => reveal(list.current), [chosen]);
  useEffect(() => {
    if (list.current) return onAppearance(list.current, () => reveal(list.current));
  }, []);
  return (
    <ul ref={list} class="gallery" id="gallery" aria-label="Gallery">
      {gallery.map(({ name, title, line, cells }) => (
        <li key={name}>
          <button
            type="button"
            data-name={name}
            aria-pressed={name === chosen}
            onClick={() => void app.open({ kind: 'gallery', name }, { cells })}
          >
            <strong>{title}</strong>
            <small>{line}</small>
          </button>
        </li>
      ))}
    </ul>
  );
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
