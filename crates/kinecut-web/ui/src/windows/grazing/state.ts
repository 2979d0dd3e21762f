// Memory of a window of a moving tool beside its text: which question of a list, the place that is looked at, the motion under the hand.
import { computed, effect, signal } from "@preact/signals";
import type { Document } from "../../store/document";
import { edited } from "../../store/session";
import type { Path } from "../../toml/parse";
import { type Twist, type Verb, itemsOf, rounded, twistOf, withTwist } from "./question";
import { type Growth, type Sheet, type Vec, answersOf, entersAt, isGrowth, isSheet, placeOf } from "./sheet";

/** A place of the tool's surface. */
export interface Spot {
  piece: number;
  u: number;
  theta: number;
  point: Vec;
  enters: boolean;
  /** The curve and its point, where it lies on one. */
  on: { loop: number; index: number } | null;
}

/** Velocities of both ends of the axis [mm/min], as a hand has moved them. */
export interface Hand {
  tip: Vec;
  top: Vec;
}

/** Share of the tool's size that the longest arrow has. */
const ARROW = 0.45;
/** Shares between which an arrow keeps its scale. */
const [LEAST, MOST] = [0.16, 0.62];

export class Looked {
  private static readonly all = new WeakMap<Document, Looked>();

  static of(doc: Document, verb: Verb): Looked {
    let known = Looked.all.get(doc);
    if (!known) Looked.all.set(doc, (known = new Looked(doc, verb)));
    return known;
  }

  /** The question of a list that is shown. */
  readonly chosen = signal(0);
  readonly items = computed(() => itemsOf(this.verb, this.doc.values.value));
  readonly item = computed<Path>(() => this.items.value[Math.min(this.chosen.value, this.items.value.length - 1)] ?? []);
  readonly answer = computed(() => {
    const answered = this.doc.answered.value;
    return answered ? answersOf<Sheet | Growth>(answered.answer)[Math.min(this.chosen.value, this.items.value.length - 1)] : undefined;
  });
  /** The curve at the moment of a move that is looked at. */
  readonly moment = signal<Sheet | null>(null);
  /** The last curve that is known of this question. */
  readonly sheet = computed(() => {
    if (this.verb === "envelope") return this.moment.value;
    const answer = this.answer.value;
    return isSheet(answer as Sheet) ? (answer as Sheet) : null;
  });
  readonly growth = computed(() => {
    const answer = this.answer.value;
    return isGrowth(answer as Growth) ? (answer as Growth) : null;
  });

  readonly spot = signal<Spot | null>(null);
  readonly span = signal<number | null>(null);
  readonly hand = signal<Hand | null>(null);
  /** Length of an arrow by its velocity [mm to mm/min]. */
  readonly scale = signal(0);
  /** The motion that is to be asked about next. */
  readonly wanted = signal<Twist | null>(null);

  private constructor(
    readonly doc: Document,
    private readonly verb: Verb,
  ) {
    effect(() => {
      if (!doc.planning.value) this.pump();
    });
    // A text that changes by itself takes the motion out of the hand.
    effect(() => {
      void doc.answered.value;
      if (!this.holding && this.wanted.peek() === null) this.hand.value = null;
    });
  }

  holding = false;
  private size = 0;

  /** Both ends as they are shown: under the hand, or as they are known. */
  ends(sheet: Sheet): Hand {
    return this.hand.value ?? { tip: sheet.ends[0].velocity, top: sheet.ends[1].velocity };
  }

  /** Arrows keep their scale until one of them becomes far too long or too short. */
  fit(sheet: Sheet, size: number): number {
    this.size = size;
    const most = Math.max(...sheet.ends.map((end) => Math.hypot(...end.velocity)));
    const share = (most * this.scale.peek()) / size;
    if (most > 0 && !this.holding && !(share > LEAST && share < MOST)) this.scale.value = (ARROW * size) / most;
    return this.scale.value;
  }

  /** Takes an end of the axis to another velocity; `both`: the other end goes with it, so that the turn stays. */
  drag(sheet: Sheet, which: "tip" | "top", to: Vec, both: boolean): void {
    const now = this.ends(sheet);
    const by = to.map((c, k) => c - now[which][k]);
    const moved = (v: Vec) => v.map((c, k) => c + by[k]) as Vec;
    const next: Hand = both ? { tip: moved(now.tip), top: moved(now.top) } : { ...now, [which]: to };
    // Along a rigid axis there is one velocity.
    const other = which === "tip" ? "top" : "tip";
    next[other] = [next[other][0], next[other][1], to[2]];
    this.hand.value = next;
    const twist = twistOf(next.tip, next.top, [sheet.ends[0].z, sheet.ends[1].z], sheet.twist.turn[2], which);
    this.wanted.value = { velocity: rounded(twist.velocity), turn: rounded(twist.turn) };
    this.pump();
  }

  released(): void {
    this.holding = false;
    const sheet = this.sheet.peek();
    if (sheet) this.fit(sheet, this.size);
    if (this.wanted.peek() === null && !this.doc.planning.peek()) this.hand.value = null;
  }

  /** Writes the newest motion when the one before has its answer: so the curve follows a hand that does not rest. */
  private pump(): void {
    const { doc } = this;
    const wanted = this.wanted.peek();
    if (!wanted || doc.planning.peek()) return;
    this.wanted.value = null;
    edited(doc, withTwist(doc.text.peek(), this.item.peek(), wanted));
  }

  /** Looks at a place by its piece, parameter and angle. */
  lookAt(piece: number, u: number, theta: number, on: Spot["on"] = null): void {
    const sheet = this.sheet.peek();
    if (!sheet?.pieces[piece]) {
      this.spot.value = null;
      return;
    }
    const [r, z] = placeOf(sheet.pieces[piece], u);
    const angle = (theta * Math.PI) / 180;
    this.spot.value = { piece, u, theta: ((theta % 360) + 360) % 360, point: [r * Math.cos(angle), r * Math.sin(angle), z], enters: entersAt(sheet, piece, u, theta), on };
  }

  lookAtCurve(loop: number, index: number): void {
    const p = this.sheet.peek()?.loops[loop]?.points[index];
    if (p) this.spot.value = { piece: p.piece, u: p.u, theta: p.theta, point: p.point, enters: false, on: { loop, index } };
  }
}
