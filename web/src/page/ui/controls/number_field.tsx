import { useLayoutEffect, useRef } from 'preact/hooks';

interface Props {
  id: string;
  label: string;
  /** Only screen readers get the label. */
  hideLabel?: boolean;
  min?: number;
  max?: number;
  step?: number | 'any';
  /** Whether it may be left empty. */
  optional?: boolean;
  disabled?: boolean;
  /** Null shows an empty field. What a person is typing stays. */
  value: number | null;
  /** On every change to a valid number. */
  onChange: (value: number) => void;
}

/** A number field that complains about anything but a number in range. */
export function NumberField({ id, label, hideLabel = false, step = 1, optional = false, value, onChange, ...limits }: Props) {
  const ref = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => {
    const input = ref.current;
    if (input && document.activeElement !== input) input.value = value === null ? '' : String(value);
  });
  const change = (input: HTMLInputElement) => {
    if (input.reportValidity() && input.value !== '') onChange(input.valueAsNumber);
  };
  return (
    <label class="field">
      <span class={hideLabel ? 'visually-hidden' : undefined}>{label}</span>
      <input
        ref={ref}
        id={id}
        type="number"
        inputMode="decimal"
        {...limits}
        step={step}
        required={!optional}
        onChange={({ currentTarget }) => change(currentTarget)}
      />
    </label>
  );
}
