import { button, el } from './dom';

/** Narrow windows have the panels at the bottom, one open at a time. */
export const narrow = matchMedia('(max-width: 760px)');

const toggles: HTMLButtonElement[] = [];
/** Panels to open again when the window becomes wide. */
let openWhenWide: HTMLButtonElement[] = [];

/** A panel with a heading that opens and closes it. */
export function section(id: string, title: string, open: boolean, ...children: Node[]): HTMLElement {
  const body = el('div', { class: 'body', id: `${id}-body` }, ...children);
  const toggle = button(title, () => setOpen(toggle, !isOpen(toggle)), { id: `${id}-toggle`, 'aria-controls': body.id });
  toggles.push(toggle);
  if (open) openWhenWide.push(toggle);
  setExpanded(toggle, body, open && !narrow.matches);
  return el('section', { id, 'aria-labelledby': toggle.id }, el('h2', {}, toggle), body);
}

export function openSection(id: string): void {
  const toggle = toggles.find((candidate) => candidate.id === `${id}-toggle`);
  if (toggle && !isOpen(toggle)) setOpen(toggle, true);
}

function setOpen(toggle: HTMLButtonElement, open: boolean): void {
  if (open && narrow.matches) for (const other of toggles) setExpanded(other, bodyOf(other), false);
  setExpanded(toggle, bodyOf(toggle), open);
}

function isOpen(toggle: HTMLButtonElement): boolean {
  return toggle.getAttribute('aria-expanded') === 'true';
}

function bodyOf(toggle: HTMLButtonElement): HTMLElement {
  return document.getElementById(toggle.getAttribute('aria-controls') ?? '') as HTMLElement;
}

function setExpanded(toggle: HTMLButtonElement, body: HTMLElement, open: boolean): void {
  toggle.setAttribute('aria-expanded', String(open));
  body.hidden = !open;
}

/** Panels close when the window becomes narrow and reopen when it becomes wide. */
narrow.addEventListener('change', () => {
  if (narrow.matches) openWhenWide = toggles.filter(isOpen);
  for (const toggle of toggles) setExpanded(toggle, bodyOf(toggle), !narrow.matches && (isOpen(toggle) || openWhenWide.includes(toggle)));
});
