import { useEffect, useLayoutEffect, useState } from 'preact/hooks';
import type { App } from '../app';
import { Icon } from './controls/icon';

const systemDark = matchMedia('(prefers-color-scheme: dark)');

/** Switches between light and dark mode; follows the system until it is used. */
export function SchemeToggle({ app: { view } }: { app: App }) {
  const [chosen, choose] = useState<boolean | null>(null);
  const [system, setSystem] = useState(systemDark.matches);
  useEffect(() => systemDark.addEventListener('change', ({ matches }) => setSystem(matches)), []);
  const isDark = chosen ?? system;
  useLayoutEffect(() => view.setScheme(isDark), [isDark, view]);
  const change = () => {
    choose(!isDark);
    document.documentElement.dataset.scheme = isDark ? 'light' : 'dark';
  };
  return (
    <button type="button" id="scheme" class="quiet" aria-label={`Switch to ${isDark ? 'light' : 'dark'} mode`} onClick={change}>
      <Icon name={isDark ? 'light' : 'dark'} />
    </button>
  );
}
