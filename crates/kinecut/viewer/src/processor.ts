// Whether the pictures are made without a graphics card.

/** True where a context draws on the processor: a machine without a graphics card, or one that the browser does not use. */
export function onProcessor(gl: WebGL2RenderingContext): boolean {
  const name = String(gl.getParameter(gl.RENDERER));
  // Some browsers tell the name only when it is asked for; the others write to the console then.
  const asked = name === "WebKit WebGL" ? gl.getExtension("WEBGL_debug_renderer_info") : null;
  const told = asked ? String(gl.getParameter(asked.UNMASKED_RENDERER_WEBGL)) : name;
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(told);
}
