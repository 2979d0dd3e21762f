// One face: its text, the placement under the hand, and what the verb says of both. Every number that is shown as a result is the verb's.
import { batch, computed, effect, signal } from "@preact/signals";
import * as api from "../../base/api";
import { counted, later } from "../../base/open";
import { type FaceAnswer, type Optimum, type Placement, type Step, isOptimum } from "./answer";
import { History } from "./history";
import { type Map, cellsOf } from "./map";
import { atPlace, forLeast, given, placedAt, placementOf, sector, valueOf } from "./question";
import { middle, round360 } from "./shape";
import { type View, WHOLE } from "./view";

/** A placement as the window has it: the part's turn [deg], and the cutter's centre line beside the middle of its width [mm]. */
export interface Hand {
  turn: number;
  beside: number;
}

/** The answer for a placement. */
export interface Placed {
  hand: Hand;
  text: string;
  answer: FaceAnswer | null;
  /** The reason why there is no answer. */
  wrong: api.Finding | null;
  /** From the question to the answer [ms]. */
  ms: number;
}

/** A walk of the paper's method, as far as it has come. */
export interface Walk {
  text: string;
  start: Hand;
  /** Its triangles so far. */
  steps: Step[];
  state: "walks" | "ended" | "stopped";
}

/** A sector of turns, with the certificate of its own; `optimum` null: no placement of it is allowed. */
export interface Sector {
  from: number;
  to: number;
  optimum: Optimum | null;
}

/** Sectors of the turn that were searched one after another. */
export interface Sectors {
  text: string;
  parts: Sector[];
  state: "searches" | "ended" | "stopped";
}

/** Number of sectors of a turn. */
export const SECTORS = 24;

/** An answer that is older than this has its place said [ms]. */
const LATE = 100;
/** A walk is shown at a step for so long [ms]. */
const STRIDE = 30;
/** Work that takes longer than a moment is asked for when the text has rested for so long [ms]. */
const REST = 200;

function isAnswer(told: FaceAnswer | api.Finding): told is FaceAnswer {
  return "outline" in told;
}

/** Questions of one kind: one at a time, the newest next. */
class Line {
  private generation = 0;
  private control: AbortController | null = null;

  constructor(
    private readonly face: Face,
    private readonly name: string,
  ) {}

  async ask(text: string, flags: { compare?: boolean; paper?: boolean; map?: boolean; walk?: boolean } = {}): Promise<FaceAnswer | api.Finding | null> {
    const [question, signal] = this.next(text);
    const told = await api.verb<FaceAnswer>("face", { ...question, ...flags }, signal);
    return signal.aborted || (!isAnswer(told) && told.code === "KC0009") ? null : told;
  }

  stop(): void {
    this.control?.abort();
  }

  private next(text: string): [api.VerbQuestion, AbortSignal] {
    this.control?.abort();
    const control = (this.control = new AbortController());
    return [{ generation: ++this.generation, new: `face-${this.name}.toml`, beside: this.face.beside, text }, control.signal];
  }
}

export class Face {
  readonly text = signal("");
  readonly saved = signal<{ text: string; sha256: string | null }>({ text: "", sha256: null });
  readonly dirty = computed(() => this.text.value !== this.saved.value.text);

  readonly hand = signal<Hand | null>(null);
  /** Shift along the feed [mm]: of the picture alone, it changes no exit. */
  readonly along = signal(0);
  /** What is seen of the picture. */
  readonly view = signal<View>(WHOLE);
  readonly history = new History();
  readonly placed = signal<Placed | null>(null);
  readonly late = signal(false);
  /** From the move of the hand to the exits on the screen [ms]. */
  readonly drawnIn = signal<number | null>(null);

