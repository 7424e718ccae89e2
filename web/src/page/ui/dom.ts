// Small helpers that make labelled elements. Styles are only set through CSSOM: the page's content security policy forbids style
// attributes.
type Value = string | number | boolean | ((event: Event) => void);
type Child = Node | string | null;

/** A function becomes a listener, true an empty attribute, false none. */
export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Record<string, Value> = {}, ...children: Child[]) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name, value);
    else if (value !== false) element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

export function button(label: string, onClick: () => void, attributes: Record<string, Value> = {}): HTMLButtonElement {
  return el('button', { type: 'button', click: onClick, ...attributes }, label);
}

export interface NumberInput {
  element: HTMLElement;
  input: HTMLInputElement;
  /** Has no effect while the person is typing. */
  set(value: number): void;
}

interface NumberOptions {
  id: string;
  label: string;
  /** Only screen readers get the label. */
  hideLabel?: boolean;
  min?: number;
  max?: number;
  step?: number | 'any';
  /** On every change to a valid number. */
  onChange: (value: number) => void;
}

/** A number field that complains about anything but a number in range; `element` includes its label. */
export function numberField({ id, label, hideLabel = false, min, max, step = 1, onChange }: NumberOptions): NumberInput {
  const input = el('input', { id, type: 'number', step, inputmode: 'decimal', change: changed });
  if (min !== undefined) input.min = String(min);
  if (max !== undefined) input.max = String(max);
  input.required = true;
  function changed(): void {
    if (input.reportValidity()) onChange(input.valueAsNumber);
  }
  const element = el('label', { class: 'field' }, el('span', labelClass(hideLabel), label), input);
  return { element, input, set: (value) => setUnlessTyping(input, value) };
}

function labelClass(isHidden: boolean): Record<string, string> {
  return isHidden ? { class: 'visually-hidden' } : {};
}

function setUnlessTyping(input: HTMLInputElement, value: number): void {
  if (document.activeElement !== input) input.value = String(value);
}

export interface Slider {
  element: HTMLElement;
  input: HTMLInputElement;
  set(value: number): void;
}

interface SliderOptions {
  id: string;
  label: string;
  /** Only screen readers get the label. */
  hideLabel?: boolean;
  min: number;
  max: number;
  step: number | 'any';
  format?: (value: number) => string;
  onInput: (value: number) => void;
}

/** A slider with its label and, if there is a format, its value in words. */
export function slider({ id, label, hideLabel = false, min, max, step, format, onInput }: SliderOptions): Slider {
  const input = el('input', { id, type: 'range', min, max, step });
  const output = el('output', { for: id });
  const show = () => {
    if (!format) return;
    output.textContent = format(input.valueAsNumber);
    input.setAttribute('aria-valuetext', output.textContent);
  };
  input.addEventListener('input', () => {
    show();
    onInput(input.valueAsNumber);
  });
  show();
  const element = el('div', { class: 'slider' }, el('label', { for: id, ...labelClass(hideLabel) }, label), format ? output : null, input);
  const set = (value: number) => {
    input.value = String(value);
    show();
  };
  return { element, input, set };
}

export function checkbox(id: string, label: string, onChange: (checked: boolean) => void) {
  const input = el('input', { id, type: 'checkbox', change: () => onChange(input.checked) });
  return { element: el('label', { class: 'check' }, input, el('span', {}, label)), input };
}

/** Mutually exclusive choices, shown side by side. */
export function choice<T extends string>(name: string, legend: string, options: readonly [T, string][], onChange: (value: T) => void) {
  const inputs = options.map(([value, label]) => {
    const input = el('input', { type: 'radio', name, value, id: `${name}-${value}`, change: () => onChange(value) });
    return { value, input, element: el('label', {}, input, el('span', {}, label)) };
  });
  const element = el('fieldset', { class: 'choice' }, el('legend', {}, legend), el('div', {}, ...inputs.map((item) => item.element)));
  const set = (value: T) => inputs.forEach((item) => (item.input.checked = item.value === value));
  return { element, set };
}

export function select(id: string, label: string, onChange: (value: string) => void): { element: HTMLElement; input: HTMLSelectElement } {
  const input = el('select', { id, change: () => onChange(input.value) });
  return { element: el('label', { class: 'field' }, el('span', {}, label), input), input };
}

/** Terms and their values. */
export function terms(list: [string, Child][], attributes: Record<string, Value> = {}): HTMLElement {
  return el('dl', attributes, ...list.map(([term, value]) => el('div', {}, el('dt', {}, term), el('dd', {}, value))));
}
