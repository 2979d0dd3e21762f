// One machine that moves: sliders of its axes, tip and direction of the tool, and the way back from those to the axes.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Name, Said } from "../../../app/verbatim";
import { fixed } from "../../../base/format";
import { t } from "../../../words";
import { isFinding } from "../newest";
import { Machines } from "../onmachine";
import { PlainNumber } from "../number";
import { machine as asked } from "../state";
import { tab } from "../open";
import { type Axis, type Found, inverse, joints, length, open, pose, save, shown, source, stale, take, words, wrong } from "./state";
import { MachineView } from "./view";

/** Travel that a slider has where the machine says none [mm, deg]. */
const TRAVEL = { linear: 500, rotary: 180 };

export function MachineTab() {
  useEffect(() => {
    open.value = true;
    if (!source.value) take({ machine: "trt_xyzac" });
  }, []);
  const told = shown.value?.machine;
  return (
    <div class="cols machineCols">
      <div class="stack">
        <section class="panel" aria-label={t("axes.which")} tabIndex={-1} data-panel="which">
          <header>
            <h2>{t("axes.which")}</h2>
          </header>
          <div class="pad">
            <label class="pick" for="axes-machine">
              {t("surface.machine")}
            </label>
            <Machines id="axes-machine" value={source.value?.machine ?? ""} none={source.value?.layout ? t("axes.layout", { code: source.value.layout }) : t("axes.choose")} set={(name) => name && take({ machine: name })} />
            {source.value?.layout && <Layout code={source.value.layout} />}
            {source.value?.machine && (
              <button
                onClick={() => {
                  asked.value = source.value?.machine ?? null;
                  tab.value = "surface";
                }}
              >
                {t("axes.askSurface")}
              </button>
            )}
          </div>
        </section>
        {told && <Axes all={told.axes} />}
        {told && source.value?.machine && <Inverse />}
      </div>
      <div class="stack">
        {wrong.value && (
          <p class="across" role="alert" data-wrong>
            <Said text={wrong.value.message} /> {wrong.value.help && <Said text={wrong.value.help} />}
          </p>
        )}
        <section class="panel" aria-label={t("axes.moves")} tabIndex={-1} data-panel="machine">
          <header>
            <h2>{told ? <Name>{`${told.code} ${told.name === told.code ? "" : told.name}`}</Name> : t("axes.moves")}</h2>
            {told && <span class="q" translate={false}>{told.iso}</span>}
            {stale.value && <span class="waits" />}
          </header>
          {told ? <MachineView key={shown.value?.of} /> : <p class="q hint">{t("surface.reading")}</p>}
          {told?.drawn?.usual && <p class="q hintLine">{t("axes.usual")}</p>}
          <p class="q hintLine">{t("axes.colours")}</p>
        </section>
        <Told />
      </div>
    </div>
  );
}

function Layout({ code }: { code: string }) {
  const name = useSignal(`machine-${code}.toml`);
  return (
    <div class="asks">
      <label class="field">
        <span>{t("axes.file")}</span>
        <input value={name.value} spellcheck={false} onInput={(e) => (name.value = e.currentTarget.value)} data-file-name />
      </label>
      <button onClick={() => void save(name.value)} data-save-machine>
        {t("axes.save")}
      </button>
    </div>
  );
}

