// Work of the page that is not done yet: questions, and those that will follow once a text has rested. The page tells their number
// (data-open at its root), so that who drives it can wait until it is still. No signal: who asks within an effect must not follow it.

let open = 0;
document.documentElement.dataset.open = "0";

function tell(by: number): void {
  open += by;
  document.documentElement.dataset.open = String(open);
}

/** Counts work until it ends, however it ends. */
export async function counted<T>(work: Promise<T>): Promise<T> {
  tell(1);
  try {
    return await work;
  } finally {
    tell(-1);
  }
}


/** Begins work when a while has passed [ms]; it counts from now on. The answer gives it up as long as it has not begun. */
export function later(ms: number, work: () => Promise<unknown>): () => void {
  let waits = true;
  tell(1);
  const timer = setTimeout(() => {
    waits = false;
    void work().finally(() => tell(-1));
  }, ms);
  return () => {
    if (!waits) return;
    waits = false;
    clearTimeout(timer);
    tell(-1);
  };
}
