//! `dragtraffic completions` and `dragtraffic man`, both generated from the flags.

use super::output::{self, Folder};
use super::{Cli, Failure};
use clap::{Args, Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::PathBuf;

const NAME: &str = "dragtraffic";

/// Flags of `completions`.
#[derive(Args, Clone, Debug)]
pub struct CompletionsArgs {
    /// Shell to complete for.
    #[arg(value_enum)]
    shell: Shell,
}

/// Flags of `man`.
#[derive(Args, Clone, Debug)]
pub struct ManArgs {
    /// Folder for one page per command. Default: the page of the program, on standard output.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite existing pages.
    #[arg(long)]
    force: bool,
}

/// Prints the completions of a shell.
///
/// # Errors
/// Exit 1.
pub fn completions(args: CompletionsArgs) -> Result<(), Failure> {
    let mut bytes = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), NAME, &mut bytes);
    output::print(&bytes)
}

/// Prints the manual page, or writes all of them.
///
/// # Errors
/// Exit 1, 8.
pub fn man(args: ManArgs) -> Result<(), Failure> {
    let mut whole = Cli::command();
    whole.build();
    let Some(path) = &args.output else { return output::print(&page(whole, NAME)?) };
    let folder = Folder::new(path, args.force)?;
    pages(whole, NAME, &folder)
}

/// Writes the page of a command and of its subcommands.
fn pages(command: Command, name: &str, folder: &Folder) -> Result<(), Failure> {
    let own = command.get_subcommands().filter(|own| own.get_name() != "help").cloned();
    for own in own.collect::<Vec<_>>() {
        let name = format!("{name}-{}", own.get_name());
        pages(own, &name, folder)?;
    }
    folder.write(&format!("{name}.1"), &page(command, name)?).map(drop)
}

/// A page as roff. It has no date, so equal programs give equal pages.
fn page(command: Command, name: &str) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    Man::new(command)
        .title(name.to_uppercase())
        .source(format!("{NAME} {}", env!("CARGO_PKG_VERSION")))
        .render(&mut bytes)?;
    Ok(bytes)
}