  /** The least placement with its certificate. */
  readonly least = signal<{ text: string; answer: FaceAnswer } | null>(null);
  readonly leastWrong = signal<api.Finding | null>(null);
  readonly searching = signal(false);
  readonly stopped = signal(false);
  /** Other ways and the paper's method. */
  readonly ways = signal<{ text: string; answer: FaceAnswer } | null>(null);
  readonly map = signal<{ text: string; map: Map } | null>(null);
  readonly comparing = signal(false);
  readonly refused = signal<string | null>(null);
  /** The label of edges that was clicked. */
  readonly label = signal<string | null>(null);
  /** Whether starts and ends of the paper's method are on the graph. */
  readonly showPaper = signal(false);
  /** The placement under the pointer on the graph. */
  readonly under = signal<Placed | null>(null);

  readonly walk = signal<Walk | null>(null);
  readonly sectors = signal<Sectors | null>(null);

  readonly outline = computed(() => this.least.value?.answer.outline ?? null);
  readonly optimum = computed(() => {
    const optimum = this.least.value?.answer.optimum;
    return optimum && isOptimum(optimum) ? optimum : null;
  });

  private readonly lines = { live: new Line(this, "live"), least: new Line(this, "least"), ways: new Line(this, "ways"), map: new Line(this, "map"), under: new Line(this, "under"), walk: new Line(this, "walk"), sector: new Line(this, "sector") };
  private asking = false;
  private movedAt = 0;
  /** Gives up what has not begun. */
  private forget = () => {};
  private lateTimer = 0;
  private wanted: Hand | null = null;
  private asksUnder = false;
  /** Walks that were begun: the last one alone is shown. */
  private walks = 0;

  constructor(
    /** The file of the question; null while it is not on disk. */
    public id: string | null,
    readonly name: string,
    /** A file in whose folder the question lies. */
    readonly beside: string,
  ) {}

  private readonly noted = effect(() => {
    const [text, hand] = [this.text.value, this.hand.value];
    if (hand) this.history.note({ text, hand });
  });

  /** Takes back the last change of text or placement, or does it again. */
  back(by: -1 | 1): void {
    const moment = this.history.go(by);
    if (!moment) return;
    batch(() => {
      this.edited(moment.text);
      this.move(moment.hand);
    });
  }

  /** A text, at first or after a change. */
  edited(text: string): void {
    if (this.text.value === text && this.least.value) return;
    this.text.value = text;
    this.begun();
  }

  /** Asks all of it again: a file that the text names may be another one. */
  again(): void {
    this.walks++;
    batch(() => {
      this.placed.value = null;
      this.map.value = null;
      this.ways.value = null;
      this.sectors.value = null;
      this.walk.value = null;
    });
    this.begun();
  }

  private begun(): void {
    this.forget();
    this.lines.ways.stop();
    this.lines.map.stop();
    void counted(this.searched()).then((found) => {
      if (found) this.forget = later(REST, () => this.compared());
    });
  }

  /** Searches the least placement of the text as it is. True when it has come. */
  async searched(): Promise<boolean> {
    const text = this.text.value;
    batch(() => {
      this.searching.value = true;
      this.stopped.value = false;
    });
    try {
      const told = await this.lines.least.ask(forLeast(text));
      if (told === null || text !== this.text.value) return false;
      batch(() => {
        this.searching.value = false;
        this.refused.value = null;
        this.leastWrong.value = isAnswer(told) ? null : told;
        if (isAnswer(told)) this.least.value = { text, answer: told };
      });
      if (!isAnswer(told)) return false;
      if (!this.hand.value) this.hand.value = this.begin(told);
      this.movedAt = performance.now();
      void counted(this.pump());
      return true;
    } catch (error) {
      this.failed(error);
      return false;
    }
  }

  stopSearch(): void {
    this.lines.least.stop();
    batch(() => {
      this.searching.value = false;
      this.stopped.value = true;
    });
  }

