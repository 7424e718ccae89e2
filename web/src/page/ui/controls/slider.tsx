interface Props {
  id: string;
  label: string;
  /** Only screen readers get the label. */
  hideLabel?: boolean;
  min: number;
  max: number;
  step: number | 'any';
  value: number;
  format?: (value: number) => string;
  onInput: (value: number) => void;
}

/** A slider with its label and, if there is a format, its value in words. */
export function Slider({ id, label, hideLabel = false, format, value, onInput, ...range }: Props) {
  const words = format?.(value);
  return (
    <div class="slider">
      <label for={id} class={hideLabel ? 'visually-hidden' : undefined}>
        {label}
      </label>
      {words !== undefined && <output for={id}>{words}</output>}
      <input
        id={id}
        type="range"
        {...range}
        value={value}
        aria-valuetext={words}
        onInput={({ currentTarget }) => onInput(currentTarget.valueAsNumber)}
      />
    </div>
  );
}
