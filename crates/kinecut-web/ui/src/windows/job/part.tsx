// The part in three dimensions, with what is switched on, its legend and its read-out.
import { effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { View } from "viewer/scene";
import { offer } from "../../app/commands";
import { places } from "../../app/go";
import { Menu } from "../../app/menu";
import { Name } from "../../app/verbatim";
import { fixed, short, timeOfDay } from "../../base/format";
import type { Document } from "../../store/document";
import { active, cursor, place } from "../../store/session";
import type { Shown } from "../../store/shown";
import { t } from "../../words";
import { linesOf, wordBefore } from "./lines";
import { Marks, drawn, hidden, marksOf } from "./measure/marks";
import { Measured } from "./measure/measured";
import { inView, measuring, pick, toggleMeasure } from "./measure/picks";
import { playing } from "./player";

const DIRECTIONS = ["iso", "top", "front", "right"] as const;
const ROLES = ["rapid", "link", "lead", "feed", "rough", "finish"] as const;
type Switch = "part" | "path" | "tool" | "holder" | "fixtures" | "machine" | "rapids" | "past";
type Colour = "now" | "deviation" | "arc" | "chip";

/** Turned by a key of an arrow [rad], shifted [px]. */
const TURN = Math.PI / 24;
const SHIFT = 40;

const direction = signal<string>("iso");
const shows = signal<Record<Switch, boolean>>({ part: true, path: true, tool: true, holder: true, fixtures: true, machine: false, rapids: true, past: false });
const colour = signal<Colour>("now");
const section = signal<{ axis: "X" | "Y" | "Z"; share: number } | null>(null);
const sectionAt = signal<number | null>(null);
const under = signal("");
/** End of the scale when the path is coloured by a number. */
const most = signal(0);
const menu = signal(false);

const holder: { view: View | null } = { view: null };

function look(name: string): void {
  direction.value = name;
  holder.view?.look(name);
}

function toggle(name: Switch): void {
  shows.value = { ...shows.value, [name]: !shows.value[name] };
}

function turnSection(): void {
  const now = section.value;
  section.value = { axis: now === null ? "Y" : now.axis === "X" ? "Y" : now.axis === "Y" ? "Z" : "X", share: 0.5 };
}

offer(
  { id: "command.fit", keys: ["F"], run: () => look(direction.value) },
  { id: "command.iso", keys: ["1"], run: () => look("iso") },
  { id: "command.top", keys: ["2"], run: () => look("top") },
  { id: "command.front", keys: ["3"], run: () => look("front") },
  { id: "command.right", keys: ["4"], run: () => look("right") },
  { id: "command.section", keys: ["X"], run: () => (section.value = section.value ? null : { axis: "Y", share: 0.5 }) },
  { id: "command.sectionTurn", keys: ["Shift+X"], run: turnSection },
  { id: "command.measure", keys: ["M"], run: toggleMeasure },
  { id: "command.path", keys: ["P"], run: () => toggle("path") },
  { id: "command.tool", keys: ["T"], run: () => toggle("tool") },
  { id: "command.holder", keys: ["H"], run: () => toggle("holder") },
);

function started(canvas: HTMLCanvasElement): View | null {
  // Asked first, because the renderer would write to the console when there is none.
  if (document.createElement("canvas").getContext("webgl2") === null) return null;
  const view = new View(canvas, cursor, {
    readout: (text) => (under.value = text),
    notCompared: t("part.notCompared"),
    tolerances: t("part.tolerances"),
    nowOn: () => (colour.value = colour.value === "deviation" ? "now" : colour.value),
    drawn,
    hidden: (flags) => active.value && hidden(active.value, flags),
    clicked: (hit) => {
      const data = view.surfaceData;
      if (!measuring.value) return false;
      if (hit && data) pick(data, hit);
      return true;
    },
  });
  places.showPoint = (point) => view.showPoint(point);
  return view;
}

/** A finger scrolls the page until it has tapped the picture. */
function startTouch(canvas: HTMLCanvasElement): void {
  if (!matchMedia("(pointer: coarse)").matches) return;
  canvas.style.touchAction = "pan-y";
  canvas.addEventListener("click", () => (canvas.style.touchAction = "none"));
  document.addEventListener("pointerdown", (e) => {
    if (e.target !== canvas) canvas.style.touchAction = "pan-y";
  });
}

function keys(e: KeyboardEvent): void {
  const view = holder.view;
  if (!view || e.ctrlKey || e.metaKey || e.altKey) return;
  const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const way = arrows[e.key];
  if (way && e.shiftKey) view.pan(SHIFT * way[0], SHIFT * way[1]);
  else if (way) view.turn(TURN * way[0], TURN * way[1]);
  else if (e.key === "+" || e.key === "=") view.zoom(1.2);
  else if (e.key === "-") view.zoom(1 / 1.2);
  else if (e.key === "0") look(direction.value);
  else if (e.key === "Enter" && measuring.value) view.pressMiddle();
  else return;
  e.preventDefault();
}

/** Keeps the view as the texts, the switches and the section say. */
function follow(view: View, doc: Document): () => void {
  let before: Shown | null = null;
  const ends = [
    effect(() => {
      const shown = doc.shown.value;
      if (!shown) return;
      shown.open();
      // The part that was cut stays until the next one is: a plan has the raw stock alone.
      const keepPart = !shown.cut && before !== null;
      // Of a plan the simulation is on its way.
      view.load(shown.head, shown.track, { fit: before === null, keepPart, soon: !shown.cut });
      const simulated = doc.simulated.peek();
      if (!keepPart) inView.value = { text: shown.text, step: shown.cut && simulated ? (simulated.drawn_step ?? simulated.step) : null };
      before = shown;
      // A place of the program before may be another one now.
      const { line } = cursor.place;
      if (line >= 0) cursor.go(line < shown.track.lines ? (cursor.place.piece < shown.track.pieces && shown.track.line[cursor.place.piece] === line ? cursor.place : shown.track.ofLine(line)) : { line: -1, piece: -1, part: 0 }, "load");
    }),
    effect(() => {
      void doc.shown.value;
      for (const [name, on] of Object.entries(shows.value)) view.show(name, on, true);
    }),
    effect(() => {
      void doc.shown.value;
      const by = colour.value;
      // The finished part is measured, not the stock on the way to it.
      view.show("now", by !== "deviation" && !measuring.value, true);
      most.value = view.colourPath(by === "arc" || by === "chip" ? by : "");
    }),
    effect(() => view.mark(marksOf(doc).map((m) => m.point))),
    effect(() => {
      if (!doc.shown.value) return;
      const cut = section.value;
      sectionAt.value = view.section(cut?.axis ?? "", cut?.share ?? 0);
    }),
  ];
  return () => ends.forEach((end) => end());
}

export function PartPanel({ doc }: { doc: Document }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const noView = useRef(false);
  useEffect(() => {
    holder.view ??= started(canvas.current as HTMLCanvasElement);
    noView.current = holder.view === null;
    startTouch(canvas.current as HTMLCanvasElement);
    return () => (holder.view = null);
  }, []);
  useEffect(() => (holder.view ? follow(holder.view, doc) : undefined), [doc]);
  const shown = doc.shown.value;
  const old = shown !== null && shown.text !== doc.text.value;
  return (
    <section class={`panel view${noView.current ? " flat" : ""}`} aria-label={t("panel.part")} tabIndex={-1} data-panel="part">
      <Tools doc={doc} />
      <div class={`stage${doc.wrong.value || old ? " dim" : ""}`}>
        <canvas ref={canvas} tabIndex={0} role="img" aria-label={t("part.canvas")} onKeyDown={keys} />
        {noView.current && <p class="hint">{t("part.noWebgl")}</p>}
        {!shown && !noView.current && <p class="hint q">{t("part.waiting")}</p>}
        <Marks doc={doc} />
        {measuring.value && <span class="middle" aria-hidden="true" />}
        <ReadOut doc={doc} />
        <Stale doc={doc} />
      </div>
      <Measured doc={doc} />
      <Legend doc={doc} />
    </section>
  );
}

function Stale({ doc }: { doc: Document }) {
  const shown = doc.shown.value;
  if (!shown || (shown.text === doc.text.value && !doc.wrong.value)) return null;
  return <p class="old">{t("part.stale", { time: timeOfDay(shown.at) })}</p>;
}

function Tools({ doc }: { doc: Document }) {
  const head = doc.shown.value?.head;
  const box = (name: Switch) => (
    <label class="box" key={name}>
      <input type="checkbox" checked={shows.value[name]} onChange={() => toggle(name)} data-show={name} />
      {t(`part.show.${name}`)}
    </label>
  );
  const more: Switch[] = ["rapids", "past"];
  if ((head?.fixtures.length ?? 0) > 0) more.push("fixtures");
  if (head?.machine) more.push("machine");
  const cut = section.value;
  return (
    <header class="tools">
      <h2 class="sr">{t("panel.part")}</h2>
      <span class="seg" role="radiogroup" aria-label={t("part.directions")}>
        {DIRECTIONS.map((name) => (
          <button key={name} role="radio" aria-checked={direction.value === name} onClick={() => look(name)} data-view={name}>
            {t(`part.${name}`)}
          </button>
        ))}
      </span>
      <span class="boxes wide">{(["part", "path", "tool", "holder"] as const).map(box)}</span>
      <span class="holdsMenu wide">
        <button aria-haspopup="true" aria-expanded={menu.value} onClick={() => (menu.value = !menu.value)}>
          {t("part.more")}
        </button>
        <Menu open={menu} label={t("part.more")}>
          {more.map((name) => (
            <button key={name} role="menuitemcheckbox" aria-checked={shows.value[name]} onClick={() => toggle(name)} data-show={name}>
              <span aria-hidden="true">{shows.value[name] ? "☑" : "☐"}</span>
              <span>{t(`part.show.${name}`)}</span>
            </button>
          ))}
        </Menu>
      </span>
      <select aria-label={t("part.colour")} value={colour.value} onChange={(e) => (colour.value = e.currentTarget.value as Colour)}>
        {(["now", "deviation", "arc", "chip"] as const).map((name) => (
          <option key={name} value={name}>
            {t(`part.colour.${name}`)}
          </option>
        ))}
      </select>
      <button class="wide" aria-pressed={cut !== null} onClick={() => (section.value = cut ? null : { axis: "Y", share: 0.5 })}>
        {t("part.section")}
      </button>
      <button aria-pressed={measuring.value} onClick={toggleMeasure} data-measure={measuring.value ? "on" : "off"}>
        {t("part.measure")}
      </button>
      {cut && (
        <span class="section">
          <select aria-label={t("part.sectionAxis")} translate={false} value={cut.axis} onChange={(e) => (section.value = { ...cut, axis: e.currentTarget.value as "X" })}>
            {["X", "Y", "Z"].map((axis) => (
              <option key={axis}>{axis}</option>
            ))}
          </select>
          <input type="range" min="0" max="1" step="0.002" value={cut.share} aria-label={t("part.sectionPlace")} onInput={(e) => (section.value = { ...cut, share: Number(e.currentTarget.value) })} />
          <output translate={false}>{sectionAt.value === null ? "" : `${fixed(sectionAt.value, 2)} mm`}</output>
        </span>
      )}
      {doc.running.value && <Bar share={doc.running.value.share} />}
    </header>
  );
}

function Bar({ share }: { share: number | null }) {
  return <span class="waits" style={{ width: share === null ? "12%" : `${Math.round(100 * share)}%` }} />;
}

/** Where the tool is, and what lies under the pointer. */
function ReadOut({ doc }: { doc: Document }) {
  const at = place.value;
  const track = doc.shown.value?.track;
  const tip = track && at.piece >= 0 && at.piece < track.pieces ? track.tip(at) : null;
  const lines = linesOf(doc.work.value);
  const feed = wordBefore(lines, at.line, "F");
  const speed = wordBefore(lines, at.line, "S");
  const tool = tip && track ? track.head.tools[track.tool[at.piece]] : undefined;
  const name = tool && doc.tools.value.find((one) => one.number === tool.number)?.name;
  const spoken = tip && !playing.value ? t("part.cursor", { line: at.line + 1, x: fixed(tip[0], 3), y: fixed(tip[1], 3), z: fixed(tip[2], 3) }) : "";
  return (
    <>
      {tip && (
        <div class="read" translate={false}>
          {["x", "y", "z"].map((axis, k) => (
            <div key={axis}>
              <b class={axis}>{axis.toUpperCase()}</b> {fixed(tip[k], 3)}
            </div>
          ))}
          <div class="q">
            {feed && `F${feed} `}
            {speed && `S${speed}`}
          </div>
          {tool && (
            <div class="q">
              T{tool.number} {name ?? ""}
            </div>
          )}
        </div>
      )}
      <Name class="under">{under.value}</Name>
      <p class="sr" role="status" aria-live="polite">
        {spoken}
      </p>
    </>
  );
}

function Legend({ doc }: { doc: Document }) {
  const shown = doc.shown.value;
  if (!shown) return null;
  const { head, track } = shown;
  const roles = ROLES.filter((role) => track.role.includes(head.roles.indexOf(role)));
  const by = colour.value;
  const part = head.part;
  return (
    <div class="key">
      {by === "arc" || by === "chip" ? (
        <div class="scale">
          {t(by === "arc" ? "part.colour.arc" : "part.colour.chip")}
          <i />
          <Name>{by === "arc" ? `0 \u2013 ${short(most.value)}°` : `0 \u2013 ${fixed(most.value, 3)} mm`}</Name>
        </div>
      ) : (
        roles.map((role) => (
          <div key={role}>
            <svg width="28" height="6" aria-hidden="true">
              <path class={`p-${role}`} d="M0 3h28" />
            </svg>
            {t(`part.role.${role}`)}
          </div>
        ))
      )}
      {place.value.piece >= 0 && (
        <div data-legend="to-come">
          <svg width="28" height="6" aria-hidden="true" opacity="0.38">
            <path class={`p-${roles.at(-1) ?? "feed"}`} d="M0 3h28" />
          </svg>
          {t("part.toCome")}
        </div>
      )}
      {part?.compared && <Bands edges={part.edges} tolerance={part.tolerance} relative={part.relative} />}
    </div>
  );
}

/** The bands of deviation with the limits between them. */
function Bands({ edges, tolerance, relative }: { edges: number[]; tolerance: number; relative: boolean }) {
  const limit = (e: number) => short(relative ? e : e * tolerance, 3);
  return (
    <div class="bands">
      <span>{t("part.deviation")}</span>
      <span class="q">{t("part.gouge")}</span>
      {edges.map((e, n) => (
        <span key={n} class="pair">
          <i class={`sw b${n}`} aria-hidden="true" />
          <Name>{limit(e)}</Name>
        </span>
      ))}
      <i class={`sw b${edges.length}`} aria-hidden="true" />
      <span class="q">{t("part.left", { unit: relative ? "T" : "mm" })}</span>
      <i class="sw none apart" aria-hidden="true" />
      <span>{t("part.notCompared")}</span>
    </div>
  );
}
