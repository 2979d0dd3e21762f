// All English texts, a file a window.
import { app } from "./app";
import { drill } from "./drill";
import { face } from "./face";
import { grazing } from "./grazing";
import { hole } from "./hole";
import { job } from "./job";
import { surface } from "./surface";

export const en = { ...app, ...job, ...drill, ...face, ...hole, ...grazing, ...surface } as const;

export type Key = keyof typeof en;
export type Catalogue = Record<Key, string>;
