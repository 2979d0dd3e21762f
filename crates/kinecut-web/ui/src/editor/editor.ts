// The editor of a text: one view, a state for each text, so that each has its own undo.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, redo, undo } from "@codemirror/commands";
import { bracketMatching } from "@codemirror/language";
import { highlightSelectionMatches, openSearchPanel, search, searchKeymap } from "@codemirror/search";
import { EditorSelection, EditorState, StateEffect, StateField, Transaction } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import type { Change } from "../toml/edit";
import { t } from "../words";
import { completion } from "./complete";
import { type Mistake, mistakes, setMistakes } from "./mistakes";
import { toml, tomlColours } from "./toml";
import type { Schema } from "../schema/schema";

const setSection = StateEffect.define<{ from: number; to: number } | null>();
/** The lines of the item that the form shows. */
const section = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(known, transaction) {
    let now = known.map(transaction.changes);
    for (const effect of transaction.effects) {
      if (!effect.is(setSection)) continue;
      now = Decoration.none;
      if (!effect.value) continue;
      const { doc } = transaction.state;
      const last = doc.lineAt(Math.min(effect.value.to, doc.length)).number;
      const lines = [];
      for (let n = doc.lineAt(Math.min(effect.value.from, doc.length)).number; n <= last; n++) lines.push(Decoration.line({ class: "in" }).range(doc.line(n).from));
      now = Decoration.set(lines);
    }
    return now;
  },
  provide: (field) => EditorView.decorations.from(field),
});

export interface Told {
  changed: (text: string) => void;
  /** The caret was moved by the user. */
  moved: (at: number) => void;
}

export class Editor {
  readonly view: EditorView;
  private readonly states = new Map<string, EditorState>();
  private shown: string | null = null;
  private told: Told = { changed: () => undefined, moved: () => undefined };

  constructor(
    parent: HTMLElement,
    private readonly schema: () => Schema | null,
    private readonly tools: () => { number: number; name: string }[],
  ) {
    // The state has the nonce, without which the first style would be refused.
    this.view = new EditorView({ parent, state: this.state("", "", false), dispatchTransactions: (all, view) => this.dispatched(all, view) });
  }

  private state(text: string, name: string, job: boolean): EditorState {
    const nonce = document.querySelector<HTMLMetaElement>('meta[name="kinecut-nonce"]')?.content ?? "";
    return EditorState.create({
      doc: text,
      extensions: [
        EditorView.cspNonce.of(nonce),
        lineNumbers(),
        highlightActiveLine(),
        history(),
        drawSelection(),
        bracketMatching(),
        closeBrackets(),
        search({ top: true }),
        highlightSelectionMatches(),
        ...(job ? [toml, tomlColours, autocompletion({ override: [completion(this.schema, this.tools)], icons: false })] : []),
        mistakes,
        section,
        EditorState.allowMultipleSelections.of(true),
        EditorView.contentAttributes.of({ "aria-label": t("text.name", { name }), translate: "no", tabindex: "0" }),
        keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...completionKeymap]),
      ],
    });
  }

  private dispatched(all: readonly Transaction[], view: EditorView): void {
    view.update(all);
    if (all.some((one) => one.docChanged)) this.told.changed(view.state.doc.toString());
    if (all.some((one) => one.isUserEvent("select") || one.isUserEvent("input") || one.isUserEvent("delete"))) this.told.moved(view.state.selection.main.head);
  }

  /** Shows a text; one that was shown before comes with its undo. */
  show(id: string, name: string, text: string, job: boolean, told: Told): void {
    this.told = told;
    if (this.shown === id) return;
    if (this.shown !== null) this.states.set(this.shown, this.view.state);
    this.shown = id;
    this.view.setState(this.states.get(id) ?? this.state(text, name, job));
  }

  forget(id: string): void {
    this.states.delete(id);
    if (this.shown === id) this.shown = null;
  }

  /** Changes the text as the user would: it can be undone. */
  apply(changes: Change[], event = "input.form"): void {
    this.view.dispatch({ changes, userEvent: event });
  }

  replace(text: string): void {
    const { doc } = this.view.state;
    if (doc.toString() !== text) this.view.dispatch({ changes: { from: 0, to: doc.length, insert: text }, userEvent: "input.replace" });
  }

  undo(): void {
    undo(this.view);
  }

  redo(): void {
    redo(this.view);
  }

  find(): void {
    openSearchPanel(this.view);
  }

  setMistakes(all: Mistake[]): void {
    this.view.dispatch({ effects: setMistakes.of(all), annotations: Transaction.addToHistory.of(false) });
  }

  setSection(range: { from: number; to: number } | null, scroll: boolean): void {
    const effects: StateEffect<unknown>[] = [setSection.of(range)];
    if (range && scroll) effects.push(EditorView.scrollIntoView(Math.min(range.from, this.view.state.doc.length), { y: "start", yMargin: 20 }));
    this.view.dispatch({ effects });
  }

  /** Puts the caret on a stretch, in sight. */
  select(from: number, to: number): void {
    const length = this.view.state.doc.length;
    const range = EditorSelection.range(Math.min(from, length), Math.min(to, length));
    this.view.dispatch({ selection: EditorSelection.create([range]), effects: EditorView.scrollIntoView(range, { y: "center" }) });
    this.view.focus();
  }
}
