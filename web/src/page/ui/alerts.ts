import { button, el } from './dom';
import type { PageError } from '../../model/types';

export interface Alerts {
  /** Stays until it is dismissed or cleared. */
  alert(error: PageError): void;
  clear(): void;
  /** Goes away by itself. */
  notice(text: string): void;
}

export function alerts(container: HTMLElement): Alerts {
  const add = (item: HTMLElement) => {
    container.prepend(item);
    while (container.children.length > 3) container.lastElementChild?.remove();
  };
  return {
    alert({ title, detail }) {
      const item = el('div', { class: 'alert', role: 'alert', 'data-test': 'alert' }, el('strong', {}, title), el('p', {}, detail));
      item.append(button('Dismiss', () => item.remove(), { class: 'quiet' }));
      add(item);
    },
    clear() {
      for (const item of container.querySelectorAll('.alert')) item.remove();
    },
    notice(text) {
      const item = el('div', { class: 'notice', role: 'status', 'data-test': 'notice' }, el('p', {}, text));
      add(item);
      setTimeout(() => item.remove(), 6000);
    },
  };
}
