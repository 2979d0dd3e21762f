// Findings in the text: a wave under the value, and their sentence below the line.
import { RangeSet, StateEffect, StateField } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, WidgetType } from "@codemirror/view";

export interface Mistake {
  from: number;
  to: number;
  severity: string;
  text: string;
}

class Lens extends WidgetType {
  constructor(
    readonly text: string,
    readonly severity: string,
  ) {
    super();
  }

  override eq(other: Lens): boolean {
    return other.text === this.text && other.severity === this.severity;
  }

  override toDOM(): HTMLElement {
    const lens = document.createElement("div");
    lens.className = `lens ${this.severity}`;
    lens.lang = "en";
    lens.textContent = this.text;
    return lens;
  }
}

export const setMistakes = StateEffect.define<Mistake[]>();

export const mistakes = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(known, transaction) {
    let now = known.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (effect.is(setMistakes)) now = decorated(transaction.state.doc.length, effect.value, (at) => transaction.state.doc.lineAt(at).to);
    }
    return now;
  },
  provide: (field) => EditorView.decorations.from(field),
});

function decorated(length: number, all: Mistake[], lineEnd: (at: number) => number): DecorationSet {
  const inside = all.map((m) => ({ ...m, from: Math.min(m.from, length), to: Math.min(m.to, length) }));
  const marks = inside.filter((m) => m.to > m.from).map((m) => Decoration.mark({ class: `wave ${m.severity}` }).range(m.from, m.to));
  const lenses = inside.map((m) => Decoration.widget({ widget: new Lens(m.text, m.severity), block: true, side: 1 }).range(lineEnd(m.to)));
  return RangeSet.of([...marks, ...lenses], true);
}
