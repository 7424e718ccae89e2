/** Tells the listeners; a listener that comes late is told the last value at once. */
export class Events<Types> {
  private readonly listeners = new Map<keyof Types, ((value: never) => void)[]>();
  private readonly last = new Map<keyof Types, unknown>();

  on<K extends keyof Types>(name: K, listener: (value: Types[K]) => void): void {
    this.listeners.set(name, [...(this.listeners.get(name) ?? []), listener]);
    if (this.last.has(name)) listener(this.last.get(name) as Types[K]);
  }

  tell<K extends keyof Types>(name: K, value: Types[K]): void {
    this.last.set(name, value);
    for (const listener of this.listeners.get(name) ?? []) (listener as (value: Types[K]) => void)(value);
  }
}
