import type { App } from '../app';
import { Icon } from './controls/icon';

/** Opens the panels and folds them away. */
export function PanelsToggle({ app }: { app: App }) {
  const { arePanelsOpen } = app.state.sections;
  const change = () => (arePanelsOpen.value = !arePanelsOpen.value);
  return (
    <button type="button" id="panels-toggle" class="quiet" aria-controls="panels" aria-expanded={arePanelsOpen.value} onClick={change}>
      <Icon name="panels" />
      Panels
    </button>
  );
}
