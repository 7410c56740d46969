//! What a call writes.

use super::arguments::Arguments;
use super::files::{is_one_file, is_standard};
use super::judged::{Call, Pictures};
use crate::cli::print::{print, say};
use crate::cli::refusal;
use crate::cli::stop::Stop;
use drapery::compare::{Case, Ruling, Shown};
use drapery::output::{Batch, write_png, write_whole};
use drapery::{Error, Result};
use std::io::Write;
use std::path::{Path, PathBuf};

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
    let Arguments { json, heatmap, junit, html, .. } = arguments;
    let named = [("--json", json), ("--heatmap", heatmap), ("--junit", junit), ("--html", html)];
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
    if let Some(path) = &arguments.html {
        let text = page(call)?;
        is_told |= file(path, &|to| to.write_all(text.as_bytes()))?;
    }
    if let Some(path) = &arguments.junit {
        let text = call.cases.junit(&attachments(arguments, call));
        is_told |= file(path, &|to| to.write_all(text.as_bytes()))?;
    }
    if arguments.github {
        summarize(call)?;
    }
    if !is_told {
        print(&refusal::harmless(&call.cases.text()))?;
    }
    if arguments.github {
        let annotations = refusal::harmless(&call.cases.annotations());
        // Workflows look for them on both.
        match is_told {
            false => drop(print(&annotations)?),
            true => annotations.lines().for_each(say),
        }
    }
    Ok(())
}

fn page(call: &Call) -> Result<String> {
    let shown = |pictures: &Pictures| {
        let both = pictures.both.as_ref();
        both.map(|(expected, actual)| Shown::of(expected, actual, pictures.heat.as_ref())).transpose()
    };
    let shown = call.pictures.iter().map(shown).collect::<Result<Vec<_>>>()?;
    Ok(drapery::compare::page(&call.cases, &shown))
}

/// Of each case the files that belong to it, by the names of this call.
fn attachments(arguments: &Arguments, call: &Call) -> Vec<Vec<String>> {
    let of = |(case, pictures): (&Case, &Pictures)| {
        let heat = arguments.heatmap.as_ref().filter(|_| pictures.heat.is_some());
        let heat =
            heat.map(|path| if call.cases.set.is_some() { path.join(heat_name(case)) } else { path.clone() });
        let actual = Some(PathBuf::from(&case.actual)).filter(|path| path.is_file());
        let files = [actual, heat, arguments.html.clone()].into_iter().flatten();
        files.filter(|path| !is_standard(path)).map(|path| path.display().to_string()).collect()
    };
    call.cases.cases.iter().zip(&call.pictures).map(of).collect()
}

/// Adds the summary to what a step's file of a workflow holds already.
fn summarize(call: &Call) -> Result<()> {
    /// What GitHub takes of a step, less what a line of it may take.
    const MOST: usize = (1 << 20) - (1 << 10);
    let Some(path) = std::env::var_os("GITHUB_STEP_SUMMARY").map(PathBuf::from) else {
        say("note: there is no summary, for GITHUB_STEP_SUMMARY names no file");
        return Ok(());
    };
    let before = match std::fs::read(&path) {
        Ok(before) => before,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(Error::io("this summary cannot be read", error).in_file(&path)),
    };
    let text = call.cases.summary(MOST.saturating_sub(before.len()));
    write_whole(&path, |to| to.write_all(&before).and_then(|()| to.write_all(text.as_bytes())))
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
