// The width of words in a drawing, so that it makes room for the words of each language.

/** Size of words in drawings [px]. */
const SIZE = 11;

let context: CanvasRenderingContext2D | null = null;

/** The width of a text in a drawing [px]. */
export function widthOf(text: string, bold = false): number {
  context ??= document.createElement("canvas").getContext("2d");
  if (!context) return text.length * 6.6;
  context.font = `${bold ? 600 : 400} ${SIZE}px ${getComputedStyle(document.body).fontFamily}`;
  return context.measureText(text).width;
}
