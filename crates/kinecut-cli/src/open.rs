//! The verb `open`: the workbench.

use std::io;
use std::path::{Path, PathBuf};

use kinecut::base::{Code, Error, Finding, Location};
use kinecut::verbs::json_document;
use kinecut_web::{Server, ServerWants, browser};
use serde::Serialize;

use crate::FINE;
use crate::printing::Printing;
use crate::show::{self, complain, put};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The workbench is a page of this program: it is served on this machine alone, to who has the address, and needs no network.
It reads and writes below the folder and nothing else. Ctrl-C ends it; what is not saved stays in the page."
)]
pub(crate) struct Open {
    /// A folder, or a job or a program to open first: then its folder
    #[arg(default_value = ".", value_name = "FOLDER|JOB|PROGRAM")]
    path: PathBuf,
    /// Port; 0 takes any that is free
    #[arg(long, value_name = "N", default_value_t = 0)]
    port: u16,
    /// Print the address and open no browser
    #[arg(long)]
    no_browser: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Opened {
    folder: String,
    address: String,
}

impl Open {
    /// Serves the workbench until Ctrl-C.
    pub(crate) fn answer(&self, args: &Printing) -> Result<u8, Error> {
        let (folder, open) = self.folder()?;
        let wants = ServerWants { open, port: self.port, ..ServerWants::default() };
        let server = Server::bind(&folder, &wants).map_err(|e| self.cannot(&e))?;
        let stop = server.stop();
        // Without a handler Ctrl-C ends the program at once, as it always did.
        let _ = ctrlc::set_handler(move || stop.now());
        let address = server.address();
        match args.json {
            true => show::json(&json_document(&Opened {
                folder: folder.display().to_string(),
                address: address.clone(),
            })),
            false => {
                put(format!("kinecut workbench of {}\n  {address}\nCtrl-C ends it.\n", folder.display()))
            }
        }
        if !self.no_browser
            && let Err(e) = browser::open(&address)
        {
            complain(format!("no browser could be opened ({e}): open the address yourself"));
        }
        server.run().map_err(|e| self.cannot(&e))?;
        Ok(FINE)
    }

    /// The folder, and the file to open first.
    fn folder(&self) -> Result<(PathBuf, Option<String>), Error> {
        let whole = self.path.canonicalize().map_err(|e| self.cannot(&e))?;
        if whole.is_dir() {
            let job = ["job.toml"].into_iter().find(|name| whole.join(name).is_file());
            return Ok((whole.clone(), job.map(str::to_owned)));
        }
        let name = whole.file_name().map(|name| name.to_string_lossy().into_owned());
        Ok((whole.parent().map_or_else(|| whole.clone(), Path::to_owned), name))
    }

    fn cannot(&self, e: &io::Error) -> Error {
        let shown = self.path.display().to_string();
        let (what, help) = match e.kind() {
            io::ErrorKind::AddrInUse => {
                (format!("port {} is taken", self.port), "leave --port out: any free one is then taken")
            }
            _ => (format!("cannot open `{shown}`: {e}"), "give a folder, a job or a program"),
        };
        Finding::error(Code::FILE_NOT_READ, what).at(Location::whole_file(shown)).help(help).into()
    }
}
