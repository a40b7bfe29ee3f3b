// What is dear to load, kept for a while.

/** Kept by last use until a sum of sizes is reached; the last one always stays. */
export class RecentlyUsed<Key, T> {
  private readonly items = new Map<Key, { value: T; size: number }>();
  private total = 0;
  constructor(private readonly limit: number) {}

  get(key: Key): T | undefined {
    const item = this.items.get(key);
    if (item === undefined) return undefined;
    this.items.delete(key);
    this.items.set(key, item);
    return item.value;
  }

  set(key: Key, value: T, size: number): void {
    this.delete(key);
    this.items.set(key, { value, size });
    this.total += size;
    for (const oldest of this.items.keys()) {
      if (this.total <= this.limit || oldest === key) break;
      this.delete(oldest);
    }
  }

  private delete(key: Key): void {
    this.total -= this.items.get(key)?.size ?? 0;
    this.items.delete(key);
  }
}

/** Runs `make` unless the same is under way. */
export function once<Key, T>(running: Map<Key, Promise<T>>, key: Key, make: () => Promise<T>): Promise<T> {
  let promise = running.get(key);
  if (promise === undefined) {
    promise = make().finally(() => running.delete(key));
    running.set(key, promise);
  }
  return promise;
}
