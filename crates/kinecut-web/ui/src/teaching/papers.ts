// The papers and their figures, as far as they are drawn.
import type { Key } from "./language";
import type { Figure } from "./model";
import { fig13 } from "./paper1/fig13";
import { fig14 } from "./paper1/fig14";
import { fig15 } from "./paper1/fig15";
import { fig16 } from "./paper1/fig16";
import { fig17 } from "./paper1/fig17";
import { fig24 } from "./paper2/fig24";
import { fig25 } from "./paper2/fig25";
import { fig26 } from "./paper2/fig26";
import { fig41 } from "./paper4/fig41";
import { fig42 } from "./paper4/fig42";
import { fig43 } from "./paper4/fig43";
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
  { no: 1, title: "paper1.title", source: "paper1.source", figures: [fig13, fig14, fig15, fig16, fig17] },
  { no: 2, title: "paper2.title", source: "paper2.source", figures: [fig24, fig25, fig26] },
  { no: 4, title: "paper4.title", source: "paper4.source", figures: [fig41, fig42, fig43, fig45] },
  { no: 5, title: "paper5.title", source: "paper5.source", figures: [fig51, table5t] },
];
