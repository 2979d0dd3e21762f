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
import { ready } from "./words";
import { figuresTitle } from "./windows/teaching/open";
import { restoreSurfaces, surfaceTitle } from "./windows/surface/open";

// Until its words have come nothing is shown: the page would begin in another language.
await ready;
render(<App />, document.getElementById("app") as HTMLElement);
startKeys();
titled(() => (active.value?.question ? "" : (outcome.value?.word ?? "")), () => figuresTitle() ?? surfaceTitle() ?? faceTitle());

addEventListener("beforeunload", (e) => {
  if (documents.value.some((doc) => doc.dirty.value) || face.value?.dirty.value) e.preventDefault();
});

start().then(restoreSurfaces).catch((error: unknown) => {
  if (error instanceof Gone) serverGone.value = true;
  else tell(error instanceof Error ? error.message : String(error));
});
