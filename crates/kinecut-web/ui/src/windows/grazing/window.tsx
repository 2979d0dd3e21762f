// The window of a grazing curve: the tool with handles for its motion, the parameter plane beside it, spans and what the paper says.
import { fixed } from "../../base/format";
import type { Finding } from "../../base/api";
import type { Document } from "../../store/document";
import { Name, Said } from "../../app/verbatim";
import { t } from "../../words";
import { MotionPanel } from "./motion";
import { Paper } from "./paper";
import { Head, Mistakes, Notes, Settings, isOld, stateOf, useWindow } from "./parts";
import { Plane, ReadOut } from "./plane";
import { KINDS, type Sheet, isSheet } from "./sheet";
import { Looked } from "./state";
import { Loops, Spans } from "./tables";
import { ToolView } from "./toolview";

export function GrazingWindow({ doc }: { doc: Document }) {
  const looked = Looked.of(doc, "grazing");
  const { schema, late } = useWindow(doc, "grazing");
  const answer = looked.answer.value as Sheet | Finding | undefined;
  const wrong = doc.wrong.value ?? (answer && !isSheet(answer) ? answer : null);
  const sheet = looked.sheet.value;
  const item = looked.item.value;
  const hasTool = doc.value([...item, "tool"]) !== undefined || doc.value([...item, "tool_file"]) !== undefined;
  const isFixed = !hasTool;
  const old = isOld(doc, late);
  return (
    <main class="moving grazing" data-state={looked.wanted.value ? "planning" : stateOf(doc)}>
      <Head doc={doc} looked={looked} title={sheet?.title || t("grazing.title")} about={sheet?.motion ?? ""} />
      <Mistakes doc={doc} wrong={wrong} late={late} />
      {sheet && <Facts sheet={sheet} old={old} />}
      <div class="cols">
        <div class="stack">
          <ToolView looked={looked} isFixed={isFixed} dim={old}>
            {sheet && <Legend sheet={sheet} />}
          </ToolView>
        </div>
        <div class="stack">
          <Plane looked={looked} dim={old} />
          <ReadOut looked={looked} />
          {sheet && (
            <div class={old ? "older" : ""}>
              <MotionPanel doc={doc} looked={looked} sheet={sheet} isFixed={isFixed} />
            </div>
          )}
        </div>
        <div class="stack">{schema && <Settings doc={doc} verb="grazing" schema={schema} item={item} keys={["tool", "moment"]} />}</div>
      </div>
      {sheet && (
        <div class={`rows${old ? " older" : ""}`}>
          <Spans sheet={sheet} looked={looked} />
          <Loops sheet={sheet} />
        </div>
      )}
      {sheet && <Paper doc={doc} looked={looked} sheet={sheet} />}
      {sheet && <Notes notes={sheet.notes} findings={sheet.findings} />}
    </main>
  );
}

function Facts({ sheet, old }: { sheet: Sheet; old: boolean }) {
  const length = sheet.loops.reduce((sum, loop) => sum + loop.length, 0);
  const { area, entering_area, gained } = sheet.entering;
  const tori = sheet.pieces.filter((piece) => /torus|barrel/.test(piece.what));
  return (
    <dl class={`facts${old ? " older" : ""}`}>
      <div data-fact="curves">
        <dt>{t("grazing.fact.curves")}</dt>
        <dd translate={false}>{sheet.loops.length}          <small>{t("grazing.fact.folds", { n: sheet.folds.length })}</small>
        </dd>
      </div>
      <div data-fact="length">
        <dt>{t("grazing.fact.length")}</dt>
        <dd>
          <Name>{fixed(length, 3)} mm</Name>
        </dd>
      </div>
      {tori.map((piece) => (
        <div key={piece.what} data-fact="outcome" data-outcome-of={piece.what}>
          <dt>
            <Name>{piece.what}</Name>
          </dt>
          <dd>
            <Said text={piece.outcome ?? ""} />
                      <small>{t("grazing.fact.outcome")}</small>
          </dd>
        </div>
      ))}
      <div data-fact="enters">
        <dt>{t("grazing.fact.enters")}</dt>
        <dd>
          <Name>{area > 0 ? fixed((100 * entering_area) / area, 1) : "\u2013"} %</Name>
                  <small>
            <Name>
              {fixed(entering_area, 1)} / {fixed(area, 1)} mm²
            </Name>
          </small>
        </dd>
      </div>
      <div data-fact="volume">
        <dt>{t("grazing.fact.volume")}</dt>
        <dd>
          <Name>{fixed(gained / 1000, 2)} cm³/min</Name>
                  <small>{t("grazing.fact.all")}</small>
        </dd>
      </div>
    </dl>
  );
}

function Legend({ sheet }: { sheet: Sheet }) {
  const kinds = KINDS.filter((kind) => sheet.spans.some((span) => span.kind === kind));
  return (
    <div class="key">
      <span>
        <i class="face orange" />
        {t("grazing.enters")}
      </span>
      <span>
        <i class="face steel" />
        {t("grazing.leaves")}
      </span>
      {kinds.map((kind) => (
        <span key={kind}>
          <svg width="22" height="6" aria-hidden="true">
            <path class={`curve kind${KINDS.indexOf(kind)}`} d="M0 3h22" />
          </svg>
          {t(`grazing.kind.${kind}`)}
        </span>
      ))}
      {sheet.folds.length > 0 && (
        <span>
          <svg width="12" height="12" aria-hidden="true">
            <circle class="fold" cx="6" cy="6" r="4.5" />
          </svg>
          {t("grazing.fold")}
        </span>
      )}
      {sheet.whole.length + sheet.circles.length > 0 && (
        <span>
          <svg width="22" height="6" aria-hidden="true">
            <path class="whole" d="M0 3h22" />
          </svg>
          {t("grazing.whole")}
        </span>
      )}
      <span class="q">{t("grazing.hiddenDashed")}</span>
    </div>
  );
}
