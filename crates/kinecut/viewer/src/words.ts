// Numbers as the page writes them (src/report/units.rs of the crate).

export function duration(seconds: number): string {
  if (seconds < 9.95) return `${seconds.toFixed(1)} s`;
  const whole = Math.round(seconds);
  const two = (n: number) => String(n).padStart(2, "0");
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  if (h > 0) return `${h} h ${two(m)} min ${two(s)} s`;
  return m > 0 ? `${m} min ${two(s)} s` : `${s} s`;
}

export function millimetres(mm: number, decimals = 3): string {
  const text = mm.toFixed(decimals);
  return /^-0\.?0*$/.test(text) ? text.slice(1) : text;
}

export function micrometres(mm: number): string {
  const um = mm * 1000;
  return `${um > 0 ? "+" : ""}${um.toFixed(Math.abs(um) < 100 ? 1 : 0)} µm`;
}
