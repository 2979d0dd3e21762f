// Typed numbers: the placement, the bad exits, the cutter; and the weights of edges by their names.
import { digitsOf, fixed } from "../../base/format";
import { Name } from "../../app/verbatim";
import { t } from "../../words";
import { Num } from "./number";
import { change } from "./open";
import type { Face } from "./state";

const op = (key: string) => ["operation", key];

export function Settings({ face }: { face: Face }) {
  const hand = face.hand.value;
  const answer = face.least.value?.answer;
  const of = (path: (string | number)[]) => face.number(path);
  const wrong = face.leastWrong.value;
  const text = (path: (string | number)[]) => ({ value: of(path), wrong: wrong && wrong.key === path.join(".") ? wrong.message : null, set: (n: number) => change(face, path, n), clear: () => change(face, path, null) });
  const [first] = answer?.bad_exit_angles ?? [];
  const bad = answer?.bad_exit_angles.length === 1 && first.from === 0 ? digitsOf(first.to) : null;
  return (
    <section class="panel" aria-label={t("face.settings")}>
      <h2 class="sr">{t("face.settings")}</h2>
      <div class="strip">
        <Num name="turn" label={t("face.turn")} unit="°" value={hand ? Number(hand.turn.toFixed(2)) : null} set={(n) => hand && face.move({ ...hand, turn: n })} />
        <Num name="offset" label={t("face.offset")} unit="mm" value={hand ? Number(hand.beside.toFixed(3)) : null} set={(n) => hand && face.move({ ...hand, beside: n })} />
        <Num name="bad" label={t("face.badUpTo")} unit="°" standard={bad} {...text(op("exit_angle_min"))} />
        <Num name="guard" label={t("face.guard")} unit="°" standard={answer ? digitsOf(answer.guard) : null} {...text(op("guard"))} />
        <Num name="diameter" label={t("face.diameter")} unit="mm" {...text(["tool", "diameter"])} clear={null} />
        <Num name="teeth" label={t("face.teeth")} unit="" whole {...text(["tool", "teeth"])} clear={null} />
        <Num name="depth" label={t("face.depth")} unit="mm" {...text(op("depth"))} clear={null} />
        <Num name="margin" label={t("face.margin")} unit="mm" standard={answer ? digitsOf(answer.margin) : null} {...text(op("margin"))} />
      </div>
    </section>
  );
}

/** Weights of a millimetre of edge by the names of the edges; clicking an edge of the picture chooses its name. */
export function Weights({ face }: { face: Face }) {
  const labels = face.labels.value;
  const chosen = face.label.value;
  return (
    <section class="panel weights" aria-label={t("face.weights")}>
      <header>
        <h2>{t("face.weights")}</h2>
        <span class="q">{t("face.weightsHow")}</span>
      </header>
      {labels.length === 0 ? (
        <p class="q hint">{t(face.outline.value ? "face.noLabels" : "face.noPicture")}</p>
      ) : (
        <table>
          <thead>
            <tr>
              <th scope="col">{t("face.edges")}</th>
              <th scope="col" class="n">
                {t("face.edgeCount")}
              </th>
              <th scope="col" class="n">
                {t("face.edgeLength")}
              </th>
              <th scope="col" class="n">
                {t("face.weight")}
              </th>
            </tr>
          </thead>
          <tbody>
            {labels.map(({ label, length, weight, count }) => {
              const path = ["operation", "weights", label];
              return (
                <tr key={label} aria-selected={label === chosen} data-label={label}>
                  <th scope="row">
                    <button class="ghost" aria-pressed={label === chosen} onClick={() => (face.label.value = label === chosen ? null : label)}>
                      <Name>{label}</Name>
                    </button>
                  </th>
                  <td class="n" translate={false}>
                    {count}
                  </td>
                  <td class="n" translate={false}>
                    {fixed(length, 1)}
                  </td>
                  <td class="n">
                    <Num name={`weight-${label}`} label={t("face.weightOf", { name: label })} unit="" value={face.number(path)} standard={digitsOf(weight)} set={(n) => change(face, path, n)} clear={() => change(face, path, null)} />
                  </td>
                </tr>
              );
            })}
          </tbody>
        </table>
      )}
    </section>
  );
}
