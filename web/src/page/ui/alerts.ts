import { button, el } from './dom';
import type { PageError } from '../../model/types';

/** Alerts that stay until dismissed, and notices that leave by themselves. */
export function alerts(container: HTMLElement): { alert(error: PageError): void; notice(text: string): void } {
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
    notice(text) {
      const item = el('div', { class: 'notice', role: 'status', 'data-test': 'notice' }, el('p', {}, text));
      add(item);
      setTimeout(() => item.remove(), 6000);
    },
  };
}
