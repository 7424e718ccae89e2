import { useLayoutEffect, useRef, useState } from 'preact/hooks';

interface Props {
  /** Ids are made of it. */
  name: string;
  /** What the button says. */
  label: string;
  text: () => string;
  /** What there is to say of what was copied. */
  note?: string;
  /** What the field is called in which the text stands where the clipboard is out of reach. */
  field: string;
}

/** Copies a text, or shows it to be copied, with all of its lines. */
export function CopyButton({ name, label, text, note = '', field }: Props) {
  const [status, setStatus] = useState('');
  const [shown, setShown] = useState<string | null>(null);
  const input = useRef<HTMLTextAreaElement>(null);
  useLayoutEffect(() => input.current?.select(), [shown]);
  const copy = async () => {
    const copied = text();
    try {
      await navigator.clipboard.writeText(copied);
      setShown(null);
      setStatus(`Copied. ${note}`);
    } catch {
      setShown(copied);
      setStatus(`Copy it from the field below. ${note}`);
    }
  };
  return (
    <div class="row">
      <button type="button" id={`copy-${name}`} onClick={() => void copy()}>
        {label}
      </button>
      <span class="hint" aria-live="polite" id={`${name}-status`}>
        {status}
      </span>
      {shown !== null && <textarea ref={input} class="copied" id={name} readOnly rows={2} value={shown} aria-label={field} />}
    </div>
  );
}
