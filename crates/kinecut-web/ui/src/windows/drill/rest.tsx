// The keys that have no field among the numbers.
import { Form, type Schema } from "../../schema/schema";
import { type Document, keyOf } from "../../store/document";
import { t } from "../../words";
import { Fields } from "../job/fields";
import { fieldsOf } from "./strip";

/** All other keys of operation and tool. */
export function Rest({ doc, schema, place }: { doc: Document; schema: Schema; place: [number, number] }) {
  const shown = fieldsOf(doc, place).map(({ path }) => path);
  const of = (table: string) => [...new Set(shown.filter((path) => path[0] === table).map((path) => String(path[1])))];
  const root = new Form(schema, { $ref: "#/$defs/HoleTable" });
  const operation = root.at(["operation"], doc.values.value);
  const tool = root.at(["tool"], doc.values.value);
  return (
    <details class="panel rest" open={doc.wrong.value?.key !== undefined && !shown.some((path) => keyOf(path) === doc.wrong.value?.key)}>
      <summary>{t("drill.rest")}</summary>
      <div class="form">
        {operation && (
          <>
            <h3>{t("drill.operation")}</h3>
            <Fields doc={doc} path={["operation"]} form={operation} without={[...of("operation"), "tool", "entry", "exit", "length", "feed_per_rev"]} />
          </>
        )}
        {tool && (
          <>
            <h3>{t("drill.tool")}</h3>
            <Fields doc={doc} path={["tool"]} form={tool} without={[...of("tool"), "type", "point", "point_angle"]} />
          </>
        )}
      </div>
    </details>
  );
}
