// The papers and their figures, as far as they are drawn.
import type { Key } from "./language";
import type { Figure } from "./model";
import { fig11 } from "./paper1/fig11";
import { fig12 } from "./paper1/fig12";
import { fig13 } from "./paper1/fig13";
import { fig14 } from "./paper1/fig14";
import { fig15 } from "./paper1/fig15";
import { fig16 } from "./paper1/fig16";
import { fig17 } from "./paper1/fig17";
import { fig21 } from "./paper2/fig21";
import { fig22 } from "./paper2/fig22";
import { fig23 } from "./paper2/fig23";
import { fig24 } from "./paper2/fig24";
import { fig25 } from "./paper2/fig25";
import { fig26 } from "./paper2/fig26";
import { fig27 } from "./paper2/fig27";
import { fig31 } from "./paper3/fig31";
import { fig32 } from "./paper3/fig32";
import { fig33 } from "./paper3/fig33";
import { fig34 } from "./paper3/fig34";
import { fig41 } from "./paper4/fig41";
import { fig42 } from "./paper4/fig42";
import { fig43 } from "./paper4/fig43";
import { fig44 } from "./paper4/fig44";
import { fig45 } from "./paper4/fig45";
import { fig51 } from "./paper5/fig51";
import { table5t } from "./paper5/table5t";

export interface Paper {
  no: number;
  title: Key;
  source: Key;
  figures: Figure[];
}

export const PAPERS: Paper[] = [
  { no: 1, title: "paper1.title", source: "paper1.source", figures: [fig11, fig12, fig13, fig14, fig15, fig16, fig17] },
  { no: 2, title: "paper2.title", source: "paper2.source", figures: [fig21, fig22, fig23, fig24, fig25, fig26, fig27] },
  { no: 3, title: "paper3.title", source: "paper3.source", figures: [fig31, fig32, fig33, fig34] },
  { no: 4, title: "paper4.title", source: "paper4.source", figures: [fig41, fig42, fig43, fig44, fig45] },
  { no: 5, title: "paper5.title", source: "paper5.source", figures: [fig51, table5t] },
];
