// The redistributions by the number of motions in the tool, and everything about the one that is looked at.
import { fixed } from "../../base/format";
import { Said } from "../../app/verbatim";
import { t } from "../../words";
import { type SetUp, type Split, type Surface, elements, letter, part, pretty } from "./answer";
import { Paper, VIEWS, line, quads } from "./space";
import { answer, chosen, made, madeStale, split } from "./state";

const SIZE: [number, number] = [66, 50];

/** A redistribution in small: the surface, and what of it the tool has. */
function Small({ surface, of }: { surface: Surface; of: Split }) {
  const sketch = surface.sketch;
  const one = sketch?.splits.find((s) => s.machine_code === of.machine_code && s.tool_code === of.tool_code);
  if (!sketch) return null;
  const paper = new Paper(VIEWS.iso, sketch.mesh.flat(), ...SIZE, 4);
  const faces = quads(sketch.mesh, paper, 8);
  return (
    <svg width={SIZE[0]} height={SIZE[1]} aria-hidden="true">
      {faces.map((q, i) => (
        <path key={i} d={q.d} class={one?.tool === "surface" ? "dieSmall" : "outline"} />
      ))}
      {one?.tool === "edge" && <path class="edge" d={line(one.points.map((p) => paper.px(p)))} />}
      {one?.tool === "point" && <circle class="tip" cx={paper.px(one.points[0])[0]} cy={paper.px(one.points[0])[1]} r={4} />}
    </svg>
  );
}

/** A sign and a word: what a machine says. */
function Can({ of }: { of: Split }) {
  // What a machine says about other numbers is none of these.
  const answered = madeStale.value ? undefined : made.value?.made.splits.find((s) => s.machine_code === of.machine_code && s.tool_code === of.tool_code);
  if (!answered) return null;
  return <span class={`tag ${answered.possible ? "safe" : "bad"}`}>{t(answered.possible ? "surface.can" : "surface.cannot")}</span>;
}

export function Splits() {
  const surface = answer.value?.surface;
  if (!surface) return null;
  const all = surface.splits;
  const most = Math.max(...all.map((s) => elements(s.tool).length));
  const columns = Array.from({ length: most + 1 }, (_, n) => all.filter((s) => elements(s.tool).length === n));
  return (
    <section class="panel" aria-label={t("surface.splits")} tabIndex={-1} data-panel="splits">
      <header>
        <h2>{t("surface.splits")}</h2>
        <span class="q">{t("surface.splitsAre", { n: all.length, rigid: all.filter((s) => s.valid).length })}</span>
      </header>
      <div class="lattice" role="group" aria-label={t("surface.splits")} tabIndex={0}>
        {columns.map((column, n) => (
          <div key={n} class="level">
            <small>{t("surface.inTool", { n })}</small>
            {column.map((s) => (
              <button key={`${s.machine}|${s.tool}`} class="card" aria-pressed={s === split.value} disabled={!s.valid} title={s.valid ? s.process : s.remarks.join("; ")} onClick={() => (chosen.value = [s.machine_code, s.tool_code])} data-split={`${s.machine_code}|${s.tool_code}`}>
                <Small surface={surface} of={s} />
                <b translate={false}>
                  {part(s.machine_code)} | {part(s.tool_code)}
                </b>
                <small lang="en">{s.valid ? s.tool_kind : t("surface.notRigid")}</small>
                <Can of={s} />
              </button>
            ))}
          </div>
        ))}
      </div>
    </section>
  );
}

const digits = (all: number[]): string => (all.length === 0 ? "\u2013" : all.map((d) => `${d} (${letter(d)})`).join(", "));

/** What is known of the redistribution that is looked at. */
export function Facts() {
  const s = split.value;
  if (!s) return null;
  return (
    <section class="panel" aria-label={t("surface.chosen")} tabIndex={-1} data-panel="chosen">
      <header>
        <h2 translate={false}>
          {part(s.machine_code)} | {part(s.tool_code)}
        </h2>
        <span class="q" lang="en">
          {s.tool_kind}
        </span>
      </header>
      <dl class="about">
        <Fact name="process" label={t("surface.process")}>
          <b lang="en">{s.process || "\u2013"}</b>
        </Fact>
        <Fact name="machineCode" label={t("surface.machineHas")}>
          <span translate={false}>{`${part(s.machine_code)}: ${s.machine === "-" ? t("surface.nothing") : pretty(s.machine)}`}</span>
        </Fact>
        <Fact name="toolCode" label={t("surface.toolHas")}>
          <span translate={false}>{`${part(s.tool_code)}: ${s.tool === "-" ? t("surface.nothing") : pretty(s.tool)}`}</span>
        </Fact>
        <Fact name="forming" label={t("surface.forming")}>
          <span translate={false}>{digits(s.forming)}</span>
        </Fact>
        <Fact name="setting" label={t("surface.setting")}>
          <span translate={false}>{digits(s.setting)}</span>
        </Fact>
        {s.links.map((l) => (
          <Fact key={l.variable} name="link" label={t("surface.linked", { variable: pretty(l.variable) })}>
            <span lang="en">
              {l.kind}: {pretty(l.motions)}
            </span>
          </Fact>
        ))}
        {s.built_in !== "-" && s.built_in !== "" && (
          <Fact name="builtIn" label={t("surface.builtIn")}>
            <span translate={false}>{pretty(s.built_in)}</span>
          </Fact>
        )}
        <Fact name="setup" label={t("surface.setup")}>
          <SetUpOf of={s} />
        </Fact>
        {s.methods && (
          <Fact name="methods" label={t("surface.methods")}>
            <span lang="en">{s.methods}</span>
          </Fact>
        )}
      </dl>
      {s.remarks.length > 0 && (
        <ul class="remarks">
          {s.remarks.map((r) => (
            <li key={r}>
              <Said text={r} />
            </li>
          ))}
        </ul>
      )}
      {s.candidates.length > 0 && <Candidates of={s} />}
    </section>
  );
}

function Fact({ name, label, children }: { name: string; label: string; children: preact.ComponentChildren }) {
  return (
    <div data-fact={name}>
      <dt>{label}</dt>
      <dd>{children}</dd>
    </div>
  );
}

const verdict = (c: SetUp): string => `${c.motion} (${c.source}): ${c.verdict}, ${fixed(c.margin, 3)}`;

function SetUpOf({ of }: { of: Split }) {
  if (!of.setup_needed) return <span>{t("surface.setupFree")}</span>;
  if (!of.setup) return <span class="bad">{t("surface.setupNone")}</span>;
  return (
    <span lang="en" data-verdict={of.setup.verdict}>
      <b>{of.setup.motion}</b> ({of.setup.source}), {of.setup.verdict}, {t("surface.margin", { margin: fixed(of.setup.margin, 3) })}
    </span>
  );
}

function Candidates({ of }: { of: Split }) {
  return (
    <details class="numbers">
      <summary>{t("surface.candidates", { n: of.candidates.length })}</summary>
      <div class="wide" tabIndex={0} role="region" aria-label={t("surface.candidatesOf")}>
        <table>
          <thead>
            <tr>
              <th scope="col">{t("surface.motion")}</th>
              <th scope="col">{t("surface.source")}</th>
              <th scope="col">{t("surface.verdict")}</th>
              <th scope="col" class="n">
                {t("surface.marginHead")}
              </th>
            </tr>
          </thead>
          <tbody translate={false} lang="en">
            {of.candidates.map((c) => (
              <tr key={verdict(c)}>
                <th scope="row">{c.motion}</th>
                <td>{c.source}</td>
                <td>{c.verdict}</td>
                <td class="n">{fixed(c.margin, 3)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}
