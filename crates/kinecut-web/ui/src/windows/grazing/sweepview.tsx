// The move in three dimensions: the tool at the moment with its curve, and what it has swept up to there.
import { effect, useSignal } from "@preact/signals";
import { BufferAttribute, BufferGeometry, GreaterDepth, Group, Matrix4, Mesh } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { bodies, unpacked, use } from "viewer/decode";
import { cornerNormals } from "viewer/mesh";
import { colour } from "viewer/theme";
import { useEffect, useRef } from "preact/hooks";
import { offer } from "../../app/commands";
import { t } from "../../words";
import { Body, bodyColour, bodyMaterial, put } from "./body";
import type { Scrub } from "./scrub";
import type { Growth, Moment, Rows, Vec } from "./sheet";
import { Stage } from "./stage";
import { startTouch } from "./toolview";

const DIRECTIONS = ["iso", "top", "front", "right", "below"] as const;
/** A curve of an earlier moment is drawn at each of so many. */
const EVERY = 6;

function matrixOf(pose: Rows): Matrix4 {
  return new Matrix4().set(...pose[0], ...pose[1], ...pose[2], 0, 0, 0, 1);
}

function moved(pose: Rows, p: Vec): Vec {
  return pose.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]) as Vec;
}

function segments(paths: Vec[][], pose: Rows): number[] {
  const xyz: number[] = [];
  for (const path of paths) for (let i = 0; i + 1 < path.length; i++) xyz.push(...moved(pose, path[i]), ...moved(pose, path[i + 1]));
  return xyz;
}

/** Walls, both ends, and the tool of one move. */
class Swept {
  readonly group = new Group();
  readonly tool = new Body();
  private readonly walls = new Mesh(new BufferGeometry(), bodyMaterial());
  private readonly start = new Mesh(new BufferGeometry(), bodyMaterial());
  private readonly end = new Mesh(new BufferGeometry(), bodyMaterial());
  private readonly now: LineSegments2[];
  private readonly before: LineSegments2;
  private growth: Growth | null = null;

  constructor() {
    const line = (front: boolean, wide: number) => {
      const look = front ? { linewidth: wide } : { linewidth: wide, depthFunc: GreaterDepth, depthWrite: false, transparent: true, opacity: 0.3 } as const;
      const made = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial(look));
      made.frustumCulled = false;
      made.renderOrder = front ? 3 : 2;
      this.group.add(made);
      return made;
    };
    this.now = [line(true, 3.2), line(false, 1.6)];
    this.before = line(true, 1.2);
    this.group.add(this.walls, this.start, this.end, this.tool.group);
    this.recolour();
  }

  /** Shows another move; resolves when it is on the graphics card. */
  async load(growth: Growth): Promise<void> {
    const streams = await unpacked([["growth", growth.stream]]);
    const known = use(streams);
    const [{ positions, indices }] = bodies("growth", [{ name: "", vertices: growth.vertices, triangles: growth.triangles }]);
    use(known);
    const parts: [Mesh, number, number][] = [[this.walls, 0, growth.ends[0][0]], [this.start, ...growth.ends[0]], [this.end, ...growth.ends[1]]];
    for (const [mesh, from, to] of parts) {
      const own = indices.subarray(3 * from, 3 * to);
      const corners = new Float32Array(3 * own.length);
      own.forEach((v, i) => corners.set(positions.subarray(3 * v, 3 * v + 3), 3 * i));
      mesh.geometry.dispose();
      mesh.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3)).setAttribute("normal", new BufferAttribute(cornerNormals(positions, own, 3), 3));
      mesh.frustumCulled = false;
    }
    this.growth = growth;
  }

  /** The moment: what comes later is not shown. */
  at(index: number, growth: Growth): void {
    if (growth !== this.growth) return;
    const moment: Moment | undefined = growth.moments[index];
    if (!moment) return;
    this.walls.geometry.setDrawRange(0, 3 * moment.triangles);
    this.end.visible = false;
    this.tool.group.matrixAutoUpdate = false;
    this.tool.group.matrix.copy(matrixOf(moment.pose));
    this.tool.group.matrixWorldNeedsUpdate = true;
    const now = segments(moment.paths, moment.pose);
    for (const line of this.now) put(line, now);
    put(this.before, growth.moments.slice(0, index).filter((_, i) => i % EVERY === 0).flatMap((m) => segments(m.paths, m.pose)));
  }

  recolour(): void {
    (this.walls.material as ReturnType<typeof bodyMaterial>).color = bodyColour("teal");
    (this.start.material as ReturnType<typeof bodyMaterial>).color = bodyColour("steel");
    (this.end.material as ReturnType<typeof bodyMaterial>).color = bodyColour("orange");
    for (const line of this.now) line.material.color = colour("k3");
    this.before.material.color = colour("k6");
    this.tool.recolour();
  }
}