  /** The graph of all placements, other ways, and the paper's method. */
  private async compared(): Promise<void> {
    const text = this.text.value;
    const old = () => text !== this.text.value;
    this.comparing.value = true;
    try {
      const mapped = await this.lines.map.ask(forLeast(text), { map: true });
      if (mapped === null || old()) return;
      const map = isAnswer(mapped) && mapped.map ? cellsOf(mapped.map) : null;
      this.map.value = map && { text, map };
      const told = await this.lines.ways.ask(forLeast(text), { compare: true, paper: true });
      if (told === null || old()) return;
      if (isAnswer(told)) this.ways.value = { text, answer: told };
    } catch (error) {
      if (!old()) this.failed(error);
    } finally {
      if (!old()) this.comparing.value = false;
    }
  }

  /** The placement that the text gives, or the part as drawn, or the least one where that does not fit. */
  private begin(answer: FaceAnswer): Hand {
    const asked = placementOf(this.text.value);
    if (asked) return { turn: asked.angle, beside: asked.offset === null ? 0 : asked.offset - middle(answer.outline, asked.angle) };
    if (!answer.as_drawn && isOptimum(answer.optimum)) return this.handOf(answer.optimum.placement);
    return { turn: 0, beside: 0 };
  }

  handOf(p: Placement): Hand {
    const { outline } = this;
    return { turn: p.turn, beside: outline.value ? p.offset - middle(outline.value, p.turn) : 0 };
  }

  /** Puts the part elsewhere at once: a change of its own. */
  go(hand: Hand): void {
    this.history.rest();
    this.move(hand);
    this.history.rest();
  }

  /** Puts the part elsewhere. */
  move(hand: Hand): void {
    this.hand.value = { turn: round360(hand.turn), beside: hand.beside };
    this.movedAt = performance.now();
    void counted(this.pump());
  }

  /** Asks for the exits of the newest placement, one question at a time. */
  private async pump(): Promise<void> {
    const { outline } = this;
    if (this.asking || !outline.value) return;
    for (;;) {
      const hand = this.hand.value;
      const text = this.text.value;
      const known = this.placed.value;
      if (!hand || (known && known.hand === hand && known.text === text)) break;
      if (!this.lateTimer) this.lateTimer = window.setTimeout(() => (this.late.value = true), LATE);
      this.asking = true;
      const from = performance.now();
      const moved = this.movedAt;
      try {
        const told = await this.lines.live.ask(atPlace(text, hand.turn, middle(outline.value, hand.turn) + hand.beside));
        if (told === null) continue;
        const newest = this.hand.value === hand && this.text.value === text;
        batch(() => {
          this.refused.value = null;
          this.placed.value = { hand, text, answer: isAnswer(told) ? told : null, wrong: isAnswer(told) ? null : told, ms: performance.now() - from };
          // While the hand moves on, each answer that comes in time keeps the picture fresh.
          this.late.value = !newest && performance.now() - from > LATE;
          clearTimeout(this.lateTimer);
          this.lateTimer = 0;
        });
        if (newest) this.whenDrawn(moved);
      } catch (error) {
        this.failed(error);
        break;
      } finally {
        this.asking = false;
      }
    }
  }

