//! What a call writes.

use super::arguments::Arguments;
use super::files::{is_one_file, is_standard};
use super::judged::Call;
use crate::cli::print::{print, say};
use crate::cli::refusal;
use crate::cli::stop::Stop;
use drapery::compare::{Case, Ruling};
use drapery::output::{Batch, write_png, write_whole};
use drapery::{Error, Result};
use std::io::Write;
use std::path::Path;

/// Refuses outputs that are one file, before anything is read.
pub(super) fn check_names(arguments: &Arguments) -> Result<()> {
    let outputs = named(arguments);
    for (at, (name, path)) in outputs.iter().enumerate() {
        if let Some((other, _)) = outputs[..at].iter().find(|(_, other)| other == path) {
            return Err(Error::usage(format!("{other} and {name} name the same file")).help("name two"));
        }
    }
    Ok(())
}

/// Refuses outputs onto what was read.
pub(super) fn check_inputs(arguments: &Arguments, call: &Call) -> Result<()> {
    for (_, output) in named(arguments) {
        if is_standard(output) || !output.is_file() {
            continue;
        }
        for input in &call.inputs {
            if is_one_file(output, input)? {
                return Err(
                    Error::usage("this picture is compared, and would be written over").in_file(output)
                );
            }
        }
    }
    Ok(())
}

fn named(arguments: &Arguments) -> Vec<(&'static str, &Path)> {
    let Arguments { json, heatmap, .. } = arguments;
    let named = [("--json", json), ("--heatmap", heatmap)];
    named.into_iter().filter_map(|(name, path)| Some((name, path.as_deref()?))).collect()
}

/// Writes what is asked for, and the text where nothing else goes to stdout.
pub(super) fn write(arguments: &Arguments, call: &Call) -> std::result::Result<(), Stop> {
    if call.cases.ruling() == Ruling::Weak {
        say("warning: a weak pass is one, but suspect: look at what it says of the open pixels");
    }
    let mut is_told = false;
    if let Some(path) = &arguments.heatmap {
        is_told |= heat_maps(path, call)?;
    }
    if let Some(path) = &arguments.json {
        let text = call.cases.json()?;
        is_told |= file(path, &|to| to.write_all(text.as_bytes()))?;
    }
    if !is_told {
        print(&refusal::harmless(&call.cases.text()))?;
    }
    Ok(())
}

/// Writes the heat map, of a set into a folder: whether on stdout.
fn heat_maps(path: &Path, call: &Call) -> std::result::Result<bool, Stop> {
    if call.cases.set.is_none() {
        return match &call.pictures[0].heat {
            Some(map) => file(path, &|to| write_png(map, to)),
            None => {
                say("note: there is no heat map of what cannot be measured");
                Ok(false)
            }
        };
    }
    let mut batch = Batch::into(path)?;
    for (case, pictures) in call.cases.cases.iter().zip(&call.pictures) {
        if let Some(map) = &pictures.heat {
            batch.stage(&heat_name(case), |to| write_png(map, to))?;
        }
    }
    batch.commit()?;
    Ok(false)
}

/// The file of a case's heat map in a set's folder.
fn heat_name(case: &Case) -> String {
    format!("{}.heat.png", case.name)
}

/// Writes a file, or stdout: whether it was that.
fn file(
    path: &Path,
    content: &dyn Fn(&mut dyn Write) -> std::io::Result<()>,
) -> std::result::Result<bool, Stop> {
    if !is_standard(path) {
        write_whole(path, content)?;
        return Ok(false);
    }
    let mut stdout = std::io::stdout().lock();
    content(&mut stdout).and_then(|()| stdout.flush()).map_err(Stop::stdout)?;
    Ok(true)
}
