// The server's protocol: requests with the token of this start, answers as they come.
import { counted } from "./open";

export interface Quantity {
  value: number;
  unit: string;
}

export interface Finding {
  code: string;
  severity: "note" | "warning" | "doubt" | "error";
  message: string;
  help?: string;
  key?: string;
  place?: { file: string; line: number; column?: number; start?: number; end?: number; text?: string };
  point?: [number, number, number];
  value?: Quantity;
  bound?: Quantity;
}

export type FileKind = "job" | "machine" | "tools" | "cutting" | "question" | "program" | "mesh" | "outline" | "text" | "result" | "surface";

export interface FileName {
  id: string;
  name: string;
  kind: FileKind;
  bytes: number;
}

export interface Project {
  folder: string;
  version: string;
  protocol: number;
  cores: number;
  open: string | null;
  truncated: boolean;
  files: FileName[];
}

export interface FileText extends FileName {
  text: string | null;
  sha256: string;
}

export interface Program {
  file: string;
  control: string;
  first: number;
  lines: number;
  text: string;
  seconds: number | null;
  sha256: string;
}

/** A run of program lines that belongs to an operation of the text; `to` is the line after the last. */
export interface OperationRun {
  key: string;
  /** Place of the operation in the text; programs of others have none. */
  place?: Finding["place"];
  title: string;
  tool: number;
  tool_name: string;
  from: number;
  to: number;
}

export interface Scene {
  head: import("viewer/decode").Head;
  streams: Record<string, string>;
}

export interface Verdict {
  outcome: "safe" | "not-proven" | "not-safe";
  headline: string;
  scope: string[];
  found: Finding[];
  not_checked: { heading: string; count: number; items: { what: string; count?: number }[] }[];
  to_ensure: { what: string; value: string }[];
  proven: { claim: string; bound: string }[];
}

interface Answer {
  generation: number;
  seconds: number;
}

/** What plan and simulation tell alike. */
export interface Work extends Answer {
  state: "done";
  findings: Finding[];
  programs: Program[];
  operations?: OperationRun[];
  tools?: { number: number; name: string }[];
  scene: Scene;
  /** `plan.json`. */
  plan: Plan;
  /** Distance of the lines of a coarser stock of which the picture is [mm]; null: it is that of the stock itself. */
  drawn_step: number | null;
  guessed?: string[];
}

/** What the workbench reads of `plan.json`. */
export interface Plan {
  /** `time_without_jerk_limit` comes with times under the limits of the machine. */
  setups: { program: string; time: number; time_without_jerk_limit?: number }[];
}

export interface Planned extends Work {
  /** Whether the times are those of the programmed feeds alone. */
  quick: boolean;
  step: number;
  coarse_step: number;
}

export interface Simulated extends Work {
  step: number;
  coarse: boolean;
  result: string;
  verdict: Verdict;
  removal?: [number, number][];
}

export interface Wrong extends Answer {
  state: "wrong";
  error: Finding;
  findings: Finding[];
}

export interface Cancelled extends Answer {
  state: "cancelled";
}

/** A refusal of the server. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    readonly reason: string,
    readonly finding: Partial<Finding>,
    readonly body: unknown,
  ) {
    super(finding.message ?? reason);
  }
}

/** The server does not answer. */
export class Gone extends Error {}

const TOKEN = "kinecut-token";

