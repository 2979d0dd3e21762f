//! The sheet of a surface as a person reads it.

use std::fmt::Write as _;

use super::{SplitRow, SurfaceSheet};

impl SurfaceSheet {
    /// As a person reads it.
    pub(crate) fn text(&self) -> String {
        let mut out =
            format!("{}: {}\n", self.name, self.title).trim_end_matches([':', ' ', '\n']).to_owned();
        out.push('\n');
        let _ = writeln!(out, "  directrix   {}", self.directrix);
        let _ = writeln!(out, "  generatrix  {}", self.generatrix);
        let _ = writeln!(out, "  chain       {}", self.chain);
        let parameters: Vec<String> = self.parameters.iter().map(|(n, v)| format!("{n} = {v}")).collect();
        if !parameters.is_empty() {
            let _ = writeln!(out, "  with        {}", parameters.join(", "));
        }
        for (name, from, to) in &self.variables {
            let _ = writeln!(out, "  {name:<10}  {from} .. {to}");
        }
        let _ = writeln!(out, "\n{}", self.product);
        for (element, rows) in self.surface.chain().iter().zip(&self.matrices) {
            let name = format!("A{}({})", element.motion, element.law);
            for (i, row) in rows.iter().enumerate() {
                let left = if i == 1 { format!("{name} =") } else { String::new() };
                let _ = writeln!(out, "  {left:<28} {row}");
            }
        }
        let _ = writeln!(out, "r0 = {}", self.point);
        let _ = writeln!(out, "\nprimary code {}, canonical form {}", self.code, self.canonical);
        let orders = if self.orders == 1 { "order" } else { "orders" };
        let _ =
            writeln!(out, "{} {orders} of the motions, {} layouts with the bed", self.orders, self.layouts);
        let _ = writeln!(out, "{}; it slides in itself by:", self.form);
        if self.slides.is_empty() {
            out.push_str("  no motion\n");
        }
        for slide in &self.slides {
            let _ = writeln!(out, "  {slide}");
        }
        let valid = self.splits.iter().filter(|s| s.valid).count();
        let _ = writeln!(out, "\n{} redistributions, {valid} with a rigid tool", self.splits.len());
        for split in &self.splits {
            split.text(&mut out);
        }
        self.methods_text(&mut out);
        out
    }
}

impl SurfaceSheet {
    /// Processes by method, and contacts of those that touch or roll.
    fn methods_text(&self, out: &mut String) {
        for row in &self.processes {
            let _ = writeln!(out, "\nby {}:", row.method);
            for (name, motions) in &row.processes {
                let _ = writeln!(out, "  {name}  {motions}");
            }
        }
        for envelope in &self.envelopes {
            let _ = writeln!(
                out,
                "\n{} ({}): machine {}, tool {}",
                envelope.process, envelope.method, envelope.machine, envelope.tool
            );
            for line in envelope.contact.lines() {
                let _ = writeln!(out, "  {line}");
            }
        }
    }
}

impl SplitRow {
    fn text(&self, out: &mut String) {
        let part = |code: &str| if code.is_empty() { "-".to_owned() } else { code.to_owned() };
        let _ = writeln!(
            out,
            "\n{:>9} | {:<6} {}: {}",
            part(&self.machine_code),
            part(&self.tool_code),
            self.tool_kind.unwrap_or("no tool"),
            self.process
        );
        if let Some(methods) = &self.methods {
            let _ = writeln!(out, "            {methods}");
        }
        let digits = |d: &[u8]| d.iter().map(u8::to_string).collect::<Vec<_>>().join(" ");
        if !self.forming.is_empty() {
            let _ = writeln!(out, "            forming {}", digits(&self.forming));
        }
        if !self.setting.is_empty() {
            let _ = writeln!(out, "            setting {}", digits(&self.setting));
        }
        for link in &self.links {
            let _ =
                writeln!(out, "            linked  {} ({}, by {})", link.motions, link.kind, link.variable);
        }
        if !self.built_in.is_empty() && self.built_in != "-" {
            let _ = writeln!(out, "            ground into the tool {}", self.built_in);
        }
        match &self.setup {
            Some(s) if self.setup_needed => {
                let _ = writeln!(
                    out,
                    "            set-up  {} ({}), {}, margin {:.4}",
                    s.motion, s.source, s.verdict, s.margin
                );
            }
            None if self.setup_needed && self.valid => {
                out.push_str("            set-up  none: the tool does not come off in one piece\n");
            }
            _ => {}
        }
        for remark in &self.remarks {
            let _ = writeln!(out, "            {remark}");
        }
    }
}
