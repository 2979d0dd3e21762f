// Drawings of the library as images: one of many on a sheet, in the theme of the page.

/** A style with what it says about the dark: taken in, or taken out. */
function styled(style: string, dark: boolean): string {
  const mark = "@media screen and (prefers-color-scheme:dark){";
  const from = style.indexOf(mark);
  if (from < 0) return style;
  let depth = 1;
  let to = from + mark.length;
  while (to < style.length && depth > 0) {
    if (style[to] === "{") depth++;
    if (style[to] === "}") depth--;
    to++;
  }
  const inner = style.slice(from + mark.length, to - 1);
  return style.slice(0, from) + (dark ? inner : "") + style.slice(to);
}

const data = (text: string): string => `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;

/** Size of a drawing on the sheet [px]. */
export const CELL: [number, number] = [300, 260];

/** The drawings of a sheet, each as the text of an SVG file. */
export function drawings(sheet: string): string[] {
  const style = /<style>([\s\S]*?)<\/style>/.exec(sheet)?.[1] ?? "";
  const root = new DOMParser().parseFromString(sheet.replace(/<style>[\s\S]*?<\/style>/g, ""), "image/svg+xml").documentElement;
  return [...root.querySelectorAll("g.picture > g[transform]")].map(
    (g) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${CELL[0]} ${CELL[1]}" width="${CELL[0]}" height="${CELL[1]}"><style>${style}</style><g class="picture">${g.innerHTML}</g></svg>`,
  );
}

/** A drawing as an image of a theme. */
export function image(svg: string, theme: string): string {
  return data(svg.replace(/<style>([\s\S]*?)<\/style>/, (_, style: string) => `<style>${styled(style, theme === "dark")}</style>`));
}
