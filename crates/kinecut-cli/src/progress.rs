//! A progress bar on a terminal, nothing in a pipe; Ctrl-C asks the work to stop.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use kinecut::base::Progress;

/// Whether Ctrl-C was pressed.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Progress on standard error.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new() -> Bar {
        static HANDLER: Once = Once::new();
        // Without a handler Ctrl-C ends the program as it always did.
        HANDLER.call_once(|| {
            let _ = ctrlc::set_handler(interrupt);
        });
        // indicatif draws nothing when standard error is no terminal.
        let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{msg:22} {bar:30} {percent:>3} %{left}");
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        bar.set_style(style.with_key("left", write_left));
        Bar(bar)
    }
}

/// Writes the time that is left of a stage, once a part of it is done from which that can be told.
fn write_left(state: &ProgressState, out: &mut dyn std::fmt::Write) {
    let all = state.len().unwrap_or(0);
    // The first hundredth tells too little.
    if state.pos() >= all || state.pos() < all.div_ceil(100) {
        return;
    }
    let left = state.eta();
    // There is no one to tell that the terminal cannot be written.
    let _ = if left < Duration::from_secs(1) {
        write!(out, ", under 1 second left")
    } else {
        write!(out, ", about {} left", HumanDuration(left))
    };
}

/// The first Ctrl-C lets searches give their best so far, and other work stop in order; the second one ends at once.
#[allow(clippy::exit, reason = "a person who presses twice wants out")]
fn interrupt() {
    if INTERRUPTED.swap(true, Ordering::Relaxed) {
        // Exit code by which a shell reports an interrupted program.
        std::process::exit(130);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Progress for Bar {
    fn stage(&self, name: &str, steps: u64) {
        self.0.set_position(0);
        self.0.reset_eta();
        self.0.set_length(steps.max(1));
        self.0.set_message(name.to_owned());
    }

    fn advance(&self, steps: u64) {
        self.0.inc(steps);
    }

    fn note(&self, text: &str) {
        self.0.println(text);
    }

    fn cancelled(&self) -> bool {
        INTERRUPTED.load(Ordering::Relaxed)
    }
}
