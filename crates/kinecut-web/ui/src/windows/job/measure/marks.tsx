// Over the part: findings by the numbers of their list, and the places that are measured. They follow the camera.
import { signal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Point } from "viewer/scene";
import { untranslated } from "../../../app/verbatim";
import { goTo, programLine } from "../../../app/go";
import type { Document } from "../../../store/document";
import { picks } from "./picks";

type Project = (point: Point) => [number, number];

/** The newest projection; null before the first picture. */
let project: Project | null = null;
const follow = new Set<(project: Project) => void>();

/** Called with each picture. */
export function drawn(now: Project): void {
  project = now;
  for (const one of follow) one(now);
}

/** The marks that the part hides, by the numbers of their findings. */
const behind = signal<ReadonlySet<number>>(new Set());

/** Called with which of the marks are hidden. */
export function hidden(doc: Document, flags: boolean[]): void {
  const now = new Set(marksOf(doc).filter((_, i) => flags[i]).map((m) => m.finding));
  const before = behind.peek();
  if (now.size !== before.size || [...now].some((n) => !before.has(n))) behind.value = now;
}

interface Mark {
  point: Point;
  /** Index of the first finding there. */
  finding: number;
  label: string;
  severity: string;
}

/** Places of findings: their own, or that of the tool at their line. Several at one place have one mark. */
export function marksOf(doc: Document): Mark[] {
  const track = doc.shown.value?.track;
  const at = new Map<string, Mark>();
  doc.findings.value.forEach((finding, i) => {
    if (finding.severity === "note") return;
    const line = programLine(doc, finding);
    const point = finding.point ?? (line !== null && track && line < track.lines ? track.tip(track.ofLine(line)) : null);
    if (!point) return;
    const key = point.map((n) => n.toFixed(2)).join();
    const known = at.get(key);
    if (known) known.label = `${known.label.replace("+", "")}+`;
    else at.set(key, { point, finding: i, label: String(i + 1), severity: finding.severity });
  });
  return [...at.values()];
}

export function Marks({ doc }: { doc: Document }) {
  const svg = useRef<SVGSVGElement>(null);
  const marks = marksOf(doc);
  const [a, b] = picks.value;
  const places = [a?.point, b?.point].filter((p) => p !== undefined);
  useLayoutEffect(() => {
    const put = (now: Project) => {
      const all = svg.current?.querySelectorAll<SVGGElement>("[data-at]") ?? [];
      const points = [...marks.map((m) => m.point), ...places];
      all.forEach((g, i) => g.setAttribute("transform", `translate(${now(points[i]).map((n) => n.toFixed(1)).join(" ")})`));
      const ruler = svg.current?.querySelector(".ruler");
      if (ruler && places.length === 2) {
        const [[x, y], [u, v]] = places.map(now);
        ruler.setAttribute("d", `M${x.toFixed(1)} ${y.toFixed(1)}L${u.toFixed(1)} ${v.toFixed(1)}`);
      }
    };
    if (project) put(project);
    follow.add(put);
    return () => void follow.delete(put);
  });
  return (
    <svg class="marks" ref={svg} aria-hidden="true" {...untranslated}>
      {places.length === 2 && <path class="ruler" />}
      {marks.map((mark) => (
        <g
          key={`f${mark.finding}`}
          data-at="finding"
          class={`mark ${mark.severity}${doc.finding.value === mark.finding ? " on" : ""}${behind.value.has(mark.finding) ? " behind" : ""}`}
          onClick={() => {
            doc.finding.value = mark.finding;
            goTo(doc, doc.findings.value[mark.finding]);
          }}
        >
          <circle class="halo" r="10" />
          <circle r="9" />
          <text y="4" text-anchor="middle">
            {mark.label}
          </text>
        </g>
      ))}
      {places.map((_, i) => (
        <g key={`p${i}`} data-at="pick" class="pick">
          <path d="M-7 0H7M0-7V7" />
          <text x="8" y="-6">
            {"AB"[i]}
          </text>
        </g>
      ))}
    </svg>
  );
}
