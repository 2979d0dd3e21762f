// The profile of a tool in a half section.
import { placeOf } from "../../windows/grazing/sheet";
import type { Point } from "../model";
import type { Tool } from "./tool";

/** Places along a piece, from its lower end. */
export function along(piece: Tool["pieces"][number], pieces = 32): Point[] {
  const steps = piece.centre ? pieces : 1;
  return Array.from({ length: steps + 1 }, (_, i) => placeOf(piece, piece.from + ((piece.to - piece.from) * i) / steps));
}

export function profileOf(tool: Pick<Tool, "pieces">): Point[] {
  return tool.pieces.filter((p) => !p.fan).flatMap((p) => along(p));
}
