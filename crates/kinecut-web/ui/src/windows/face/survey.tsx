// The paper's figure 5: the largest exit angle over the turn, the cutter over the middle of the part.
import { fixed } from "../../base/format";
import { untranslated } from "../../app/verbatim";
import { t } from "../../words";
import type { Paper } from "./answer";
import { useWidth } from "./size";

const [TOP, LEFT, HEIGHT] = [10, 40, 140];
const BOTTOM = HEIGHT - 36;

export function Survey({ survey, turn }: { survey: Paper["survey"]; turn: number | null }) {
  const [box, width] = useWidth(560);
  const right = width.value - 12;
  const x = (deg: number) => LEFT + (deg / 360) * (right - LEFT);
  const y = (deg: number) => BOTTOM - (deg / 180) * (BOTTOM - TOP);
  let d = "";
  let before = false;
  for (const { placement, covered, largest_exit_angle } of survey) {
    // There is no exit angle to draw where the part is too wide.
    if (covered) d += `${before ? "L" : "M"}${x(placement.turn).toFixed(1)} ${y(largest_exit_angle).toFixed(1)}`;
    before = covered;
  }
  const near = turn === null ? undefined : survey.find((p) => p.covered && Math.abs(p.placement.turn - turn) <= 0.5);
  return (
    <div class="sectors survey" ref={box}>
      <svg width={width.value} height={HEIGHT} role="img" aria-label={t("face.survey")}>
        {[0, 90, 180].map((deg) => (
          <g key={deg} {...untranslated}>
            <path class="grid" d={`M${LEFT} ${y(deg)}H${right}`} />
            <text x={LEFT - 7} y={y(deg) + 4} text-anchor="end">
              {deg}°
            </text>
          </g>
        ))}
        {[0, 90, 180, 270, 360].map((deg) => (
          <g key={deg} {...untranslated}>
            <path class="axis" d={`M${x(deg)} ${BOTTOM}v4`} />
            <text x={x(deg)} y={BOTTOM + 16} text-anchor={deg === 360 ? "end" : "middle"}>
              {deg}°
            </text>
          </g>
        ))}
        <path class="curve" d={d} />
        {turn !== null && <path class="now" d={`M${x(turn)} ${TOP}V${BOTTOM}`} />}
        {near && (
          <text {...untranslated} class="w b" x={x(near.placement.turn) + (near.placement.turn > 300 ? -6 : 6)} y={TOP + 10} text-anchor={near.placement.turn > 300 ? "end" : "start"}>
            {fixed(near.largest_exit_angle, 1)}°
          </text>
        )}
        <text x={LEFT} y={HEIGHT - 4}>
          {t("face.survey")}
        </text>
        {width.value > 460 && (
          <text x={right} y={HEIGHT - 4} text-anchor="end">
            {t("face.axisTurn")}
          </text>
        )}
      </svg>
    </div>
  );
}