function Axes({ all }: { all: Axis[] }) {
  const move = (axis: string, value: number) => (joints.value = { ...joints.value, [axis]: value });
  return (
    <section class="panel" aria-label={t("axes.axes")} tabIndex={-1} data-panel="axes">
      <header>
        <h2>{t("axes.axes")}</h2>
        <span class="sp" />
        <button class="ghost" disabled={Object.keys(joints.value).length === 0} onClick={() => (joints.value = {})} data-home>
          {t("axes.home")}
        </button>
      </header>
      <div class="pad axes">
        {all.map((a) => {
          const [low, high] = a.travel ?? (a.rotary ? [-TRAVEL.rotary, TRAVEL.rotary] : [-TRAVEL.linear, TRAVEL.linear]);
          const value = joints.value[a.axis] ?? 0;
          const told = pose.value?.pose.findings.find((f) => f.key === a.axis);
          const label = t(a.work_side ? "axes.ofWork" : "axes.ofTool", { axis: a.axis });
          return (
            <div key={a.axis} class={`axis${told ? " wrong" : ""}`} data-axis={a.axis}>
              <label for={`axis-${a.axis}`}>
                <b translate={false}>{`${a.axis}${a.work_side ? "\u2032" : ""}`}</b> <span>{t(a.rotary ? "axes.about" : "axes.along")}</span>
              </label>
              <input type="range" aria-label={label} min={low} max={high} step={a.rotary ? 0.5 : 1} value={value} onInput={(e) => move(a.axis, Number(e.currentTarget.value))} />
              <PlainNumber id={`axis-${a.axis}`} label={<span class="sr">{label}</span>} name={label} value={a.axis in joints.value ? value : null} standard="0" unit={a.rotary ? "°" : "mm"} set={(n) => move(a.axis, n)} wrong={told?.message ?? null} />
              <small class="q" translate={false}>
                {a.travel ? `${fixed(low, 0)} \u2026 ${fixed(high, 0)}` : t("axes.noTravel")}
              </small>
            </div>
          );
        })}
        <PlainNumber id="tool" label={t("surface.toolLength")} name={t("surface.toolLength")} value={length.value === 0 ? null : length.value} standard="0" unit="mm" set={(n) => (length.value = n)} />
      </div>
    </section>
  );
}

function Told() {
  const p = pose.value?.pose;
  const told = shown.value?.machine;
  if (!p || !told) return null;
  return (
    <dl class="facts" aria-live="polite" data-late={stale.value || undefined}>
      <div data-fact="tip">
        <dt>{t("axes.tip")}</dt>
        <dd translate={false}>
          <b>{p.tip.map((c) => fixed(c, 3)).join("  ")}</b>
          <small>{words(p.joints)}</small>
        </dd>
      </div>
      <div data-fact="axis">
        <dt>{t("axes.direction")}</dt>
        <dd translate={false}>
          <b>{p.axis.map((c) => fixed(c, 4)).join("  ")}</b>
        </dd>
      </div>
      <div data-fact="canonical">
        <dt>{t("axes.canonical")}</dt>
        <dd translate={false}>
          <b>{told.canonical}</b>
        </dd>
      </div>
    </dl>
  );
}

/** From tip and direction to the axes. */
function Inverse() {
  const typed = useSignal("X0 Y0 Z0 I0 J-0.5 K0.866");
  const answered = useSignal<{ of: string; found: Found | null; told: string | null } | null>(null);
  const question = JSON.stringify([source.value, length.value, typed.value]);
  const ask = async () => {
    const answer = await inverse(typed.value);
    if (answer !== null) answered.value = { of: question, found: isFinding(answer) ? null : answer, told: isFinding(answer) ? answer.message : null };
  };
  // Positions of another machine or of another pose are none of this one.
  const { found, told } = answered.value?.of === question ? answered.value : { found: null, told: null };
  return (
    <section class="panel" aria-label={t("axes.inverse")} tabIndex={-1} data-panel="inverse">
      <header>
        <h2>{t("axes.inverse")}</h2>
      </header>
      <div class="pad">
        <label class={`field${told ? " wrong" : ""}`}>
          <span>{t("axes.pose")}</span>
          <input value={typed.value} spellcheck={false} aria-invalid={told ? true : undefined} onInput={(e) => (typed.value = e.currentTarget.value)} onKeyDown={(e) => e.key === "Enter" && void ask()} data-pose />
        </label>
        <button onClick={() => void ask()} data-inverse>
          {t("axes.find")}
        </button>
        {told && (
          <p class="told" role="alert">
            <Said text={told} />
          </p>
        )}
        {found?.solutions.length === 0 && <p>{t("axes.none")}</p>}
        {found?.solutions.map((s, i) => (
          <button key={i} class="solution" onClick={() => (joints.value = { ...s.joints })} data-solution={i}>
            <Name>{Object.entries(s.joints).map(([a, v]) => `${a}${fixed(v, 3)}`).join(" ")}</Name>
            {s.within_travel === false && <span class="tag np">{t("axes.beyond")}</span>}
          </button>
        ))}
      </div>
    </section>
  );
}
