// The kinds of questions that have a window.
import { answers } from "../store/questions";
import { drilling } from "./drill/kind";
import { envelope, grazing } from "./grazing/kind";
import { hole } from "./hole/kind";

answers(drilling);
answers(hole);
answers(grazing);
answers(envelope);
