//! Options of every verb: the form in which answers and messages are printed, and the findings that count.

use std::io::IsTerminal as _;

use clap::ValueEnum;

// No document comment: it would be taken for the description of the program.
#[derive(Debug, clap::Args)]
pub(crate) struct Printing {
    /// One JSON document on standard output, errors included
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Colour of messages
    #[arg(long, global = true, value_enum, default_value_t = Colour::Auto, value_name = "WHEN")]
    pub(crate) color: Colour,
    /// Findings that count in the exit code beside errors and what is not proven
    #[arg(long, global = true, value_enum, value_name = "WHAT")]
    pub(crate) deny: Vec<Deny>,
}

impl Printing {
    /// Whether messages have colours.
    pub(crate) fn colour(&self) -> bool {
        match self.color {
            Colour::Always => true,
            Colour::Never => false,
            Colour::Auto => std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
        }
    }
}

/// A kind of finding that may be denied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Deny {
    /// A warning exits with 1, as an error does
    Warnings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}
