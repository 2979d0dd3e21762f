// The interactive part of kinecut's report. The page is complete without it; this adds the 3-D view, the program list
// and the one cursor through both, the plans and the charts.
import { type Head, json, unpack } from "./decode";
import { startPictures } from "./pictures";
import { Player } from "./player";
import { ProgramList } from "./program";
import { View } from "./scene";
import { startStrip } from "./strip";
import { changed as themeChanged, startTheme } from "./theme";
import { Cursor, Track } from "./track";

const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T | null;

function viewOf(canvas: HTMLCanvasElement, head: Head, track: Track, cursor: Cursor): View {
  const readout = element("kc-readout");
  const view = new View(canvas, cursor, {
    readout: (text) => readout && (readout.textContent = text),
    notCompared: "not compared",
    tolerances: "tolerances",
    nowOn: () => {
      const box = document.querySelector<HTMLInputElement>('[data-show="now"]');
      if (box) box.checked = true;
    },
  });
  view.load(head, track);
  return view;
}

function startView(head: Head, track: Track, cursor: Cursor): View | null {
  const canvas = element<HTMLCanvasElement>("kc-canvas");
  if (!canvas) return null;
  const stage = canvas.parentElement as HTMLElement;
  // Asked first, because the renderer would write to the console when there is none.
  const possible = document.createElement("canvas").getContext("webgl2") !== null;
  try {
    if (possible) return viewOf(canvas, head, track, cursor);
  } catch (error) {
    stage.dataset.error = String(error);
  }
  stage.closest(".view")?.classList.add("flat");
  const reason = stage.querySelector(".reason");
  if (reason) reason.textContent = "The 3-D view needs WebGL 2, which this browser does not offer here. ";
  return null;
}

function startBar(view: View): void {
  for (const button of document.querySelectorAll<HTMLButtonElement>("[data-view]")) {
    button.addEventListener("click", () => view.look(button.dataset.view ?? "iso"));
  }
  for (const box of document.querySelectorAll<HTMLInputElement>("[data-show]")) {
    const set = (chosen: boolean) => view.show(box.dataset.show ?? "", box.checked, chosen);
    box.addEventListener("change", () => set(true));
    // A browser may remember the state of a box from the last visit.
    set(false);
  }
  const by = element<HTMLSelectElement>("kc-colour");
  const scale = element("kc-scale");
  const paint = () => {
    if (!by) return;
    const most = view.colourPath(by.value as "" | "arc" | "chip");
    if (!scale) return;
    scale.hidden = by.value === "";
    scale.querySelector("span:last-child")?.replaceChildren(by.value === "arc" ? `${most.toFixed(0)}° and more` : `${most.toFixed(3)} mm`);
  };
  by?.addEventListener("change", paint);
  // A browser may remember the choice from the last visit.
  paint();
  const [axis, place, at] = [element<HTMLSelectElement>("kc-clip-axis"), element<HTMLInputElement>("kc-clip"), element("kc-clip-at")];
  if (!axis || !place || !at) return;
  const cut = () => {
    const mm = view.section(axis.value, Number(place.value) / Number(place.max));
    place.disabled = mm === null;
    at.textContent = mm === null ? "" : `${axis.value} ${mm.toFixed(2)}`;
  };
  axis.addEventListener("change", cut);
  place.addEventListener("input", cut);
  cut();
}

/** Findings and rows of tables lead to their line and place. */
function startLinks(view: View | null, track: Track, cursor: Cursor): void {
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  document.addEventListener("click", (e) => {
    const link = (e.target as Element).closest<HTMLElement>("button.jump, tr[data-line]");
    if (!link) return;
    const { line, point } = link.dataset;
    if (line !== undefined) cursor.go(track.ofLine(Number(line)), "link");
    const at = point?.split(" ").map(Number);
    if (at?.length === 3) view?.showPoint(at as [number, number, number]);
    if (link.matches("button")) element("work")?.scrollIntoView({ behavior: calm ? "auto" : "smooth", block: "start" });
  });
}

function startKeys(player: Player): void {
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.shiftKey) return;
    const target = e.target as Element;
    if (target.closest("input, select, textarea, summary")) return;
    if (e.key === "ArrowLeft" || e.key === "ArrowRight") {
      e.preventDefault();
      player.step(e.key === "ArrowRight" ? 1 : -1);
    }
    if (e.key === " " && target.closest("#kc-list, #kc-canvas")) {
      e.preventDefault();
      player.toggle();
    }
  });
}

/** A canvas does not print reliably: paper gets a still picture in light colours. */
function startPrint(view: View, changed: () => void): void {
  const still = element<HTMLImageElement>("kc-still");
  if (!still) return;
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("printing");
    changed();
    still.src = view.still();
    still.hidden = false;
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    still.hidden = true;
    changed();
  });
}

/** Without its data the page is what it is without script, and says why. */
function giveUp(): void {
  document.documentElement.classList.remove("scripted");
  const why = typeof DecompressionStream === "undefined" ? "it has no DecompressionStream" : "the data is damaged";
  for (const told of document.querySelectorAll(".fallback .unscripted, .packed")) {
    told.textContent = `This browser cannot unpack the 3-D view and long programs: ${why}. `;
  }
}

async function start(): Promise<void> {
  document.documentElement.classList.add("scripted");
  startTheme();
  try {
    await unpack();
  } catch {
    giveUp();
    return;
  }
  const head = json<Head>("kc-head");
  const track = new Track(head);
  const cursor = new Cursor();
  const view = startView(head, track, cursor);
  if (element("kc-list")) new ProgramList(track, cursor);
  startPictures(track, cursor);
  startLinks(view, track, cursor);
  if (element("kc-time")) startKeys(new Player(track, cursor));
  startStrip(track);
  if (view) {
    startBar(view);
    startPrint(view, themeChanged);
  }
  startAtWorst(view, track, cursor);
}

/** The page opens at the worst error, so that its picture is the first one sees. */
function startAtWorst(view: View | null, track: Track, cursor: Cursor): void {
  const link = document.querySelector<HTMLElement>(".findings .error button.jump");
  if (!link) return;
  if (link.dataset.line !== undefined) cursor.go(track.ofLine(Number(link.dataset.line)), "start");
  const at = link.dataset.point?.split(" ").map(Number);
  if (at?.length === 3) view?.showPoint(at as [number, number, number]);
}

void start();
