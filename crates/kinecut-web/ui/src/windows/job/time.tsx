// Time: play, scrub, step; operations as bands; what is removed, or how thick chips are.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { Track } from "viewer/track";
import { offer } from "../../app/commands";
import { goTo, programLine } from "../../app/go";
import { clock, fixed, short, ticks, timeTicks } from "../../base/format";
import { type Document, pathOf } from "../../store/document";
import { active, place } from "../../store/session";
import { untranslated } from "../../app/verbatim";
import { t } from "../../words";
import { type Band, bandsOf } from "./bands";
import { findingFrom, goTime, now, playing, speed, step, stepOperation, toggle } from "./player";

offer(
  { id: "command.play", keys: ["Space"], run: toggle },
  { id: "command.back", keys: [","], run: () => step(-1) },
  { id: "command.on", keys: ["."], run: () => step(1) },
  { id: "command.operationBack", keys: ["["], run: () => stepOperation(-1) },
  { id: "command.operationOn", keys: ["]"], run: () => stepOperation(1) },
  { id: "command.findingOn", keys: ["N"], run: () => goFinding(1) },
  { id: "command.findingBack", keys: ["Shift+N"], run: () => goFinding(-1) },
);

function goFinding(by: 1 | -1): void {
  const doc = active.value;
  const i = findingFrom(by);
  if (!doc || i === null) return;
  doc.finding.value = i;
  goTo(doc, doc.findings.value[i]);
}

export function TimePanel({ doc }: { doc: Document }) {
  const track = doc.shown.value?.track ?? null;
  const at = place.value;
  const show = (seconds: number) => (track?.timed === false ? t("time.untimed", { mm: fixed(seconds, 0) }) : clock(seconds));
  const role = track && at.piece >= 0 && at.piece < track.pieces ? track.head.roles[track.role[at.piece]] : null;
  const total = track?.totalTime ?? 0;
  return (
    <section class="panel time" aria-label={t("panel.time")} tabIndex={-1} data-panel="time">
      <div class="ctl">
        <h2 class="sr">{t("panel.time")}</h2>
        <button class="icon" aria-label={t("time.back")} disabled={!track} onClick={() => step(-1)}>
          <span aria-hidden="true">◂</span>
        </button>
        <button class="icon primary" aria-label={t(playing.value ? "time.pause" : "time.play")} disabled={!track} onClick={toggle} data-play={playing.value ? "on" : "off"}>
          <span aria-hidden="true">{playing.value ? "❚❚" : "▶"}</span>
        </button>
        <button class="icon" aria-label={t("time.on")} disabled={!track} onClick={() => step(1)}>
          <span aria-hidden="true">▸</span>
        </button>
        <span class="seg opt" role="radiogroup" aria-label={t("time.speed")}>
          {[1, 10, 60, 0].map((n) => (
            <button key={n} role="radio" aria-checked={speed.value === n} onClick={() => (speed.value = n)}>
              {n === 0 ? t("time.fit") : <span translate={false}>{n}×</span>}
            </button>
          ))}
        </span>
        {track && (
          <span class="clock">
            <b translate={false}>{at.line < 0 ? show(total) : show(now.value)}</b> <span class="q">{t("time.of", { total: show(total) })}</span>{" "}
            {track.timed && doc.atFeeds.value && <span class="q feeds">{t("time.atFeeds")}</span>}
          </span>
        )}
        {track && at.line >= 0 && (
          <span class="q opt where">
            {role ? t("time.lineRole", { n: at.line + 1, total: track.lines, role: t(`part.role.${role as "rapid"}`) }) : t("time.line", { n: at.line + 1, total: track.lines })}
          </span>
        )}
        <span class="sp" />
        <Removed doc={doc} />
        <span class="opt hints">
          <kbd translate={false}>Space</kbd> {t("time.hints.play")} <kbd translate={false}>,</kbd> <kbd translate={false}>.</kbd> {t("time.hints.step")} <kbd translate={false}>N</kbd> {t("time.hints.finding")}
        </span>
      </div>
      <Chart doc={doc} track={track} show={show} />
    </section>
  );
}

function Removed({ doc }: { doc: Document }) {
  const removal = doc.simulated.value?.removal;
  if (!removal || removal.length === 0) return null;
  const all = removal[removal.length - 1][1];
  const so = place.value.line < 0 ? all : removedAt(removal, now.value);
  return <span class="q opt removed">{t("time.removed", { now: fixed(so / 1000, 1), all: fixed(all / 1000, 1) })}</span>;
}

function removedAt(removal: [number, number][], seconds: number): number {
  const i = removal.findIndex(([time]) => time >= seconds);
  if (i < 0) return removal[removal.length - 1][1];
  if (i === 0) return removal[0][1];
  const [[a, u], [b, v]] = [removal[i - 1], removal[i]];
  return b > a ? u + ((v - u) * (seconds - a)) / (b - a) : v;
}

