// The same hole in other ways: other strategies for roughing, other contacts for the lead-in. Each is an answer of the verb to the text with
// that one word changed.
import { effect, signal } from "@preact/signals";
import * as api from "../../base/api";
import { later } from "../../base/open";
import { tell } from "../../store/session";
import { type Pass, type Plan, planOf } from "./answer";
import { CONTACTS, STRATEGIES, withContact, withStrategy } from "./question";
import type { PassName, State } from "./state";

/** The others are asked for when the answer has rested for so long [ms]. */
const REST = 360;

/** Code of a finding: a newer question came before the answer. */
const CANCELLED = "KC0009";

export interface Other {
  id: string;
  /** Its pass; null where it is not possible. */
  pass: Pass | null;
  /** Why it is not possible: a sentence of the library. */
  why: string | null;
  /** The text that it is of. */
  text: string;
}

export function idsOf(pass: PassName): readonly string[] {
  return pass === "rough" ? STRATEGIES : CONTACTS;
}

export class Others {
  /** Those that are laid over plan and charts. */
  readonly shown = signal<ReadonlySet<string>>(new Set());
  readonly known = signal<ReadonlyMap<string, Other>>(new Map());
  readonly asking = signal(false);
  private control = new AbortController();
  private generation = 0;

  constructor(private readonly state: State) {}

  /** Asks after each answer, until it is ended. */
  follow(): () => void {
    let forget = () => {};
    const end = effect(() => {
      const { doc } = this.state;
      const text = doc.answered.value?.text;
      // To be asked again when another pass is looked at.
      void this.state.wished.value;
      forget();
      this.control.abort();
      if (text === undefined) return;
      forget = later(REST, () => this.ask(text));
    });
    return () => {
      forget();
      this.control.abort();
      end();
    };
  }

  toggle(id: string): void {
    const next = new Set(this.shown.value);
    if (!next.delete(id)) next.add(id);
    this.shown.value = next;
  }

  /** Those of a pass that are laid over and known. */
  ghosts(pass: PassName): { other: Other; run: NonNullable<Pass["run"]>; index: number; isOld: boolean }[] {
    const text = this.state.doc.answered.value?.text;
    return idsOf(pass).flatMap((id, index) => {
      const other = this.known.value.get(id);
      const run = other?.pass?.run;
      return other && run && this.shown.value.has(id) ? [{ other, run, index, isOld: other.text !== text }] : [];
    });
  }

  private async ask(text: string): Promise<void> {
    const { doc, wished } = this.state;
    const pass = wished.value;
    const { signal: stop } = (this.control = new AbortController());
    // Those that are looked at come first.
    const ids = [...idsOf(pass)].sort((a, b) => Number(this.shown.value.has(b)) - Number(this.shown.value.has(a)));
    this.asking.value = true;
    try {
      for (const id of ids) {
        if (this.known.value.get(id)?.text === text) continue;
        const own = pass === "rough" ? withStrategy(text, id as (typeof STRATEGIES)[number]) : withContact(text, id as (typeof CONTACTS)[number]);
        // A name of its own: requests of one name follow one another.
        const question = { generation: ++this.generation, new: `${doc.name.replaceAll("/", "-")}-${id}.toml`, text: own, samples: pass };
        const answer = await api.verb<Plan>("hole", question, stop);
        if (stop.aborted || (answer as api.Finding).code === CANCELLED) return;
        const plan = planOf(answer);
        const found = plan?.passes.find((p) => p.pass === pass) ?? null;
        const why = plan ? null : ((answer as api.Finding).message ?? null);
        this.known.value = new Map(this.known.value).set(id, { id, pass: found, why, text });
      }
    } catch (error) {
      if (error instanceof api.Refused) tell(error.message);
      // That the server is gone is told by the hole itself.
      else if (!stop.aborted && !(error instanceof api.Gone)) throw error;
    } finally {
      if (!stop.aborted) this.asking.value = false;
    }
  }
}
