//! The page of a verb that plans without a job: the report's look without a program; its only script plays pictures.

use maud::{DOCTYPE, Markup, PreEscaped, html as markup};

use super::{Section, blocks, style, visible};

/// Content of the page of a verb.
#[derive(Default)]
pub(crate) struct VerbPage<'a> {
    /// The command that made it.
    pub(crate) maker: &'a str,
    /// Heading; may come from outside.
    pub(crate) title: &'a str,
    /// Rules of its own.
    pub(crate) style: &'a str,
    /// Whether pictures of it move.
    pub(crate) moves: bool,
    /// Caution on the page: the checks that it does not replace.
    pub(crate) caution: &'a str,
    /// Its parts.
    pub(crate) sections: &'a [Section],
    /// Figures below each part, in their order; missing ones are empty.
    pub(crate) figures: &'a [Markup],
}

impl VerbPage<'_> {
    /// One HTML file without any reference to a network.
    pub(crate) fn html(&self) -> String {
        let scripts: &[&str] = if self.moves { &[style::PICTURE_SCRIPT] } else { &[] };
        let style = format!("{}{}", style::style(), self.style);
        let page: Markup = markup! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(style::policy_of(scripts, &style));
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