interface Curve {
  /** Greatest value at each pixel. */
  columns: Float32Array;
  most: number;
  unit: string;
  /** What a value is, as the read-out says it. */
  told: (value: number) => string;
}

/** The rate of removal [cm3/min], or where that is not known the thickness of chips [mm]. */
function curveOf(doc: Document, track: Track, width: number): Curve | null {
  const columns = new Float32Array(Math.max(1, width));
  const column = (seconds: number) => Math.min(columns.length - 1, Math.max(0, Math.floor((seconds / track.totalTime) * columns.length)));
  const removal = doc.simulated.value?.removal;
  if (removal && removal.length > 1) {
    for (let i = 1; i < removal.length; i++) {
      const [[a, u], [b, v]] = [removal[i - 1], removal[i]];
      if (!(b > a)) continue;
      const rate = ((v - u) / 1000 / (b - a)) * 60;
      for (let x = column(a); x <= column(b); x++) columns[x] = Math.max(columns[x], rate);
    }
    return { columns, most: columns.reduce((m, n) => Math.max(m, n), 0), unit: t("time.removal"), told: (n) => `${fixed(n, n < 10 ? 1 : 0)} cm³/min` };
  }
  if (track.chip.length === 0) return null;
  for (let p = 0; p < track.pieces; p++) {
    const from = p > 0 ? track.timeEnd[p - 1] : 0;
    const span = track.timeEnd[p] - from;
    for (let run = track.firstEngaged[p], before = 0; run < track.firstEngaged[p + 1]; before = track.engagedEnd[run++]) {
      const chip = track.chip[run];
      if (!(chip > 0)) continue;
      for (let x = column(from + span * before); x <= column(from + span * track.engagedEnd[run]); x++) columns[x] = Math.max(columns[x], chip);
    }
  }
  const most = columns.reduce((m, n) => Math.max(m, n), 0);
  return most > 0 ? { columns, most, unit: t("time.chip"), told: (n) => `${fixed(n, 3)} mm` } : null;
}

function area(columns: Float32Array, left: number, bottom: number, scale: number): string {
  let d = `M${left} ${bottom}`;
  let before = 0;
  for (let x = 0; x < columns.length; x++) {
    const y = columns[x];
    if (y === before && x + 1 < columns.length) continue;
    d += `H${left + x}V${(bottom - y * scale).toFixed(1)}`;
    before = y;
  }
  return `${d}H${left + columns.length}V${bottom}`;
}

function Chart({ doc, track, show }: { doc: Document; track: Track | null; show: (seconds: number) => string }) {
  const box = useRef<HTMLDivElement>(null);
  const size = useSignal<[number, number]>([800, 110]);
  const hover = useSignal<number | null>(null);
  useEffect(() => {
    const element = box.current as HTMLDivElement;
    const watch = new ResizeObserver(() => (size.value = [element.clientWidth, element.clientHeight]));
    watch.observe(element);
    return () => watch.disconnect();
  }, []);
  const [width, height] = size.value;
  const left = width < 420 ? 30 : 44;
  const right = width - 12;
  const room = Math.max(20, right - left);
  const total = track?.totalTime ?? 0;
  const work = doc.work.value;
  const bands = useMemo(() => (track ? bandsOf(track, work?.operations) : []), [track, work]);
  const curve = useMemo(() => (track && total > 0 ? curveOf(doc, track, Math.floor(room)) : null), [track, work, Math.floor(room)]);
  if (!track || total <= 0) return <div class="chart" ref={box} />;
  const seconds = (px: number) => ((px - left) / room) * total;
  const at = place.value.line < 0 ? total : now.value;
  const frame = { width, height, left, right, top: 40, bottom: height - 20 };
  const drag = (e: PointerEvent) => {
    const rect = (box.current as HTMLDivElement).getBoundingClientRect();
    goTime(seconds(e.clientX - rect.left));
  };
  const keys = (e: KeyboardEvent) => {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: 10, PageDown: -10 }[e.key];
    const to = e.key === "Home" ? 0 : e.key === "End" ? total : by === undefined ? undefined : at + (by * (e.shiftKey ? 10 : 1) * total) / 200;
    if (to === undefined) return;
    e.preventDefault();
    goTime(to);
  };
  return (
    <div
      class={`chart${doc.wrong.value ? " dim" : ""}`}
      ref={box}
      role="slider"
      tabIndex={0}
      aria-label={t("time.slider")}
      aria-valuemin={0}
      aria-valuemax={Math.round(total)}
      aria-valuenow={Math.round(at)}
      aria-valuetext={`${show(at)} ${t("time.of", { total: show(total) })}`}
      onKeyDown={keys}
      onPointerDown={(e) => {
        if (e.button !== 0 || (e.target as Element).closest("[data-band]")) return;
        e.currentTarget.setPointerCapture(e.pointerId);
        drag(e);
      }}
      onPointerMove={(e) => {
        const rect = e.currentTarget.getBoundingClientRect();
        hover.value = e.clientX - rect.left;
        if (e.currentTarget.hasPointerCapture(e.pointerId)) drag(e);
      }}
      onPointerLeave={() => (hover.value = null)}
    >
      <Drawing doc={doc} track={track} curve={curve} bands={bands} frame={frame} at={at} hover={hover.value} show={show} />
    </div>
  );
}

