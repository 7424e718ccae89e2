import { el } from './dom';

const systemDark = matchMedia('(prefers-color-scheme: dark)');

/** Switches between light and dark mode; follows the system until it is used. */
export function schemeToggle(onScheme: (dark: boolean) => void): HTMLButtonElement {
  const root = document.documentElement;
  const isDark = () => (root.dataset.scheme ? root.dataset.scheme === 'dark' : systemDark.matches);
  const toggle = el('button', { type: 'button', id: 'scheme', class: 'quiet', click: () => set(!isDark()) });
  function set(dark: boolean): void {
    root.dataset.scheme = dark ? 'dark' : 'light';
    show();
  }
  function show(): void {
    toggle.textContent = isDark() ? 'Light' : 'Dark';
    toggle.setAttribute('aria-label', `Switch to ${isDark() ? 'light' : 'dark'} mode`);
    onScheme(isDark());
  }
  systemDark.addEventListener('change', show);
  show();
  return toggle;
}
