//! The blocks of a section as HTML.

use maud::{Markup, html};

use super::shown::prose;
use super::{Align, Block, Cell, Mark, Section, Table, chart, drawing, picture, plan, visible};
use crate::page::Fact;

/// A section with its heading.
pub(crate) fn section(section: &Section, id: &str) -> Markup {
    html! {
        section id=(id) {
            h2 { (visible(&section.title)) }
            @for group in section.blocks.chunk_by(|a, b| is_picture(a) && is_picture(b)) {
                @if is_picture(&group[0]) {
                    div class={ "pictures" @if group.len() == 1 { " one" } } { @for b in group { (block(b)) } }
                } @else {
                    (block(&group[0]))
                }
            }
        }
    }
}

fn is_picture(block: &Block) -> bool {
    matches!(block, Block::Chart(_) | Block::Plan(_) | Block::Drawing(_) | Block::Picture(_))
}

fn block(block: &Block) -> Markup {
    match block {
        Block::Heading(text) => html! { h3 { (visible(text)) } },
        Block::Text(text) => html! { p { (prose(text)) } },
        Block::Facts(list) => facts(list),
        Block::List(list) => html! { ul.plain { @for item in list { li { (prose(item)) } } } },
        Block::Table(t) => table(t),
        Block::Chart(c) => chart::figure(c),
        Block::Plan(p) => plan::figure(p),
        Block::Drawing(d) => drawing::figure(d),
        Block::Picture(p) => picture::figure(p),
    }
}

/// A row of facts.
pub(crate) fn facts(facts: &[Fact]) -> Markup {
    html! {
        dl.facts {
            @for f in facts {
                div {
                    dt { (visible(&f.label)) }
                    dd { (visible(&f.value)) @if !f.note.is_empty() { small { (visible(&f.note)) } } }
                }
            }
        }
    }
}

/// A table.
pub(crate) fn table(table: &Table) -> Markup {
    let marked = |mark| table.rows.iter().flat_map(|r| &r.cells).any(|c| c.mark == mark);
    let corrected = table.rows.iter().flat_map(|r| &r.cells).any(|c| c.printed.is_some());
    html! {
        div.table {
            table {
                caption { (visible(&table.caption)) }
                thead { tr {
                    @for c in &table.columns {
                        th scope="col" class=[class(c.align)] {
                            (visible(&c.title)) @if !c.unit.is_empty() { " " span.unit { "[" (visible(&c.unit)) "]" } }
                        }
                    }
                } }
                tbody {
                    @for row in &table.rows {
                        tr data-line=[row.block] {
                            @for (i, column) in table.columns.iter().enumerate() {
                                @let content = row.cells.get(i).map(cell).unwrap_or_default();
                                @if i == 0 {
                                    th scope="row" class=[class(column.align)] {
                                        @if let Some(line) = row.block {
                                            button.jump.script type="button" data-line=(line) title=(format!("go to line {}", row.line.unwrap_or(line + 1))) { (content) }
                                            span.unscripted { (content) }
                                        } @else { (content) }
                                    }
                                } @else {
                                    td class=[class(column.align)] { (content) }
                                }
                            }
                        }
                    }
                }
            }
            @if marked(Mark::Wrong) || corrected {
                p.key {
                    @if corrected { span { del { "printed" } " " b.right { "corrected" } " " } }
                    @if marked(Mark::Wrong) { span { span.wrong { "wrong" } } }
                }
            }
            @for note in &table.notes { p.remark { (prose(note)) } }
        }
    }
}

fn class(align: Align) -> Option<&'static str> {
    (align == Align::Right).then_some("number")
}

fn cell(cell: &Cell) -> Markup {
    let text = visible(&cell.text);
    html! {
        @if let Some(printed) = &cell.printed {
            del { @if printed.is_empty() { "not printed" } @else { (visible(printed)) } } " "
        }
        @match cell.mark {
            Mark::Plain => (text),
            Mark::Right => b.right { (text) },
            Mark::Wrong => span.wrong { (text) },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::{Chart, Column, Row};

    #[test]
    fn a_corrected_cell_shows_both_and_says_what_is_what() {
        let mut t = Table { caption: "Table 2".into(), ..Table::default() };
        t.columns = vec![Column::text("Turn"), Column::number("angle", "rad")];
        t.rows = vec![
            Row::new(vec!["finish 1".into(), Cell::corrected("0.94657", "9.04482")]).at(41),
            Row::new(vec!["<b>".into()]),
        ];
        let page = table(&t).into_string();
        assert!(page.contains("<del>9.04482</del> <b class=\"right\">0.94657</b>"));
        assert!(page.contains("data-line=\"41\"") && page.contains("go to line 42"));
        assert!(page.contains("&lt;b&gt;") && !page.contains("<b>"));
        assert!(page.contains("<del>printed</del>"), "a key explains the strike");
        assert_eq!(page.matches("<td").count(), 2, "a short row is filled");
    }

    #[test]
    fn neighbouring_pictures_share_a_row() {
        let c = || Chart::new("c", ("x", ""), ("y", "")).series("", vec![[0., 0.], [1., 1.]]);
        let s = Section::new("S").with(c()).with(c()).with(Block::Text("t".into())).with(c());
        let page = section(&s, "s").into_string();
        assert_eq!(page.matches("class=\"pictures\"").count(), 1);
        assert_eq!(page.matches("class=\"pictures one\"").count(), 1);
    }
}