function token(): string {
  const given = /^#token=([0-9a-f]+)$/.exec(location.hash)?.[1];
  if (given) {
    sessionStorage.setItem(TOKEN, given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return given ?? sessionStorage.getItem(TOKEN) ?? "";
}

const authorization = `Bearer ${token()}`;

/** A word of this page, by which the server tells its requests from those of others. */
export const client = `p${crypto.randomUUID().replaceAll("-", "")}`;

async function answer(path: string, method: string, body: unknown, signal?: AbortSignal): Promise<Response> {
  const headers: Record<string, string> = { Authorization: authorization };
  if (body !== undefined) headers["Content-Type"] = "application/json";
  let response: Response;
  try {
    response = await fetch(path, { method, headers, body: body === undefined ? undefined : JSON.stringify(body), signal, cache: "no-store" });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new Gone();
  }
  if (response.ok) return response;
  const told = (await response.json().catch(() => ({}))) as { error?: Partial<Finding> & { reason?: string } };
  throw new Refused(response.status, told.error?.reason ?? "", told.error ?? {}, told);
}

const json = <T>(path: string, method = "GET", body?: unknown, signal?: AbortSignal) => counted(answer(path, method, body, signal).then((told) => told.json() as Promise<T>));
const words = (path: string, body: unknown, signal: AbortSignal) => counted(answer(path, "POST", body, signal).then((told) => told.text()));

export const project = () => json<Project>("/api/project");
export const file = (id: string) => json<FileText>(`/api/file/${id}`);
export const schema = (name: string) => json<Record<string, unknown>>(`/api/schema/${name}`);

/** Saves a text over one that was read; Refused with `changed` when the file is another by now. */
export const save = (id: string, text: string, sha256: string | null) => json<{ id: string; sha256: string }>(`/api/file/${id}`, "PUT", { text, sha256 });

/** Makes a file; `beside` is one in whose folder it shall lie. */
export const create = (name: string, text: string, beside?: string) => json<FileText>("/api/file", "POST", { new: name, beside, text });

/** A new file of these bytes, beside another or at the top of the folder. */
export async function createBytes(name: string, bytes: Uint8Array, beside: string | null): Promise<{ id: string; name: string }> {
  const read = new FileReader();
  const packed = new Promise<string>((done, failed) => {
    read.onload = () => done(String(read.result).replace(/^[^,]*,?/, ""));
    read.onerror = () => failed(read.error);
  });
  read.readAsDataURL(new Blob([bytes as Uint8Array<ArrayBuffer>]));
  return json("/api/file", "POST", { new: name, base64: await packed, ...(beside !== null && { beside }) });
}

/** A job about a program that comes alone. */
export const guess = (question: Question, signal: AbortSignal) => json<{ state: "done"; job: string } | Wrong | Cancelled>("/api/guess", "POST", { client, ...question }, signal);

export interface Question {
  generation: number;
  file: string;
  text?: string;
}

export const plan = (question: Question & { quick: boolean }, signal: AbortSignal) => json<Planned | Wrong | Cancelled>("/api/plan", "POST", { client, ...question }, signal);

export const simulate = (question: Question & { step: "coarse" | "job" }, signal: AbortSignal) =>
  json<Simulated | Wrong | Cancelled>("/api/simulate", "POST", { client, ...question }, signal);

export const stop = (kind: "simulate" | "plan", file: string) => json<{ stopped: number }>("/api/stop", "POST", { client, kind, file });

/** A question for a planner: about a file, or about a text under a name of its own, beside the file whose folder its names are of. */
export interface VerbQuestion {
  generation: number;
  file?: string;
  /** Requests of one name follow one another: the newest counts. */
  new?: string;
  beside?: string;
  text: string;
  compare?: boolean;
  paper?: boolean;
  map?: boolean;
  walk?: boolean;
  load?: boolean;
  samples?: "rough" | "finish" | "all";
  gallery?: boolean;
  moments?: number;
}

/** The answer that a verb prints with `--json`; a finding where it could not do it. */
export const verb = <T>(name: string, question: VerbQuestion, signal: AbortSignal) => json<T | Finding>(`/api/verb/${name}`, "POST", { client, ...question }, signal);

/** The page that a verb writes. */
export const verbPage = (name: string, question: VerbQuestion, signal: AbortSignal) => words(`/api/page/${name}`, { client, ...question }, signal);

/** A verb that is asked by its flags, without a text of its own. */
export const ask = <T>(name: string, flags: object, signal: AbortSignal) => json<T | Finding>(`/api/verb/${name}`, "POST", { client, ...flags }, signal);

/** The drawing that a verb writes with `--svg`. */
export const drawing = (name: string, flags: object, signal: AbortSignal) => words(`/api/drawing/${name}`, { client, ...flags }, signal);

/** The page that a verb writes with `--out`. */
export const pageOf = (name: string, flags: object, signal: AbortSignal) => words(`/api/page/${name}`, { client, ...flags }, signal);

/** What the workbench reads of `inspection.json`. */
export interface Inspection {
  step: number;
  /** Distances from the surface are known so far [mm]. */
  within: number;
  measures: { distance: number; stretches: { material: boolean; length: number; within: number | null }[] }[];
}

/** Lines from one point to another of a part that the server has. */
export const inspect = (result: string, measures: number[][]) => json<Inspection>("/api/inspect", "POST", { result, measures });

export const report = (result: string) => counted(answer("/api/report", "POST", { result }).then((told) => told.blob()));

export interface Events {
  progress: { kind: string; file: string; generation: number; stage: string; done: number; of: number; note: string | null };
  end: { kind: string; file: string; generation: number; state: string; seconds: number };
  changed: { id: string; name: string; sha256: string | null };
  files: Record<string, never>;
  bye: Record<string, never>;
}

/** No word for so long means that the server is gone [ms]. */
const SILENCE = 12_000;
const AGAIN = 1500;

/** Listens to the server's events for ever; `there` is told when it goes and comes. */
export async function listen(hear: <N extends keyof Events>(name: N, data: Events[N]) => void, there: (on: boolean) => void): Promise<never> {
  for (;;) {
    const control = new AbortController();
    let timer = setTimeout(() => control.abort(), SILENCE);
    try {
      const response = await answer(`/api/events?client=${client}`, "GET", undefined, control.signal);
      const reader = (response.body as ReadableStream<Uint8Array>).pipeThrough(new TextDecoderStream() as unknown as TransformStream<Uint8Array, string>).getReader();
      there(true);
      let waiting = "";
      for (;;) {
        const { value, done } = await reader.read();
        if (done) break;
        clearTimeout(timer);
        timer = setTimeout(() => control.abort(), SILENCE);
        waiting += value;
        const events = waiting.split("\n\n");
        waiting = events.pop() ?? "";
        for (const event of events) {
          const name = /^event: ?(.*)$/m.exec(event)?.[1] as keyof Events | undefined;
          const data = [...event.matchAll(/^data: ?(.*)$/gm)].map((m) => m[1]).join("\n");
          if (name) hear(name, JSON.parse(data || "{}"));
        }
      }
    } catch {
      // Whatever the cause, the next try tells.
    }
    clearTimeout(timer);
    there(false);
    await new Promise((done) => setTimeout(done, AGAIN));
  }
}
