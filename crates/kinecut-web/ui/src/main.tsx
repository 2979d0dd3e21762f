// The workbench begins here.
import { render } from "preact";
import { App } from "./app/app";
import { startKeys } from "./app/commands";
import { outcome } from "./app/outcome";
import "./app/theme";
import { active, documents, serverGone, start, tell, titled } from "./store/session";
import { Gone } from "./base/api";
import "./windows/questions";
import { face, faceTitle } from "./windows/face/open";

render(<App />, document.getElementById("app") as HTMLElement);
startKeys();
titled(() => (active.value?.question ? "" : (outcome.value?.word ?? "")), faceTitle);

addEventListener("beforeunload", (e) => {
  if (documents.value.some((doc) => doc.dirty.value) || face.value?.dirty.value) e.preventDefault();
});

start().catch((error: unknown) => {
  if (error instanceof Gone) serverGone.value = true;
  else tell(error instanceof Error ? error.message : String(error));
});
