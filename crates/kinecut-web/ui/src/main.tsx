// The workbench begins here.
import { render } from "preact";
import { App, dropped } from "./app/app";
import { startKeys } from "./app/commands";
import { outcome } from "./app/outcome";
import "./app/theme";
import { documents, serverGone, start, tell, titled } from "./store/session";
import { Gone } from "./base/api";

render(<App />, document.getElementById("app") as HTMLElement);
startKeys();
titled(() => outcome.value?.word ?? "");

addEventListener("dragover", (e) => e.preventDefault());
addEventListener("drop", (e) => {
  e.preventDefault();
  if (e.dataTransfer?.files.length) void dropped(e.dataTransfer.files);
});
addEventListener("beforeunload", (e) => {
  if (documents.value.some((doc) => doc.dirty.value)) e.preventDefault();
});

start().catch((error: unknown) => {
  if (error instanceof Gone) serverGone.value = true;
  else tell(error instanceof Error ? error.message : String(error));
});
