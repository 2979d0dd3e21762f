// A JSON schema as forms: of what kind a value is, what its keys take, which of several forms a value has.
import { type Unit, unitOf } from "./unit";

export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  type?: string | string[];
  const?: unknown;
  enum?: unknown[];
  anyOf?: Schema[];
  oneOf?: Schema[];
  properties?: Record<string, Schema>;
  additionalProperties?: boolean | Schema;
  required?: string[];
  items?: Schema;
  minItems?: number;
  maxItems?: number;
  minimum?: number;
  maximum?: number;
  default?: unknown;
  examples?: unknown[];
  description?: string;
  "x-unit"?: string;
}

export type Kind = "number" | "whole" | "text" | "truth" | "word" | "list" | "table" | "map" | "choice" | "any";

/** A value's form: the schema beside its key, with that to which it refers. */
export class Form {
  readonly own: Schema;

  constructor(
    readonly root: Schema,
    readonly beside: Schema,
    /** The words about the nearest key. */
    readonly outer = "",
  ) {
    this.own = simple(root, beside);
  }

  get about(): string {
    return this.beside.description ?? this.own.description ?? this.outer;
  }

  private with(schema: Schema): Form {
    return new Form(this.root, schema, this.about);
  }

  get kind(): Kind {
    const { own } = this;
    if (typeof own.const === "string") return "word";
    if (own.enum || own.oneOf || own.anyOf) return "choice";
    const type = Array.isArray(own.type) ? own.type.find((t) => t !== "null") : own.type;
    if (type === "number") return "number";
    if (type === "integer") return "whole";
    if (type === "string") return "text";
    if (type === "boolean") return "truth";
    if (type === "array") return "list";
    if (type === "object") return own.properties ? "table" : "map";
    return "any";
  }

  /** All forms of a choice, with the choices among them taken apart. */
  get choices(): Form[] {
    const { own } = this;
    if (own.enum) return own.enum.map((value) => this.with({ const: value }));
    const inner = own.oneOf ?? own.anyOf;
    if (!inner) return [this];
    return inner.filter((schema) => schema.type !== "null").flatMap((schema) => this.with(schema).choices);
  }

  /** The words that a choice offers, if it is of words alone. */
  get words(): { word: string; about: string }[] | null {
    if (this.kind !== "choice" && this.kind !== "word") return null;
    const all = this.choices;
    if (!all.every((form) => form.kind === "word")) return null;
    return all.map((form) => ({ word: String(form.own.const), about: form.own.description ?? "" }));
  }

  /** The form among several that a value has, or would have when it is complete. */
  of(value: unknown): Form {
    const all = this.choices;
    if (all.length === 1) return all[0];
    let best = all[0];
    let most = -1;
    for (const form of all) {
      const points = form.fits(value);
      if (points > most) [best, most] = [form, points];
    }
    return best;
  }

  /** How well a value has this form; less than 0: not at all. */
  fits(value: unknown): number {
    const { kind, own } = this;
    if (kind === "word") return value === own.const ? 100 : -1;
    if (kind === "number" || kind === "whole") return typeof value === "number" ? 10 : -1;
    if (kind === "text") return typeof value === "string" ? 5 : -1;
    if (kind === "truth") return typeof value === "boolean" ? 10 : -1;
    if (kind === "list") return Array.isArray(value) ? 10 : -1;
    if (kind !== "table" && kind !== "map") return 0;
    if (typeof value !== "object" || value === null || Array.isArray(value)) return -1;
    let points = 0;
    for (const [key, inner] of Object.entries(value)) {
      const schema = own.properties?.[key];
      if (!schema) points -= 1;
      else if (simple(this.root, schema).const !== undefined) points += simple(this.root, schema).const === inner ? 1000 : -1000;
      else points += 2;
    }
    return Math.max(0, points + 1);
  }

  get keys(): string[] {
    return Object.keys(this.own.properties ?? {});
  }

  required(key: string): boolean {
    return this.own.required?.includes(key) ?? false;
  }

  /** The form of a key; undefined where the table has none of that name. */
  key(key: string): Form | undefined {
    const schema = this.own.properties?.[key] ?? (typeof this.own.additionalProperties === "object" ? this.own.additionalProperties : undefined);
    return schema && this.with(schema);
  }

  get item(): Form {
    return this.with(this.own.items ?? {});
  }

  /** How many items a list has, where that is one number. */
  get length(): number | null {
    const { minItems, maxItems } = this.own;
    return minItems !== undefined && minItems === maxItems ? minItems : null;
  }

  /** The form along a path through a value. */
  at(path: (string | number)[], value: unknown): Form | undefined {
    let form: Form | undefined = this.of(value);
    let inner = value;
    for (const step of path) {
      if (!form) return undefined;
      inner = typeof inner === "object" && inner !== null ? (inner as Record<string | number, unknown>)[step] : undefined;
      const next: Form | undefined = typeof step === "number" ? form.item : form.key(step);
      form = next?.of(inner);
    }
    return form;
  }

  get unit(): Unit {
    const { kind } = this;
    const given = this.beside["x-unit"] ?? this.own["x-unit"];
    if (given) return given;
    if (kind === "number") return unitOf(this.about);
    if (kind === "list") return this.item.unit;
    if (kind === "choice") return this.choices.find((form) => form.kind === "number")?.unit ?? null;
    return null;
  }

  /** The value that is taken when none is given, as its words say it; null where it has none. */
  get standard(): string | null {
    const given = this.beside.default ?? this.own.default;
    if (given !== undefined && given !== null && typeof given !== "object") return String(given);
    const told = /\bdefault:? ([^.;]+(?:\.\d+)?[^.;]*)/i.exec(this.about)?.[1];
    return told?.trim().replaceAll("`", "") ?? null;
  }

  get example(): unknown {
    const given = this.beside.examples?.[0] ?? this.own.examples?.[0];
    if (given !== undefined) return given;
    const { kind } = this;
    if (kind === "word") return this.own.const;
    if (kind === "choice") return this.choices[0]?.example;
    if (kind === "truth") return true;
    if (kind === "table") return Object.fromEntries((this.own.required ?? []).map((key) => [key, this.key(key)?.example ?? 0]));
    if (kind === "list") return Array.from({ length: this.own.minItems ?? 0 }, () => this.item.example ?? 0);
    if (kind === "text") return "";
    return kind === "number" || kind === "whole" ? (this.own.minimum ?? 1) : undefined;
  }
}

/** A schema with its reference followed, and without the form of no value. */
function simple(root: Schema, schema: Schema): Schema {
  let at = schema;
  for (let i = 0; i < 16; i++) {
    if (at.$ref) {
      at = root.$defs?.[at.$ref.replace("#/$defs/", "")] ?? {};
      continue;
    }
    const forms = (at.anyOf ?? at.oneOf)?.filter((form) => form.type !== "null");
    if (forms?.length === 1 && !at.properties) at = forms[0];
    else break;
  }
  return at;
}

/** Whether a table is one of several with the same word under a key, as `type` of operations. */
export function variants(form: Form, key: string): { word: string; form: Form }[] {
  return form.choices.flatMap((choice) => {
    const word = choice.key(key)?.own.const;
    return typeof word === "string" ? [{ word, form: choice }] : [];
  });
}
