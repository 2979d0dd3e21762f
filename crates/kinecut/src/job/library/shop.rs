//! The tool files of a job, and which of their tools it takes: those that its operations and programs call.

use std::collections::BTreeSet;

use super::program::{called_numbers, without_comments};
use super::{Library, LibraryTool, read_library};
use crate::base::{Code, Error, FileKind, Finding, Loader, Location, Result, Sources};
use crate::job::cutting::{ShopTable, take_data};
use crate::job::file::{JobFile, ToolTable};
use crate::job::places::Places;
use crate::nc::Control;
use crate::operations::{CalledTool, OperationTable, plain_name};

/// Least likeness of a name that is proposed.
const ALIKE: f64 = 0.7;
/// Most names that are proposed.
const PROPOSED: usize = 3;

/// The tool files of a job.
#[derive(Clone, Debug, Default)]
pub(in crate::job) struct Shop {
    libraries: Vec<Library>,
    /// Whether each tool of each file can be used.
    valid: Vec<Vec<bool>>,
    /// Tools of the job itself.
    own: usize,
    /// Tools of the files that were taken: file, tool, number.
    taken: Vec<(usize, usize, u32)>,
    /// Holders of the files that were taken: file, holder, name in the job.
    holders: Vec<(usize, usize, String)>,
    /// Numbers of tools of the job that were taken before those of a file.
    replaced: BTreeSet<u32>,
    /// Numbers that a program calls and several tools of files have: none of them was taken.
    open: BTreeSet<u32>,
}

impl Shop {
    /// Reads the tool files that a job names; `places` are those of the job.
    pub(in crate::job) fn read(
        sources: &mut Sources,
        file: &mut JobFile,
        places: &Places,
        loader: &dyn Loader,
    ) -> Result<Shop> {
        let entries = file.libraries.as_ref().map(|files| files.tables()).unwrap_or_default();
        let mut shop = Shop { own: file.tools.len(), ..Shop::default() };
        for (k, entry) in entries.iter().enumerate() {
            let key = if entries.len() == 1 { "tools".to_owned() } else { format!("tools[{k}]") };
            let library = read_library(sources, entry, loader);
            let library = library.map_err(|e| places.locate(sources, e.under(&key)))?;
            for name in &library.files {
                if !file.tool_files.contains(name) {
                    file.tool_files.push(name.clone());
                }
            }
            shop.valid.push(library.checked().iter().map(Option::is_some).collect());
            shop.libraries.push(library);
        }
        Ok(shop)
    }

    /// Takes what the operations and the programs of a job call; operations call by number from then on.
    pub(in crate::job) fn fill(
        &mut self,
        file: &mut JobFile,
        places: &mut Places,
        table: &ShopTable,
        loader: &dyn Loader,
    ) -> Result<()> {
        let mut setups = std::mem::take(&mut file.setups);
        for (s, setup) in setups.iter_mut().enumerate() {
            for (o, operation) in setup.operations.iter_mut().enumerate() {
                let key = format!("setup[{s}].operation[{o}]");
                let called = operation.called().clone();
                if let Some(number) = self.call(file, places, &called).map_err(|e| e.under(&key))? {
                    *operation.called() = CalledTool::Number(number);
                    self.choose_data(file, operation, (s, o), number, table).map_err(|e| e.under(&key))?;
                }
            }
            let Some(program) = setup.program.as_ref().filter(|_| !self.libraries.is_empty()) else {
                continue;
            };
            // A program that cannot be read is an error of its own, later.
            let Ok(bytes) = loader.read_as(&program.file, FileKind::Program) else { continue };
            let mut texts = vec![String::from_utf8_lossy(&bytes).into_owned()];
            let control = Control::parse(program.control.as_deref().unwrap_or(&file.post.control));
            if let Ok(control) = control {
                let called =
                    crate::job::subprograms(&program.file, &texts[0], control, &program.subprograms, loader);
                texts.extend(called.into_iter().map(|called| called.text.to_string()));
            }
            for text in texts {
                self.call_program(file, places, &text)
                    .map_err(|e| e.under(&format!("setup[{s}].program")))?;
            }
        }
        file.setups = setups;
        Ok(())
    }

