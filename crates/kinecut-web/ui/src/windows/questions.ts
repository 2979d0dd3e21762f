// The kinds of questions that have a window.
import { answers } from "../store/questions";
import { drilling } from "./drill/kind";

answers(drilling);
