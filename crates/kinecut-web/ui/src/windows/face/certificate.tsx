// The least placement, and the proof that none has less: of all turns at once, or sector by sector, so that it is seen to come.
import { fixed, short, ticks } from "../../base/format";
import { Said, untranslated } from "../../app/verbatim";
import { t } from "../../words";
import { isOptimum } from "./answer";
import { useWidth } from "./size";
import { type Face, SECTORS, type Sector, type Sectors } from "./state";

export function Certificate({ face }: { face: Face }) {
  const least = face.least.value;
  const optimum = face.optimum.value;
  const searching = face.searching.value;
  const sectors = face.sectors.value?.text === face.text.value ? face.sectors.value : null;
  const finding = sectors?.state === "searches";
  const stale = least !== null && least.text !== face.text.value;
  const found = optimum && !stale ? optimum : null;
  const stop = () => {
    if (searching) face.stopSearch();
    face.stopFinding();
  };
  const find = () => {
    if (stale || face.stopped.value) void face.searched();
    void face.find();
  };
  return (
    <section class={`panel cert ${found?.complete ? "proven" : "open"}`} aria-label={t("face.certificate")} tabIndex={-1} data-panel="certificate">
      <header>
        <h2>{t("face.certificate")}</h2>
        {found && <span class={`tag ${found.complete ? "safe" : "np"}`}>{found.complete ? t("face.proven") : t("face.gap", { mm: fixed(found.gap, 4) })}</span>}
        {stale && <span class="tag np">{t("face.older")}</span>}
        <span class="sp" />
        {(searching || finding) && (
          <span class="bar" role="progressbar" aria-label={t("face.searching")} aria-valuemin={0} aria-valuemax={100} aria-valuenow={finding ? Math.round((100 * sectors.parts.length) / SECTORS) : undefined}>
            <i style={{ width: `${finding ? (100 * sectors.parts.length) / SECTORS : 20}%` }} />
          </span>
        )}
        {searching || finding ? (
          <button class="ghost" onClick={stop}>
            {t("outcome.stop")}
          </button>
        ) : (
          <button class="ghost" onClick={find} data-find>
            {t("face.findLeast")}
          </button>
        )}
      </header>
      <div class="pad">
        <div role="status">
          <Words face={face} stale={stale} />
        </div>
        {sectors && sectors.parts.length > 0 && <SectorWords sectors={sectors} />}
      </div>
      {sectors && sectors.parts.some((p) => p.optimum) && <Chart sectors={sectors} />}
    </section>
  );
}

function Words({ face, stale }: { face: Face; stale: boolean }) {
  const wrong = face.leastWrong.value;
  const told = face.least.value?.answer;
  if (face.searching.value) return <p>{t("face.searching")}</p>;
  if (wrong) return <p>{t("face.noPicture")}</p>;
  if (face.stopped.value) return <p>{t("face.searchStopped")}</p>;
  if (!told) return null;
  if (!isOptimum(told.optimum)) return <Wrong message={told.optimum.error.message} help={told.optimum.error.help} />;
  const { value, lower_bound, gap, nodes, complete, irreducible } = told.optimum;
  const never = irreducible.reduce((sum, i) => sum + i.length, 0);
  return (
    <div class={stale ? "dim" : ""}>
      <p>
        <b>{t("face.noneBelow", { mm: fixed(lower_bound, 4) })}</b> {t("face.bestIs", { mm: fixed(value, 4), gap: fixed(gap, 4), n: nodes })} {complete ? t("face.isProven") : t("face.isOpen")}
      </p>
      <p class="q">{t("face.irreducible", { mm: fixed(never, 1) })}</p>
      {told.guard > 0 && <p class="q">{t("face.withGuard", { deg: fixed(told.guard, 1) })}</p>}
    </div>
  );
}

