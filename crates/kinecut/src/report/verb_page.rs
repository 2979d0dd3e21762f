//! The page of a verb that plans without a job: the report's look without a program; its only script plays pictures.

use maud::{DOCTYPE, Markup, PreEscaped, html as markup};

use super::{Section, blocks, page, visible};

/// What such a page says.
pub(super) struct VerbPage<'a> {
    /// The command that made it.
    pub(super) maker: &'a str,
    /// Heading; may come from outside.
    pub(super) title: &'a str,
    /// Rules of its own.
    pub(super) style: &'a str,
    /// Whether pictures of it move.
    pub(super) moves: bool,
    /// What the page does not replace.
    pub(super) caution: &'a str,
    /// Its parts.
    pub(super) sections: &'a [Section],
    /// What stands below each part, in their order; missing ones are empty.
    pub(super) figures: &'a [Markup],
}

impl VerbPage<'_> {
    /// One HTML file without any reference to a network.
    pub(super) fn html(&self) -> String {
        let scripts: &[&str] = if self.moves { &[page::PICTURE_SCRIPT] } else { &[] };
        let style = format!("{}{}", page::STYLE, self.style);
        let page: Markup = markup! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(page::policy_of(scripts, &style));
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    meta name="generator" content=(format!("kinecut {}", crate::VERSION));
                    meta name="referrer" content="no-referrer";
                    title { (visible(self.title)) }
                    style { (PreEscaped(&style)) }
                }
                body {
                    header.top {
                        div {
                            p.maker { (self.maker) }
                            h1 { (visible(self.title)) }
                        }
                        nav aria-label="Contents" {
                            @for (i, s) in self.sections.iter().enumerate() {
                                a href=(format!("#section-{}", i + 1)) { (visible(&s.title)) }
                            }
                        }
                    }
                    main {
                        @for (i, s) in self.sections.iter().enumerate() {
                            (blocks::section(s, &format!("section-{}", i + 1)))
                            @if let Some(figures) = self.figures.get(i) { section { (figures) } }
                        }
                    }
                    footer { p { "kinecut " (crate::VERSION) ". " (self.caution) } }
                    @for script in scripts { script { (PreEscaped(script)) } }
                }
            }
        };
        page.into_string()
    }
}
