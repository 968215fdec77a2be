//! `planar-capture completions SHELL` and `planar-capture man`: the command line described to other programs.

use super::help::command_line;
use super::{CommandError, print_product};
use clap::Command;
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::Path;
use std::process::ExitCode;

const COMPLETIONS: &str = "\
Examples:
  planar-capture completions bash > ~/.local/share/bash-completion/completions/planar-capture
  planar-capture completions fish > ~/.config/fish/completions/planar-capture.fish
  planar-capture completions zsh > FOLDER_OF_FPATH/_planar-capture";

const PAGES: &str = "\
Examples:
  planar-capture man | man -l -
  planar-capture man run > planar-capture-run.1";

/// Print completions of this command line for a shell.
#[derive(Debug, clap::Args)]
#[command(after_help = COMPLETIONS)]
pub struct Completions {
    /// The shell.
    shell: Shell,
}

/// Print a manual page, of the whole command line or of one command.
#[derive(Debug, clap::Args)]
#[command(after_help = PAGES)]
pub struct Manual {
    /// The command [default: all].
    command: Option<String>,
}

/// Prints the completions.
pub fn completions(arguments: &Completions) -> Result<ExitCode, CommandError> {
    let (name, mut text) = (program(), Vec::new());
    clap_complete::generate(arguments.shell, &mut command_line(), &name, &mut text);
    let text = String::from_utf8_lossy(&text);
    let text = if arguments.shell == Shell::Bash { matched(&text, &name) } else { text.into_owned() };
    print_product(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// A script of Bash whose cases have the words that it looks for: those of a program with a hyphen in its name have others
/// (clap issue 6421), so that nothing after a command would be completed.
fn matched(script: &str, program: &str) -> String {
    let [found, wanted] = ["__subcmd__", "__"].map(|by| program.replace('-', by));
    script.replace(&format!("{found}__subcmd__"), &format!("{wanted}__subcmd__"))
}

/// Prints the page.
pub fn manual(arguments: &Manual) -> Result<ExitCode, CommandError> {
    let mut all = command_line().name(program());
    // commands know their whole names then
    all.build();
    let page = match &arguments.command {
        None => all,
        Some(name) => all.find_subcommand(name).cloned().ok_or_else(|| {
            let known: Vec<_> = all.get_subcommands().map(Command::get_name).collect();
            CommandError::Usage(format!("there is no command `{name}`, expected one of {}", known.join(", ")))
        })?,
    };
    let name = page.get_display_name().unwrap_or(page.get_name()).to_owned();
    let page = page.name(name);
    let mut text = Vec::new();
    Man::new(page.clone()).render(&mut text)?;
    print_product(&with_repetitions(&String::from_utf8_lossy(&text), &page))?;
    Ok(ExitCode::SUCCESS)
}

/// A page whose synopsis says which of the arguments may be repeated, as that of [`Man`] does not.
fn with_repetitions(page: &str, command: &Command) -> String {
    let many = command.get_positionals().filter(|one| one.get_num_args().is_some_and(|count| count.max_values() > 1));
    let names = many.flat_map(|one| one.get_value_names().unwrap_or_default());
    names.fold(page.to_owned(), |page, name| {
        let once = format!("<\\fI{name}\\fR>");
        page.replacen(&once, &format!("{once}..."), 1)
    })
}

/// The name that this program is called by, which need not be that of the command line: it may be one with robots of its
/// own.
fn program() -> String {
    let own = std::env::args_os().next();
    let name =
        own.as_deref().and_then(|path| Path::new(path).file_stem()).map(|name| name.to_string_lossy().into_owned());
    name.unwrap_or_else(|| command_line().get_name().to_owned())
}
