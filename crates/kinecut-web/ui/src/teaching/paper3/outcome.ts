// Forms of the curve on one element, as the library names them.
import { word } from "../language";

export const OUTCOMES = ["nothing", "two through-branches", "one U", "two U", "one closed loop"] as const;
export type Outcome = (typeof OUTCOMES)[number];

/** The form in words. */
export function outcomeWord(outcome: string | undefined): string {
  const at = OUTCOMES.findIndex((o) => o === outcome);
  return at < 0 ? (outcome ?? "–") : word((["out.nothing", "out.through", "out.oneU", "out.twoU", "out.loop"] as const)[at]);
}
