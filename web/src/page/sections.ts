import { signal } from '@preact/signals';

/** Which sections of the panels are open, and whether the panels are: at first only where they leave room for the picture. */
export class Sections {
  private readonly open = signal<readonly string[]>(['mesh']);
  private readonly wide = matchMedia('(min-width: 960px)');
  /** Narrower windows have the panels in a sheet that lies over the picture. */
  private readonly narrow = matchMedia('(max-width: 760px)');
  readonly arePanelsOpen = signal(this.wide.matches);

  constructor() {
    this.wide.addEventListener('change', ({ matches }) => (this.arePanelsOpen.value = matches));
  }

  isOpen(id: string): boolean {
    return this.open.value.includes(id);
  }

  set(id: string, open: boolean): void {
    const others = this.open.value.filter((other) => other !== id);
    this.open.value = open ? [...others, id] : others;
  }

  /** Gives the picture back its room, if the panels lie over it. */
  uncover(): void {
    if (this.narrow.matches) this.arePanelsOpen.value = false;
  }
}
