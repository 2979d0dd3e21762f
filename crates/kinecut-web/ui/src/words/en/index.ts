// All English texts, a file a window.
import { app } from "./app";
import { drill } from "./drill";
import { face } from "./face";
import { job } from "./job";

export const en = { ...app, ...job, ...drill, ...face } as const;

export type Key = keyof typeof en;
export type Catalogue = Record<Key, string>;
