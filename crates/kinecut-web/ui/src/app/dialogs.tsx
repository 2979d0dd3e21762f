// Dialogs: keys, all commands, go to a place, both texts.
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Document } from "../store/document";
import { active } from "../store/session";
import { goLine, goTime } from "../windows/job/player";
import { t } from "../words";
import { commands, dialog, letters, setLetters } from "./commands";

function Dialog({ title, wide = false, children }: { title: string; wide?: boolean; children: ComponentChildren }) {
  const box = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const element = box.current as HTMLDialogElement;
    element.showModal();
    return () => element.close();
  }, []);
  return (
    <dialog ref={box} class={wide ? "wide" : ""} aria-label={title} onClose={() => (dialog.value = null)} onClick={(e) => e.target === e.currentTarget && (dialog.value = null)}>
      <h2>{title}</h2>
      {children}
    </dialog>
  );
}

export function Dialogs() {
  const doc = active.value;
  switch (dialog.value) {
    case "keys":
      return <Keys />;
    case "commands":
      return <Commands />;
    case "go":
      return <Go />;
    case "both":
      return doc?.conflict.value ? <Both doc={doc} /> : null;
    default:
      return null;
  }
}

function Keys() {
  return (
    <Dialog title={t("keys.title")}>
      <dl>
        {commands().filter((c) => c.keys.length > 0).map((c) => [
          <dt key={c.id} translate={false}>
            {c.keys.map((key) => (
              <kbd key={key}>{key}</kbd>
            ))}
          </dt>,
          <dd key={`${c.id}-d`}>{t(c.id)}</dd>,
        ])}
        <dt translate={false}>
          <kbd>←↑→↓</kbd>
        </dt>
        <dd>{t("command.turn")}</dd>
      </dl>
      <p class="foot">
        <label class="box">
          <input type="checkbox" checked={letters.value} onChange={(e) => setLetters(e.currentTarget.checked)} /> {t("keys.letters")}
        </label>
        <span class="sp" />
        <button onClick={() => (dialog.value = null)}>{t("keys.close")}</button>
      </p>
    </Dialog>
  );
}

function Commands() {
  const text = useSignal("");
  const at = useSignal(0);
  const all = commands().filter((c) => t(c.id).toLowerCase().includes(text.value.toLowerCase()));
  const run = (i: number) => {
    dialog.value = null;
    all[i]?.run();
  };
  return (
    <Dialog title={t("command.title")}>
      <input
        aria-label={t("command.find")}
        role="combobox"
        aria-expanded={true}
        aria-controls="commands"
        aria-activedescendant={all[at.value] ? `command-${at.value}` : undefined}
        autocomplete="off"
        value={text.value}
        onInput={(e) => {
          text.value = e.currentTarget.value;
          at.value = 0;
        }}
        onKeyDown={(e) => {
          if (e.key === "Enter") run(at.value);
          else if (e.key === "ArrowDown") at.value = Math.min(all.length - 1, at.value + 1);
          else if (e.key === "ArrowUp") at.value = Math.max(0, at.value - 1);
          else return;
          e.preventDefault();
        }}
      />
      <div class="list" id="commands" role="listbox" aria-label={t("command.title")}>
        {all.map((c, i) => (
          <button key={c.id} id={`command-${i}`} role="option" aria-selected={i === at.value} tabIndex={-1} onClick={() => run(i)}>
            <span>{t(c.id)}</span>
            <span translate={false}>
              {c.keys.slice(0, 1).map((key) => (
                <kbd key={key}>{key}</kbd>
              ))}
            </span>
          </button>
        ))}
      </div>
    </Dialog>
  );
}

function Go() {
  const text = useSignal("");
  const go = () => {
    const time = /^(?:(\d+):)?(\d+):(\d+(?:\.\d+)?)$/.exec(text.value.trim());
    const line = /^\d+$/.exec(text.value.trim());
    dialog.value = null;
    if (time) goTime(Number(time[1] ?? 0) * 3600 + Number(time[2]) * 60 + Number(time[3]), "link");
    else if (line) goLine(Number(line[0]) - 1);
  };
  return (
    <Dialog title={t("command.go")}>
      <form
        onSubmit={(e) => {
          e.preventDefault();
          go();
        }}
      >
        <label>
          {t("command.goWhat")}
          <input autocomplete="off" inputMode="numeric" value={text.value} onInput={(e) => (text.value = e.currentTarget.value)} />
        </label>
        <p class="foot">
          <span class="sp" />
          <button class="primary">{t("command.goDo")}</button>
        </p>
      </form>
    </Dialog>
  );
}

/** Both texts side by side, with the lines marked that the other has not. */
function Both({ doc }: { doc: Document }) {
  const theirs = doc.conflict.value?.text ?? "";
  const mine = doc.text.value;
  const [a, b] = [mine.split("\n"), theirs.split("\n")];
  const [left, right] = common(a, b);
  const lines = (all: string[], same: Set<number>) => (
    <pre tabIndex={0} translate={false}>
      {all.map((line, i) => (
        <div key={i} class={same.has(i) ? undefined : "differs"}>
          {line}
        </div>
      ))}
    </pre>
  );
  return (
    <Dialog title={t("conflict.sentence", { name: doc.name })} wide>
      <div class="both">
        <section aria-label={t("conflict.mineHead")}>
          <h3>{t("conflict.mineHead")}</h3>
          {lines(a, left)}
        </section>
        <section aria-label={t("conflict.theirsHead")}>
          <h3>{t("conflict.theirsHead")}</h3>
          {lines(b, right)}
        </section>
      </div>
      <p class="foot">
        <span class="q">{t("conflict.same")}</span>
        <span class="sp" />
        <button onClick={() => (dialog.value = null)}>{t("keys.close")}</button>
      </p>
    </Dialog>
  );
}

/** Most lines that are compared by the longest common run of lines. */
const COMPARED = 3000;

/** The lines that two texts have in common, in order. */
function common(a: string[], b: string[]): [Set<number>, Set<number>] {
  const [left, right] = [new Set<number>(), new Set<number>()];
  let [from, endA, endB] = [0, a.length, b.length];
  while (from < endA && from < endB && a[from] === b[from]) {
    left.add(from);
    right.add(from++);
  }
  while (endA > from && endB > from && a[endA - 1] === b[endB - 1]) {
    left.add(--endA);
    right.add(--endB);
  }
  const [n, m] = [endA - from, endB - from];
  if (n > COMPARED || m > COMPARED) return [left, right];
  const longest = Array.from({ length: n + 1 }, () => new Uint16Array(m + 1));
  for (let i = n - 1; i >= 0; i--) {
    for (let j = m - 1; j >= 0; j--) longest[i][j] = a[from + i] === b[from + j] ? longest[i + 1][j + 1] + 1 : Math.max(longest[i + 1][j], longest[i][j + 1]);
  }
  for (let i = 0, j = 0; i < n && j < m; ) {
    if (a[from + i] === b[from + j]) {
      left.add(from + i++);
      right.add(from + j++);
    } else if (longest[i + 1][j] >= longest[i][j + 1]) i++;
    else j++;
  }
  return [left, right];
}
