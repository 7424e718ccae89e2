import { signal } from '@preact/signals';

/** Which sections of the panels are open. A narrow window has them at the bottom, one at a time and closed at first. */
export class Sections {
  private readonly narrow = matchMedia('(max-width: 760px)');
  private readonly open = signal<readonly string[]>([]);
  /** Those to open again when the window becomes wide. */
  private openWhenWide: readonly string[] = ['mesh', 'cut', 'view'];

  constructor() {
    if (!this.narrow.matches) this.open.value = this.openWhenWide;
    this.narrow.addEventListener('change', ({ matches }) => {
      if (matches) this.openWhenWide = this.open.value;
      this.open.value = matches ? [] : [...new Set([...this.open.value, ...this.openWhenWide])];
    });
  }

  isOpen(id: string): boolean {
    return this.open.value.includes(id);
  }

  set(id: string, open: boolean): void {
    const others = open && this.narrow.matches ? [] : this.open.value.filter((other) => other !== id);
    this.open.value = open ? [...others, id] : others;
  }
}