    /// Takes the tools that the text of a program may call, as far as they can be used. One that is wrong is an error only where
    /// the program certainly calls it: a number may be in a comment.
    pub(in crate::job) fn call_program(
        &mut self,
        file: &mut JobFile,
        places: &mut Places,
        text: &str,
    ) -> Result<()> {
        let (numbers, certain) = (called_numbers(text), called_numbers(&without_comments(text)));
        let is_called = |tool: &LibraryTool| {
            let number = tool.table.number;
            tool.has("number") && numbers.as_ref().is_none_or(|numbers| numbers.contains(&number))
        };
        let all = self.libraries.iter().flat_map(|library| &library.tools);
        let called: BTreeSet<u32> = all.filter(|t| is_called(t)).map(|t| t.table.number).collect();
        for number in called {
            if self.is_own(file, number) || self.taken.iter().any(|(.., taken)| *taken == number) {
                continue;
            }
            let certain = certain.as_ref().is_some_and(|numbers| numbers.contains(&number));
            let found = self.of_number(number);
            let valid: Vec<(usize, usize)> =
                found.iter().copied().filter(|&(k, i)| self.valid[k][i]).collect();
            // A tool that lacks something is missed by the program, if that calls it.
            let complete = |&(k, i): &(usize, usize)| self.libraries[k].tools[i].missing.is_empty();
            let fit = match valid.is_empty() && certain {
                true => found.into_iter().filter(complete).collect(),
                false => valid,
            };
            match fit[..] {
                [one] => _ = self.take(file, places, one)?,
                [] => {}
                _ if certain => _ = self.open.insert(number),
                _ => {}
            }
        }
        Ok(())
    }

    /// The number of a tool that is called, taken if a file has it; `None` where nothing has this number.
    pub(in crate::job) fn call(
        &mut self,
        file: &mut JobFile,
        places: &mut Places,
        called: &CalledTool,
    ) -> Result<Option<u32>> {
        let found = match called {
            CalledTool::Number(number) if self.is_own(file, *number) => {
                if !self.of_number(*number).is_empty() {
                    self.replaced.insert(*number);
                }
                return Ok(Some(*number));
            }
            CalledTool::Number(number) => self.of_number(*number),
            CalledTool::Name(_) => {
                let own: Vec<&ToolTable> = file.tools[..self.own]
                    .iter()
                    .filter(|tool| tool.name.as_deref().is_some_and(|name| called.is_name(name)))
                    .collect();
                let found = self.of_name(file, called);
                match (&own[..], found.is_empty()) {
                    ([one], true) => return Ok(Some(one.number)),
                    ([], _) => found,
                    _ => {
                        let mut all: Vec<String> =
                            own.iter().map(|tool| format!("T{} of the job", tool.number)).collect();
                        all.extend(found.iter().map(|&at| self.title(at)));
                        return Err(several(called, &all));
                    }
                }
            }
        };
        match &found[..] {
            [one] => self.take(file, places, *one).map(Some),
            [] => match called {
                CalledTool::Number(_) if self.libraries.is_empty() => Ok(None),
                _ => Err(self.unknown(file, called).into()),
            },
            more => Err(several(called, &more.iter().map(|&at| self.title(at)).collect::<Vec<_>>())),
        }
    }

