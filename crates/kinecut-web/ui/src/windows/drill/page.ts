// The page that the library makes of the same text: its drawings, and the curve of the load, which the numbers have not.

export interface Figure {
  title: string;
  about: string;
  /** For a wide and for a narrow place, as data of an image in a theme. */
  wide: (theme: string) => string;
  narrow: (theme: string) => string;
  width: [number, number];
  height: [number, number];
}

export interface Curve {
  /** Way from the start [mm] and share of the point in material. */
  share: [number, number][];
}

export interface Read {
  drawings: Figure[];
  curve: Curve | null;
}

/** Reads a page. */
export function read(html: string): Read {
  // The style goes into the drawings alone: read as part of a page it would be one of this page, which refuses it.
  const style = /<style>([\s\S]*?)<\/style>/.exec(html)?.[1] ?? "";
  const page = new DOMParser().parseFromString(html.replace(/<style>[\s\S]*?<\/style>/g, ""), "text/html");
  const figure = (element: Element): Figure | null => {
    const [wide, narrow] = ["wide", "narrow"].map((name) => element.querySelector(`svg.${name}`));
    const title = element.querySelector("figcaption b")?.textContent ?? element.querySelector("figcaption")?.textContent ?? "";
    if (!wide || !narrow) return null;
    const both = [wide, narrow] as const;
    return {
      title,
      about: wide.getAttribute("aria-label") ?? title,
      wide: (theme) => image(wide, style, theme),
      narrow: (theme) => image(narrow, style, theme),
      width: both.map((svg) => Number(svg.getAttribute("width"))) as [number, number],
      height: both.map((svg) => Number(svg.getAttribute("viewBox")?.split(" ")[3])) as [number, number],
    };
  };
  const all = [...page.querySelectorAll("figure")];
  const drawings = all.filter((f) => !f.classList.contains("chart")).flatMap((f) => figure(f) ?? []);
  const chart = all.find((f) => f.classList.contains("chart"));
  return { drawings, curve: chart ? curveOf(chart) : null };
}

/** A drawing with the style of its page, as data of an image. */
function image(svg: Element, style: string, theme: string): string {
  const copy = svg.cloneNode(true) as Element;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("data-theme", theme);
  copy.removeAttribute("class");
  const text = copy.outerHTML.replace(/^(<svg[^>]*>)/, (head) => `${head}<style>${style.replaceAll("&", "&amp;").replaceAll("<", "&lt;")}</style>`);
  return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
}

/** The curve of the share, read from its drawing: its numbers are not printed. Null where the drawing is not as expected. */
function curveOf(chart: Element): Curve | null {
  const places = (path: Element | undefined): [number, number][] =>
    (path?.getAttribute("d") ?? "")
      .split(/[ML]/)
      .filter((part) => part.trim() !== "")
      .map((part) => part.trim().split(/[ ,]+/).map(Number) as [number, number]);
  const curves = [...chart.querySelectorAll("svg.wide path.curve")];
  const share = places(curves.find((c) => c.getAttribute("data-name")?.startsWith("in material")));
  const feed = places(curves.find((c) => c.getAttribute("data-name")?.startsWith("feed")));
  if (share.length < 2 || feed.length < 2) return null;
  // The way begins at 0 and ends with the curve; nothing is in material at the start, and the greatest feed is 1.
  const [left, right] = [share[0][0], share[share.length - 1][0]];
  const [zero, one] = [share[0][1], Math.min(...feed.map(([, y]) => y))];
  if (!(right > left) || !(zero > one) || share.some(([, y]) => !Number.isFinite(y) || y < one - 1 || y > zero + 1)) return null;
  return { share: share.map(([x, y]) => [(x - left) / (right - left), Math.min(1, Math.max(0, (zero - y) / (zero - one)))]) };
}
