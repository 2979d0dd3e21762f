// The page that the library makes of the same text: its drawings.

export interface Figure {
  title: string;
  about: string;
  /** For a wide and for a narrow place, as data of an image in a theme. */
  wide: (theme: string) => string;
  narrow: (theme: string) => string;
  width: [number, number];
  height: [number, number];
}

/** The drawings of a page; its charts are numbers of the answer. */
export function drawingsOf(html: string): Figure[] {
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
  return all.filter((f) => !f.classList.contains("chart")).flatMap((f) => figure(f) ?? []);
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
