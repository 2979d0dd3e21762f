// German: a file of its own, loaded when it is chosen.
import type { Catalogue } from "../en";
import { app } from "./app";
import { drill } from "./drill";
import { face } from "./face";

export { keys } from "./keys";
export { symbols } from "./symbols";
export { units } from "./units";
export const words: Partial<Catalogue> = { ...app, ...drill, ...face };
