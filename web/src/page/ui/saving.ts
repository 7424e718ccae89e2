import { useState } from 'preact/hooks';

/** Whether a file is being saved, and what begins that. */
export function useSaving(save: () => Promise<void>): [boolean, () => Promise<void>] {
  const [isSaving, setSaving] = useState(false);
  const begin = async () => {
    setSaving(true);
    try {
      await save();
    } finally {
      setSaving(false);
    }
  };
  return [isSaving, begin];
}

/** Null if there is nothing to save. */
export function blobOf(bytes: Uint8Array | null, type: string): Blob | null {
  return bytes && new Blob([bytes as Uint8Array<ArrayBuffer>], { type });
}