/** The proof for the turns that were searched so far. */
function SectorWords({ sectors }: { sectors: Sectors }) {
  const { parts, state } = sectors;
  const found = parts.flatMap((p) => p.optimum ?? []);
  const to = fixed(parts[parts.length - 1].to, 0);
  if (found.length === 0) return <p>{t("face.sectorsNone", { to })}</p>;
  const best = Math.min(...found.map((o) => o.value));
  const bound = Math.min(...found.map((o) => o.lower_bound));
  const all = state === "ended";
  return (
    <p data-sectors={state}>
      {t(all ? "face.sectorsAll" : "face.sectorsSome", { to, n: SECTORS, best: fixed(best, 4), bound: fixed(bound, 4), gap: fixed(best - bound, 4) })}
      {all && !found.every((o) => o.complete) && ` ${t("face.isOpen")}`}
    </p>
  );
}

export function Wrong({ message, help }: { message: string; help?: string }) {
  return (
    <p class="wrongly">
      <Said text={message} />
      {help && (
        <span class="q">
          {" "}
          <Said text={help} />
        </span>
      )}
    </p>
  );
}

const TOP = 10;
const LEFT = 40;
const HEIGHT = 150;
const BOTTOM = HEIGHT - 40;

/** Of each sector the band between what none of it is below and the best that was found; hatched where nothing is possible. */
function Chart({ sectors }: { sectors: Sectors }) {
  const [box, width] = useWidth(560);
  const right = width.value - 12;
  const found = sectors.parts.flatMap((p) => p.optimum ?? []);
  const most = 1.08 * Math.max(...found.map((o) => o.value));
  const x = (turn: number) => LEFT + (turn / 360) * (right - LEFT);
  const y = (mm: number) => BOTTOM - (mm / most) * (BOTTOM - TOP);
  const done = sectors.parts[sectors.parts.length - 1].to;
  const best = Math.min(...found.map((o) => o.value));
  return (
    <div class="sectors" ref={box}>
      <svg width={width.value} height={HEIGHT} role="img" aria-label={t("face.sectorsIs")}>
        <defs>
          <pattern id="sector-none" width="8" height="8" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
            <path class="hatch" d="M0 0V8" />
          </pattern>
        </defs>
        {ticks(most, 4).map((mm) => (
          <g key={mm} {...untranslated}>
            <path class="grid" d={`M${LEFT} ${y(mm)}H${right}`} />
            <text x={LEFT - 7} y={y(mm) + 4} text-anchor="end">
              {short(mm)}
            </text>
          </g>
        ))}
        {[0, 90, 180, 270, 360].map((turn) => (
          <g key={turn} {...untranslated}>
            <path class="axis" d={`M${x(turn)} ${BOTTOM}v4`} />
            <text x={x(turn)} y={BOTTOM + 16} text-anchor={turn === 360 ? "end" : "middle"}>
              {turn}°
            </text>
          </g>
        ))}
        {sectors.parts.map((part) => (
          <Band key={part.from} part={part} x={x} y={y} />
        ))}
        <path class="best" d={`M${LEFT} ${y(best)}H${x(done)}`} />
        {sectors.state !== "ended" && <path class="now" d={`M${x(done)} ${TOP}V${BOTTOM}`} />}
        <text x={right} y={HEIGHT - 4} text-anchor="end">
          {t("face.axisTurn")}
        </text>
        <text x={LEFT} y={HEIGHT - 4}>
          {t("face.axisLeast")}
        </text>
      </svg>
      <div class="key">
        <span>
          <svg width="30" height="8" aria-hidden="true">
            <path class="value" d="M0 4h30" />
          </svg>
          {t("face.keyBest")}
        </span>
        <span>
          <svg width="30" height="8" aria-hidden="true">
            <path class="bound" d="M0 4h30" />
          </svg>
          {t("face.keyBound")}
        </span>
      </div>
    </div>
  );
}

function Band({ part, x, y }: { part: Sector; x: (turn: number) => number; y: (mm: number) => number }) {
  const [from, to] = [x(part.from), x(part.to)];
  const { optimum } = part;
  if (!optimum) return <rect fill="url(#sector-none)" x={from} y={TOP} width={to - from} height={BOTTOM - TOP} />;
  const [value, bound] = [y(optimum.value), y(optimum.lower_bound)];
  return (
    <g>
      <rect class="band" x={from} y={value} width={to - from} height={Math.max(0, bound - value)} />
      <path class="bound" d={`M${from} ${bound}H${to}`} />
      <path class="value" d={`M${from} ${value}H${to}`} />
    </g>
  );
}