    /// The tools that can be taken: those of the job, and those of the files that have a number and lack nothing.
    pub(in crate::job) fn usable<'a>(&'a self, file: &'a JobFile) -> Vec<&'a ToolTable> {
        let own = &file.tools[..self.own];
        let is_free = |tool: &&ToolTable| own.iter().all(|other| other.number != tool.number);
        let of_file = |(k, library): (usize, &'a Library)| -> Vec<&'a ToolTable> {
            let tools = library.tools.iter().zip(&self.valid[k]);
            let usable =
                tools.filter(|(tool, valid)| **valid && tool.missing.is_empty() && tool.has("number"));
            usable.map(|(tool, _)| &tool.table).collect()
        };
        own.iter().chain(self.libraries.iter().enumerate().flat_map(of_file).filter(is_free)).collect()
    }

    /// Words for where its tools are: "`shop.toml`", "the job".
    pub(in crate::job) fn place(&self) -> String {
        let mut places: Vec<String> =
            self.libraries.iter().map(|library| format!("`{}`", library.file)).collect();
        if self.own > 0 || places.is_empty() {
            places.insert(0, "the job".to_owned());
        }
        places.join(" and ")
    }

    fn is_own(&self, file: &JobFile, number: u32) -> bool {
        file.tools[..self.own].iter().any(|tool| tool.number == number)
    }

    /// The tools of files, each as number of the file and of the tool, that a rule accepts.
    fn all(&self, accept: impl Fn(&LibraryTool) -> bool) -> Vec<(usize, usize)> {
        let of_file = |(k, library): (usize, &Library)| -> Vec<(usize, usize)> {
            let tools = library.tools.iter().enumerate().filter(|(_, tool)| accept(tool));
            tools.map(|(i, _)| (k, i)).collect()
        };
        self.libraries.iter().enumerate().flat_map(of_file).collect()
    }

    fn of_number(&self, number: u32) -> Vec<(usize, usize)> {
        self.all(|tool| tool.has("number") && tool.table.number == number)
    }

    /// The tools of a name, but for those whose number a tool of the job has.
    fn of_name(&self, file: &JobFile, called: &CalledTool) -> Vec<(usize, usize)> {
        self.all(|tool| {
            let named = tool.table.name.as_deref().is_some_and(|name| called.is_name(name));
            named && !(tool.has("number") && self.is_own(file, tool.table.number))
        })
    }

    fn title(&self, (k, i): (usize, usize)) -> String {
        format!("{} of `{}`", self.libraries[k].tools[i].title(), self.libraries[k].file)
    }

    /// Takes a tool of a file into the job, with its holder; its number.
    fn take(&mut self, file: &mut JobFile, places: &mut Places, at: (usize, usize)) -> Result<u32> {
        let (k, i) = at;
        let (library, tool) = (&self.libraries[k], &self.libraries[k].tools[i]);
        let number = tool.table.number;
        if self.taken.iter().any(|&(file, tool, _)| (file, tool) == at) {
            return Ok(number);
        }
        if !tool.missing.is_empty() {
            let message = format!("{}, and `{}` does not tell it", tool.lack(), library.file);
            let help = "write the tool as [[tool]] in the job, or make a TOML file of the tools with `kinecut tools`";
            return Err(Finding::error(Code::TOOL_FILE, message).help(help).key("tool").into());
        }
        if let Some(&(file, tool, _)) = self.taken.iter().find(|(_, _, other)| *other == number) {
            let message = format!("{} and {} have one number", self.title((file, tool)), self.title(at));
            let help = "give one of them another number, or write it as [[tool]] in the job";
            return Err(Finding::error(Code::JOB_VALUE, message).help(help).key("tool").into());
        }
        let mut table = tool.table.clone();
        let key = format!("tool[{}]", file.tools.len());
        if let Some(own) = &library.places {
            places.include_part(&key, own, &format!("tool[{i}]"));
        }
        let named = table.holder.as_deref();
        if let Some(at) = library.holders.iter().position(|holder| Some(holder.name.as_str()) == named) {
            table.holder = Some(self.take_holder(file, places, (k, at)));
        }
        file.tools.push(table);
        self.taken.push((k, i, number));
        Ok(number)
    }

    /// Takes a holder of a file into the job; its name there.
    fn take_holder(&mut self, file: &mut JobFile, places: &mut Places, at: (usize, usize)) -> String {
        if let Some((.., name)) = self.holders.iter().find(|(k, i, _)| (*k, *i) == at) {
            return name.clone();
        }
        let library = &self.libraries[at.0];
        let mut holder = library.holders[at.1].clone();
        let is_there = |name: &str| file.holders.iter().any(|other| other.name == name);
        let plain = holder.name.clone();
        for number in 2.. {
            if !is_there(&holder.name) {
                break;
            }
            holder.name = format!("{plain} ({number})");
        }
        if let Some(own) = &library.places {
            places.include_part(
                &format!("holder[{}]", file.holders.len()),
                own,
                &format!("holder[{}]", at.1),
            );
        }
        self.holders.push((at.0, at.1, holder.name.clone()));
        file.holders.push(holder);
        file.holders.last().map(|holder| holder.name.clone()).unwrap_or_default()
    }

    /// The error of a tool that is nowhere, with the nearest that are there.
    fn unknown(&self, file: &JobFile, called: &CalledTool) -> Finding {
        let own = file.tools[..self.own].iter().map(|tool| (tool.name.as_deref(), Some(tool.number)));
        let tools = self.libraries.iter().flat_map(|library| &library.tools);
        let others = tools.map(|t| (t.table.name.as_deref(), t.has("number").then_some(t.table.number)));
        let all: Vec<(Option<&str>, Option<u32>)> = own.chain(others).collect();
        let finding = Finding::error(Code::JOB_REFERENCE, format!("{called} is not defined")).key("tool");
        let help = match called {
            CalledTool::Number(number) => {
                let mut numbers: Vec<u32> = all.iter().filter_map(|(_, number)| *number).collect();
                numbers.sort_by_key(|n| (n.abs_diff(*number), *n));
                let near: Vec<String> = numbers.iter().take(PROPOSED).map(|n| format!("T{n}")).collect();
                if near.is_empty() { String::new() } else { format!("; the nearest are {}", near.join(", ")) }
            }
            CalledTool::Name(name) => {
                let plain = plain_name(name);
                let like = |other: &str| strsim::jaro_winkler(&plain, &plain_name(other));
                let mut names: Vec<(f64, &str)> =
                    all.iter().filter_map(|(name, _)| name.map(|name| (like(name), name))).collect();
                names.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
                names.dedup();
                let near: Vec<String> = names
                    .iter()
                    .filter(|(alike, _)| *alike > ALIKE)
                    .take(PROPOSED)
                    .map(|(_, name)| format!("`{}`", name.escape_debug()))
                    .collect();
                if near.is_empty() { String::new() } else { format!("; did you mean {}?", near.join(" or ")) }
            }
        };
        let files: Vec<String> = self.libraries.iter().map(|library| format!("`{}`", library.file)).collect();
        let place = if files.is_empty() { String::new() } else { format!(", or in {}", files.join(" or ")) };
        finding.help(format!("define it with [[tool]]{place}{help}"))
    }

    /// Gives an operation the cutting data that it lacks, for the material of the job.
    fn choose_data(
        &self,
        file: &mut JobFile,
        operation: &mut OperationTable,
        at: (usize, usize),
        number: u32,
        table: &ShopTable,
    ) -> Result<()> {
        let Some(material) = &file.material else { return Ok(()) };
        let Some((index, tool)) = file.tools.iter().enumerate().find(|(_, t)| t.number == number) else {
            return Ok(());
        };
        let of = index.checked_sub(self.own).and_then(|i| self.taken.get(i));
        let of = of.map(|&(k, ..)| self.libraries[k].file.as_str());
        let taken = take_data(operation, at, (tool, of), (material, table))?;
        file.taken.extend(taken);
        Ok(())
    }

    /// Findings about what was taken, without their places.
    pub(in crate::job) fn notes(&self) -> Vec<Finding> {
        let mut notes = Vec::new();
        for number in &self.replaced {
            let files: BTreeSet<&str> =
                self.of_number(*number).iter().map(|&(k, _)| self.libraries[k].file.as_str()).collect();
            let files: Vec<String> = files.iter().map(|file| format!("`{file}`")).collect();
            let message = format!("T{number} is that of the job, not that of {}", files.join(" or "));
            notes.push(Finding::note(Code::TOOL_CHOSEN, message));
        }
        for number in &self.open {
            let all: Vec<String> = self.of_number(*number).iter().map(|&at| self.title(at)).collect();
            let message =
                format!("a program calls T{number}, and several tools have this number: {}", all.join(", "));
            let help = "it gets none of them: keep one in the tool files, or write it as [[tool]] in the job";
            notes.push(Finding::note(Code::TOOL_CHOSEN, message).help(help));
        }
        for &(k, i, _) in &self.taken {
            let (library, tool) = (&self.libraries[k], &self.libraries[k].tools[i]);
            let place = || Location::whole_file(&*library.file);
            if !tool.dropped.is_empty() {
                let message = format!("not taken of {}: {}", tool.title(), tool.dropped.join(", "));
                notes.push(Finding::note(Code::TOOL_FIELDS, message).at(place()));
            }
            if !tool.assumed.is_empty() {
                let message = format!("assumed of {}: {}", tool.title(), tool.assumed.join(", "));
                let help = "write it as [[tool]] in the job, where nothing is left open";
                notes.push(Finding::doubt(Code::TOOL_ASSUMED, message).help(help).at(place()));
            }
        }
        notes
    }
}

/// The error of a name or number that several tools have.
fn several(called: &CalledTool, all: &[String]) -> Error {
    let what = if matches!(called, CalledTool::Number(_)) { "number" } else { "name" };
    Finding::error(
        Code::JOB_REFERENCE,
        format!("{called} is the {what} of several tools: {}", all.join(", ")),
    )
    .help("call it by what only one of them has, or write it as [[tool]] in the job")
    .key("tool")
    .into()
}
