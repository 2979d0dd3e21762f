// The face of a section: where a closed body is cut open one sees the back of its surface first. There the plane of the section is drawn,
// flat and hatched, as drawings have it; it hides what lies behind.
import { AlwaysStencilFunc, DoubleSide, EqualStencilFunc, type Material, Mesh, MeshBasicMaterial, type Plane, PlaneGeometry, ReplaceStencilOp, type Vector3 } from "three";
import { colour } from "./theme";

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

/** Left at a pixel by the back of the surface, and taken away by its front: what is nearest to the eye is the last to pass. */
const CUT = 1;

/** Lets the two sides of a body tell where it is cut open. */
export function marked(front: Material, back: Material, on: boolean): void {
  for (const material of [front, back]) {
    Object.assign(material, { stencilWrite: on, stencilFunc: AlwaysStencilFunc, stencilRef: material === back ? CUT : 0, stencilZPass: ReplaceStencilOp });
  }
}

export class Cap {
  private readonly material = new MeshBasicMaterial({
    side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, stencilWrite: true, stencilFunc: EqualStencilFunc, stencilRef: CUT,
  });
  readonly mesh = new Mesh(new PlaneGeometry(1, 1), this.material);

  constructor() {
    hatched(this.material);
    this.mesh.visible = false;
    // Behind the bodies that are cut, before what may lie behind their faces.
    this.mesh.renderOrder = -1;
  }

  recolour(): void {
    this.material.color = colour("cut");
  }

  /** Brings it into a plane about a place, so wide [mm]. */
  at(plane: Plane, middle: Vector3, size: number): void {
    plane.projectPoint(middle, this.mesh.position);
    this.mesh.lookAt(this.mesh.position.clone().add(plane.normal));
    this.mesh.scale.set(size, size, 1);
  }
}
