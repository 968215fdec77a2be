//! The help of the whole command line: its commands by what they are for.

use super::CommandLine;
use crate::plain_text::wrap;
use clap::{Command, CommandFactory, FromArgMatches};

/// What commands are for, with their names.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Studies", &["run", "sweep", "animate", "check", "list", "template", "schema"]),
    ("Robots", &["draw", "eval", "compare", "derive", "generate", "new", "import", "export"]),
    ("The paper", &["reproduce"]),
    ("This program", &["completions", "man"]),
];

const EXAMPLES: &str = "\
Examples:
  planar-capture run scenarios/raina_shah_2017.toml --report
  planar-capture template scenario --out mine.toml
  planar-capture check mine.toml

`planar-capture COMMAND --help` says more about a command, with examples.";

/// The arguments of this process; help and errors end it.
pub fn parse() -> CommandLine {
    CommandLine::from_arg_matches(&command_line().get_matches()).unwrap_or_else(|error| error.exit())
}

/// The command line with its help.
pub fn command_line() -> Command {
    let all = CommandLine::command();
    let groups = groups(&all);
    all.help_template(format!(
        "{{about}}\n\n{{usage-heading}} {{usage}}\n\n{groups}Options:\n{{options}}\n\n{EXAMPLES}\n"
    ))
}

/// The commands, group by group.
fn groups(all: &Command) -> String {
    let of_group = |(heading, names): &(&str, &[&str])| {
        let commands = names.iter().filter_map(|name| all.find_subcommand(name));
        let lines = commands.flat_map(|command| {
            let about = command.get_about().map(ToString::to_string).unwrap_or_default();
            wrap(&format!("  {:<12}", command.get_name()), &" ".repeat(14), &about)
        });
        format!("{heading}:\n{}\n", lines.flat_map(|line| [line, "\n".to_owned()]).collect::<String>())
    };
    GROUPS.iter().map(of_group).collect()
}

#[cfg(test)]
mod tests {
    use super::{CommandLine, GROUPS, command_line};
    use clap::{CommandFactory, Parser};

    #[test]
    fn every_command_is_in_a_group() {
        let all = CommandLine::command();
        let mut commands: Vec<_> = all.get_subcommands().map(clap::Command::get_name).collect();
        let mut grouped: Vec<_> = GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        grouped.retain(|name| cfg!(feature = "sweep") || *name != "sweep");
        commands.sort_unstable();
        grouped.sort_unstable();
        assert_eq!(commands, grouped);
    }

    /// The command lines in the examples of a help text: up to a pipe or a redirection.
    fn examples(help: &str) -> Vec<Vec<String>> {
        let parts = help.lines().flat_map(|line| line.split(" | "));
        let commands = parts.filter_map(|part| part.trim_start().strip_prefix("planar-capture "));
        let commands = commands.map(|command| command.split([',', '>', '<']).next().unwrap_or_default());
        commands.map(|command| shlex::split(command).expect("quotes in pairs")).collect()
    }

    #[test]
    fn examples_are_command_lines() {
        let mut all = command_line();
        let help = all.render_long_help().to_string();
        let (_, own) = help.split_once("Examples:").expect("examples");
        let mut texts = vec![own.split("`planar-capture").next().unwrap_or_default().to_owned()];
        for command in all.get_subcommands_mut() {
            let help = command.render_long_help().to_string();
            assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
            texts.extend(help.split_once("Examples:").map(|(_, examples)| examples.to_owned()));
            assert!(command.get_name() == "list" || help.contains("Examples:"), "{}", command.get_name());
        }
        for words in texts.iter().flat_map(|text| examples(text)) {
            let line = [vec!["planar-capture".to_owned()], words].concat();
            assert!(CommandLine::try_parse_from(&line).is_ok(), "{line:?}");
        }
    }
}
