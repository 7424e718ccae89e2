import { useEffect, useRef, useState } from 'preact/hooks';
import type { App } from '../app';
import { gallery } from '../../model/gallery/list';

/** The meshes that come with the page: one stop of the Tab key, with the arrow keys from one to the next. The one that is shown is scrolled to. */
export function Gallery({ app }: { app: App }) {
  const { source } = app.settings;
  const chosen = source.kind === 'gallery' ? source.name : null;
  const list = useRef<HTMLUListElement>(null);
  /** Where the Tab key leads. */
  const [stop, setStop] = useState(0);
  useEffect(() => {
    reveal(list.current);
    setStop(Math.max(names.indexOf(chosen ?? ''), 0));
  }, [chosen]);
  useEffect(() => {
    if (list.current) return onAppearance(list.current, () => reveal(list.current));
  }, []);
  const move = (event: KeyboardEvent) => {
    const to = nextStop(event.key, stop);
    if (to === null) return;
    event.preventDefault();
    setStop(to);
    list.current?.querySelectorAll('button')[to].focus();
  };
  return (
    <ul ref={list} class="gallery" id="gallery" aria-label="Gallery" onKeyDown={move}>
      {gallery.map(({ name, title, line, cells }, i) => (
        <li key={name}>
          <button
            type="button"
            data-name={name}
            tabIndex={i === stop ? 0 : -1}
            onFocus={() => setStop(i)}
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

const names = gallery.map(({ name }) => name);

function nextStop(key: string, stop: number): number | null {
  if (key === 'Home') return 0;
  if (key === 'End') return names.length - 1;
  const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[key];
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
