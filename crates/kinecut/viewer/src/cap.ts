// The face of a section: where a closed body is cut open one sees the back of its surface first. That is drawn flat and hatched, as drawings
// have it.
import type { Material } from "three";

/** Distance of the hatch lines, and their width [px]. */
const APART = 8;
const LINE = 1.2;
/** Light of a hatch line beside that of the face. */
const DARK = 0.72;

/** Lets a material of back faces be that of section faces. */
export function hatched(material: Material): void {
  const before = material.onBeforeCompile.bind(material);
  // Programs are kept by this key, which otherwise is the text of the function below alone.
  const key = `hatched ${material.customProgramCacheKey()}`;
  material.customProgramCacheKey = () => key;
  const ratio = Math.min(devicePixelRatio, 2).toFixed(2);
  material.onBeforeCompile = (shader, renderer) => {
    before(shader, renderer);
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <dithering_fragment>",
      `#include <dithering_fragment>
      if (mod((gl_FragCoord.x + gl_FragCoord.y) / ${ratio}, ${APART.toFixed(1)}) < ${LINE.toFixed(1)}) gl_FragColor.rgb *= ${DARK.toFixed(2)};`,
    );
  };
}
