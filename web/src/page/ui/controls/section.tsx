import type { ComponentChildren } from 'preact';
import type { App } from '../../app';

interface Props {
  app: App;
  id: string;
  title: string;
  children: ComponentChildren;
}

/** A panel with a heading that opens and closes it. */
export function Section({ app, id, title, children }: Props) {
  const { sections } = app.state;
  const isOpen = sections.isOpen(id);
  return (
    <section id={id} aria-labelledby={`${id}-toggle`}>
      <h2>
        <button
          type="button"
          id={`${id}-toggle`}
          aria-controls={`${id}-body`}
          aria-expanded={isOpen}
          onClick={() => sections.set(id, !isOpen)}
        >
          {title}
        </button>
      </h2>
      <div class="body" id={`${id}-body`} hidden={!isOpen}>
        {children}
      </div>
    </section>
  );
}