  private whenDrawn(from: number): void {
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        this.drawnIn.value = performance.now() - from;
        const { dataset } = document.documentElement;
        dataset.face = String(Number(dataset.face ?? 0) + 1);
        dataset.faceMs = String(this.drawnIn.value);
        dataset.faceAsked = String(this.placed.value?.ms ?? "");
      }),
    );
  }

  /** Asks what lies under the pointer; null: it has left. */
  async pointed(hand: Hand | null): Promise<void> {
    this.wanted = hand;
    if (!hand) this.under.value = null;
    if (this.asksUnder) return;
    while (this.wanted && this.outline.value) {
      const at = this.wanted;
      const text = this.text.value;
      const from = performance.now();
      this.asksUnder = true;
      try {
        const told = await this.lines.under.ask(atPlace(text, at.turn, middle(this.outline.value, at.turn) + at.beside));
        if (told && this.wanted) this.under.value = { hand: at, text, answer: isAnswer(told) ? told : null, wrong: isAnswer(told) ? null : told, ms: performance.now() - from };
      } catch (error) {
        this.failed(error);
        break;
      } finally {
        this.asksUnder = false;
      }
      if (this.wanted === at) break;
    }
  }

  /**
   * Walks by the paper's method from the placement under the hand: the verb tells all steps at once, they are shown one by one. The method
   * keeps to the turns that its text allows, so that its question leaves out none.
   */
  async walkFrom(): Promise<void> {
    const hand = this.hand.value;
    const answer = this.least.value?.answer;
    const text = this.text.value;
    if (!hand || !answer || this.least.value?.text !== text) return;
    const own = ++this.walks;
    const old = () => own !== this.walks || this.text.value !== text;
    this.walk.value = null;
    try {
      const told = await this.lines.walk.ask(placedAt(text, hand.turn, middle(answer.outline, hand.turn) + hand.beside), { walk: true });
      if (told === null || old()) return;
      if (!isAnswer(told)) throw new Error(told.message);
      const { steps, start } = told.walk ?? { steps: [], start: null };
      if (!start || steps.length === 0) return;
      const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
      for (let n = still ? steps.length : 1; n <= steps.length; n++) {
        if (n > 1 && !still) await new Promise((done) => setTimeout(done, STRIDE));
        if (old() || this.walk.peek()?.state === "stopped") return;
        this.walk.value = { text, start: this.handOf(start), steps: steps.slice(0, n), state: n < steps.length ? "walks" : "ended" };
      }
    } catch (error) {
      if (!old()) this.failed(error);
    }
  }

  /** Searches the turn sector by sector, so that the certificate is seen to come. */
  async find(): Promise<void> {
    const text = this.text.value;
    const parts: Sector[] = [];
    const put = (state: Sectors["state"]) => (this.sectors.value = { text, parts: [...parts], state });
    put("searches");
    try {
      for (let i = 0; i < SECTORS; i++) {
        const [from, to] = [(360 * i) / SECTORS, (360 * (i + 1)) / SECTORS];
        const told = await this.lines.sector.ask(sector(given(forLeast(text), ["operation", "passes"], "one"), from, to));
        if (told === null || this.text.value !== text) {
          put("stopped");
          return;
        }
        const found = isAnswer(told) && isOptimum(told.optimum) ? told.optimum : null;
        // No placement of the sector is allowed; any other reason ends the search.
        if (!found && !(!isAnswer(told) && told.code === "KC1002")) throw new Error(isAnswer(told) ? text : told.message);
        parts.push({ from, to, optimum: found });
        put(i + 1 < SECTORS ? "searches" : "ended");
      }
    } catch (error) {
      put("stopped");
      this.failed(error);
    }
  }

  stopFinding(): void {
    this.lines.sector.stop();
    const now = this.sectors.value;
    if (now?.state === "searches") this.sectors.value = { ...now, state: "stopped" };
  }

  stopWalk(): void {
    if (this.walk.value) this.walk.value = { ...this.walk.value, state: "stopped" };
    this.lines.walk.stop();
  }

  close(): void {
    this.forget();
    clearTimeout(this.lateTimer);
    this.noted();
    for (const line of Object.values(this.lines)) line.stop();
  }

  private failed(error: unknown): void {
    if (error instanceof DOMException && error.name === "AbortError") return;
    batch(() => {
      this.searching.value = false;
      this.refused.value = error instanceof Error ? error.message : String(error);
    });
  }

  /** Labels of the edges, with their length and weight. */
  readonly labels = computed(() => {
    const all = new globalThis.Map<string, { length: number; weight: number; count: number }>();
    for (const { label, length, weight } of this.outline.value?.edges ?? []) {
      if (label === null) continue;
      const known = all.get(label) ?? { length: 0, weight, count: 0 };
      all.set(label, { length: known.length + length, weight, count: known.count + 1 });
    }
    return [...all].map(([label, of]) => ({ label, ...of }));
  });

  /** A number of the text. */
  number(path: (string | number)[]): number | null {
    const value = valueOf(this.text.value, path);
    return typeof value === "number" ? value : null;
  }
}