interface Frame {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

interface DrawingProps {
  doc: Document;
  track: Track;
  curve: Curve | null;
  bands: Band[];
  frame: Frame;
  at: number;
  hover: number | null;
  show: (seconds: number) => string;
}

function Drawing({ doc, track, curve, bands, frame, at, hover, show }: DrawingProps) {
  const { width, height, left, right, top, bottom } = frame;
  const room = Math.max(20, right - left);
  const total = track.totalTime;
  const x = (seconds: number) => left + (seconds / total) * room;
  const marks = curve ? ticks(curve.most, bottom - top > 60 ? 3 : 2) : [];
  const scale = curve ? (bottom - top) / Math.max(curve.most, marks[marks.length - 1] || 1e-9) : 0;
  const px = x(at);
  const under = curve?.columns[Math.min(curve.columns.length - 1, Math.max(0, Math.floor(px - left)))] ?? 0;
  const line = place.value.line;
  const told = [curve && under > 0 ? curve.told(under) : "", line >= 0 ? t("time.lineShort", { n: line + 1 }) : ""].filter(Boolean).join(", ");
  const every = width < 420 ? 4 : Math.max(4, Math.floor(room / 120));
  return (
    <svg width={width} height={height} aria-hidden="true">
      {bands.map((band, i) => (
        <BandRect key={i} doc={doc} band={band} x={x} />
      ))}
      {curve && (
        <>
          <text x={2} y={top - 5}>
            {curve.unit}
          </text>
          {marks.map((n) => (
            <g key={n} {...untranslated}>
              <path class="grid" d={`M${left} ${(bottom - n * scale).toFixed(1)}H${right}`} />
              <text x={left - 6} y={bottom - n * scale + 4} text-anchor="end">
                {short(n, 3)}
              </text>
            </g>
          ))}
          <path class="area" d={area(curve.columns, left, bottom, scale)} />
        </>
      )}
      <path class="axis" d={`M${left} ${bottom}H${right}`} />
      {timeTicks(total, every).map((s) => (
        <text key={s} x={x(s)} y={height - 5} text-anchor={s === 0 ? "start" : "middle"} {...untranslated}>
          {show(s)}
        </text>
      ))}
      {doc.findings.value.map((finding, i) => {
        const l = programLine(doc, finding);
        if (l === null || finding.severity === "note" || l >= track.lines) return null;
        const time = track.value(track.ofLine(l), track.timeEnd);
        if (Number.isNaN(time)) return null;
        const c = x(time);
        return <path key={i} class={`mark ${finding.severity}`} d={`M${c} ${top - 2}l6 7-6 7-6-7Z`} onPointerDown={(e) => { e.stopPropagation(); doc.finding.value = i; goTo(doc, finding); }} />;
      })}
      {hover !== null && hover >= left && hover <= right && <path class="hair thin" d={`M${hover} ${top - 8}V${bottom}`} />}
      <path class="hair" d={`M${px} 26V${bottom}`} />
      <path class="hand" d={`M${px - 6} 4h12v12l-6 6-6-6Z`} />
      {told && line >= 0 && (
        <g class="told" transform={`translate(${Math.min(px + 8, right - (told.length * 6.4 + 14))} ${top})`} {...untranslated}>
          <rect width={told.length * 6.4 + 14} height="18" rx="3" />
          <text x="7" y="13" class="w">
            {told}
          </text>
        </g>
      )}
    </svg>
  );
}

function BandRect({ doc, band, x }: { doc: Document; band: Band; x: (s: number) => number }) {
  const [from, to] = [x(band.start), x(band.end)];
  const width = Math.max(2, to - from - 2);
  const chosen = place.value.line >= band.run.from && place.value.line < band.run.to;
  const path = pathOf(band.run.key);
  // The number that the form has before its name.
  const number = Number(path.at(-1)) + 1;
  const words = `${number} ${band.run.title}, T${band.run.tool}`;
  const room = Math.floor((width - 10) / 6.3);
  const shown = room >= words.length ? words : room >= 4 ? `${words.slice(0, room - 1)}…` : room >= 1 ? String(number).slice(0, room) : "";
  const doubt = doc.findings.value.some((f) => f.severity !== "note" && f.key?.startsWith(band.run.key));
  return (
    <g
      data-band={band.run.key}
      class={`band${chosen ? " on" : ""}${doubt ? " doubt" : ""}`}
      {...untranslated}
      onPointerDown={(e) => {
        e.stopPropagation();
        doc.chosen.value = path;
        goTime(band.start + 1e-9);
      }}
    >
      <title>{words}</title>
      <rect x={from + 1} y="6" width={width} height="18" rx="3" />
      <text class="w b" x={from + 7} y="19">
        {shown}
      </text>
    </g>
  );
}
