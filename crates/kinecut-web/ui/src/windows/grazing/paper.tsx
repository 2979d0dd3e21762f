// Statements of the paper on these elements, beside what the closed form gives: the library's own gallery, each case of which can be laid into the
// window.
import { useSignal } from "@preact/signals";
import { Name, Said } from "../../app/verbatim";
import * as api from "../../base/api";
import type { Document } from "../../store/document";
import { edited, tell } from "../../store/session";
import { t } from "../../words";
import { contourOf, given, rounded, withTool, withTwist } from "./question";
import type { Sheet } from "./sheet";
import type { Looked } from "./state";

interface Group {
  title: string;
  claims: { says: string; found: string; verdict: "right" | "corrected" | "not needed" }[];
  cases: { name: string; found: string; sheet: Sheet }[];
}

let known: Promise<Group[]> | null = null;

async function gallery(): Promise<Group[]> {
  const told = await api.verb<Group[]>("grazing", { generation: 0, new: "gallery.toml", text: "", gallery: true }, new AbortController().signal);
  if (!Array.isArray(told)) throw new Error(told.message);
  return told;
}

/** Elements of a group of statements by the words of pieces. */
const ABOUT: [RegExp, RegExp][] = [
  [/^Cone/, /cone|cylinder/],
  [/outwards/, /torus outward|barrel/],
  [/inwards/, /torus inward/],
  [/^Sphere/, /sphere/],
  [/^Disc/, /disc/],
];

export function Paper({ doc, looked, sheet }: { doc: Document; looked: Looked; sheet: Sheet }) {
  const groups = useSignal<Group[] | null>(null);
  const open = () => {
    known ??= gallery();
    known.then((all) => (groups.value = all)).catch((error: unknown) => {
      known = null;
      tell(error instanceof Error ? error.message : String(error));
    });
  };
  const take = (name: string, of: Sheet) => {
    const item = looked.item.peek();
    const text = given(withTool(doc.text.peek(), item, contourOf(of.pieces)), [...item, "title"], name);
    looked.scale.value = 0;
    // A case is slow: twenty times as fast its curve is the same.
    const faster = (v: number[]) => rounded(v.map((c) => 20 * c) as [number, number, number]);
    edited(doc, withTwist(text, item, { velocity: faster(of.twist.velocity), turn: faster(of.twist.turn) }));
  };
  const words = sheet.pieces.map((piece) => piece.what).join(" ");
  const concerns = (title: string) => ABOUT.find(([group]) => group.test(title))?.[1].test(words) ?? true;
  return (
    <details class="panel paper" onToggle={(e) => e.currentTarget.open && open()} data-panel="paper">
      <summary>{t("grazing.paper")}</summary>
      {!groups.value && <p class="pad q">{t("grazing.paperComes")}</p>}
      {groups.value?.map((group) => (
        <section key={group.title} class={`pad${concerns(group.title) ? "" : " other"}`}>
          <h3 lang="en" translate={false}>
            {group.title}
          </h3>
          {group.claims.map((claim) => (
            <p key={claim.says}>
              <q lang="en" translate={false}>
                {claim.says}
              </q>{" "}
              <b class="tag note">{t(`grazing.verdict.${claim.verdict}`)}</b> <Said text={claim.found} />
            </p>
          ))}
          <div class="cases">
            {group.cases.map((one) => (
              <button key={one.name} title={t("grazing.takeCase")} onClick={() => take(one.name, one.sheet)} data-case={one.name}>
                <Name>{one.name}</Name>
              </button>
            ))}
          </div>
        </section>
      ))}
    </details>
  );
}
