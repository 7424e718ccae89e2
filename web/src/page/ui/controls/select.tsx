interface Props<T extends string> {
  id: string;
  label: string;
  /** Values and their words. */
  options: readonly (readonly [T, string])[];
  value: T;
  onChange: (value: T) => void;
}

/** A list to choose one from. */
export function Select<T extends string>({ id, label, options, value, onChange }: Props<T>) {
  return (
    <label class="field">
      <span>{label}</span>
      <select id={id} value={value} onChange={({ currentTarget }) => onChange(currentTarget.value as T)}>
        {options.map(([option, words]) => (
          <option key={option} value={option}>
            {words}
          </option>
        ))}
      </select>
    </label>
  );
}