/** Corners of a box round all that is drawn. */
function boundsOf(growth: Growth): [Vec, Vec] {
  const radius = Math.max(...growth.pieces.flatMap((p) => [p.start[0], p.end[0], p.centre ? p.centre[0] + Math.abs(p.radius ?? 0) : 0]));
  const [low, high] = [Math.min(...growth.pieces.map((p) => p.start[1])), Math.max(...growth.pieces.map((p) => p.end[1]))];
  const [min, max]: [Vec, Vec] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const { pose } of growth.moments) {
    for (const z of [low, high]) {
      const middle = moved(pose, [0, 0, z]);
      for (let k = 0; k < 3; k++) {
        // The extent of a circle about the tool's axis.
        const out = radius * Math.sqrt(Math.max(0, 1 - pose[k][2] ** 2));
        min[k] = Math.min(min[k], middle[k] - out);
        max[k] = Math.max(max[k], middle[k] + out);
      }
    }
  }
  return [min, max];
}

export function SweepView({ scrub, dim }: { scrub: Scrub; dim: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const stage = useRef<Stage | null>(null);
  const none = useSignal(false);
  const direction = useSignal<string>("iso");
  const { looked } = scrub;
  useEffect(() => {
    if (document.createElement("canvas").getContext("webgl2") === null) {
      none.value = true;
      return;
    }
    const on = canvas.current as HTMLCanvasElement;
    const swept = new Swept();
    const made = (stage.current = new Stage(on, { drawn: () => undefined, recolour: () => swept.recolour() }));
    made.scene.add(swept.group);
    startTouch(on);
    let fitted = "";
    const ends = [
      effect(() => {
        const growth = looked.growth.value;
        if (!growth) return;
        const [min, max] = boundsOf(growth);
        made.holds(min, max);
        const size = JSON.stringify([min, max].flat().map((c) => Math.round(c / 5)));
        void swept.load(growth).then(() => {
          if (looked.growth.peek() !== growth) return;
          swept.at(scrub.at.peek(), growth);
          if (size !== fitted) made.look(direction.peek());
          fitted = size;
          made.draw();
          document.documentElement.dataset.growth = String(growth.triangles);
        });
      }),
      effect(() => {
        const growth = looked.growth.value;
        if (growth) swept.at(scrub.at.value, growth);
        made.draw();
      }),
      effect(() => {
        const sheet = looked.moment.value;
        swept.tool.group.visible = sheet !== null;
        if (sheet) swept.tool.show(sheet, false);
        made.draw();
      }),
    ];
    return () => {
      for (const end of ends) end();
      stage.current = null;
      made.end();
    };
  }, [scrub]);
  const look = (name: string) => {
    direction.value = name;
    stage.current?.look(name);
  };
  useEffect(() => {
    offer(
      { id: "command.fit", keys: ["F"], run: () => look(direction.value) },
      { id: "command.iso", keys: ["1"], run: () => look("iso") },
      { id: "command.top", keys: ["2"], run: () => look("top") },
      { id: "command.front", keys: ["3"], run: () => look("front") },
      { id: "command.right", keys: ["4"], run: () => look("right") },
    );
  });
  return (
    <section class="panel tool" aria-label={t("envelope.swept")} tabIndex={-1} data-panel="tool">
      <header>
        <h2>{t("envelope.swept")}</h2>
        <span class="seg" role="radiogroup" aria-label={t("part.directions")}>
          {DIRECTIONS.map((name) => (
            <button key={name} role="radio" aria-checked={direction.value === name} onClick={() => look(name)} data-view={name}>
              {t(name === "below" ? "envelope.below" : `part.${name}`)}
            </button>
          ))}
        </span>
      </header>
      <div class={`stage${dim ? " dim" : ""}`}>
        <canvas ref={canvas} data-triangles={looked.growth.value?.moments[scrub.at.value]?.triangles} tabIndex={0} role="img" aria-label={t("envelope.canvas")} onKeyDown={(e) => stage.current?.key(e) && e.preventDefault()} />
        {none.value && <p class="hint">{t("part.noWebgl")}</p>}
      </div>
      <div class="key">
        <span>
          <i class="face orange" />
          {t("grazing.enters")}
        </span>
        <span>
          <i class="face steel" />
          {t("envelope.leavesOrStart")}
        </span>
        <span>
          <i class="face teal" />
          {t("envelope.wall")}
        </span>
        <span>
          <svg width="22" height="6" aria-hidden="true">
            <path class="curve kind3" d="M0 3h22" />
          </svg>
          {t("envelope.curveNow")}
        </span>
        <span>
          <svg width="22" height="6" aria-hidden="true">
            <path class="curve kind6 thin" d="M0 3h22" />
          </svg>
          {t("envelope.curveBefore")}
        </span>
      </div>
    </section>
  );
}
