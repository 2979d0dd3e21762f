// Data of the 3-D view that has come: unpacked once, read when it is shown.
import { type Head, unpacked, use } from "viewer/decode";
import { Track } from "viewer/track";
import type { Scene } from "../base/api";

export class Shown {
  readonly track: Track;
  readonly at = new Date();

  private constructor(
    readonly head: Head,
    private readonly streams: Map<string, Uint8Array>,
    /** The text it was made of. */
    readonly text: string,
    /** Whether it has a part that was cut. */
    readonly cut: boolean,
  ) {
    const before = this.open();
    this.track = new Track(head);
    use(before);
  }

  static async of(scene: Scene, text: string, cut: boolean): Promise<Shown> {
    return new Shown(scene.head, await unpacked(Object.entries(scene.streams)), text, cut);
  }

  /** Lets its streams be read, in place of those that are given back. */
  open(): Map<string, Uint8Array> {
    return use(new Map(this.streams));
  }
}
