interface Props {
  id: string;
  label: string;
  checked: boolean;
  onChange: (checked: boolean) => void;
}

/** A box to tick. */
export function Check({ id, label, checked, onChange }: Props) {
  return (
    <label class="check">
      <input id={id} type="checkbox" checked={checked} onChange={({ currentTarget }) => onChange(currentTarget.checked)} />
      <span>{label}</span>
    </label>
  );
}
