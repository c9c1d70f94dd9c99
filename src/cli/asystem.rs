//! `asystem`: a script of the A-system's command language, run.
//!
//! A script is read and checked before its first statement runs; with `local` it reads on from stdin. Absent: the
//! language (`phytomer_asystem`), and what its statements do (`phytomer::asystem`).

use super::{Misuse, Verdict, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::asystem::{Checked, Stage, Written, checked, checked_typing, record};
use phytomer_asystem::{Refused, Step, Typing};
use std::fs::File;
use std::io::{self, BufRead, Read};
use std::path::{Path, PathBuf};

/// The most bytes of a script.
const MOST_BYTES: u64 = 16 << 20;

/// Run a script of the A-system: trees of the geometric models by commands.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer asystem my_trees.asys --out drawn                     the pictures, drawings and meshes of its workstations
  phytomer asystem my_trees.asys --out drawn --run runs/trees    its trees as a plot in tables as well

A script is a list of statements, each ended by a semicolon, such as:
  open paper plotter;  create gmt1 oak 8 .9 .7 20 -40;  girth oak on;  exit;
All that is wrong with it is told before anything is drawn. `help;` in a script lists the commands; docs/asystem.md has
the language. With `local` a script reads on from stdin until `exit`. Files are written into the folder of --out alone.
Exit code 3 where the script is wrong.")]
pub struct Asystem {
    /// The script; `-` is stdin.
    #[arg(value_name = "SCRIPT.asys")]
    script: PathBuf,
    /// The folder of the files that it writes.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// A run folder for the tables of the trees that there are at its end, as one plot.
    #[arg(long, value_name = "DIR")]
    run: Option<PathBuf>,
}

impl Asystem {
    pub fn obey(self) -> Result<Verdict> {
        let name = self.script.display().to_string();
        let Checked { steps, mut typing } = match checked(&read(&self.script)?) {
            Ok(checked) => checked,
            Err(refused) => return Ok(refuse(&name, &refused)),
        };
        let mut stage = Stage::new(&self.out);
        obey_steps(&mut stage, &steps)?;
        if ends_in_local(&steps) {
            typed(&mut stage, &mut typing)?;
        }
        let mut last = Written::default();
        stage.end(&mut last)?;
        tell(&last)?;
        if let Some(folder) = &self.run {
            record(&stage.cast, folder).with_context(|| format!("no run in {}", folder.display()))?;
            terminal::put(&format!("{}: the trees as one plot", folder.display()))?;
        }
        Ok(Verdict::Done)
    }
}

/// Reads on from stdin, statement by statement, until `exit` or its end. What is wrong is told, and nothing of it is
/// taken.
fn typed(stage: &mut Stage, typing: &mut Typing) -> Result<()> {
    let (mut lines, mut text) = (io::stdin().lock().lines(), String::new());
    while let Some(line) = lines.next().transpose().context("cannot read stdin")? {
        text += &line;
        text.push('\n');
        if !line.trim_end().ends_with(';') {
            continue;
        }
        match checked_typing(&std::mem::take(&mut text), typing, &stage.cast) {
            Ok(steps) => {
                obey_steps(stage, &steps)?;
                if typing.has_ended() {
                    break;
                }
            }
            Err(refused) => {
                refuse("stdin", &refused);
            }
        }
    }
    Ok(())
}

fn obey_steps(stage: &mut Stage, steps: &[Step]) -> Result<()> {
    for step in steps {
        let at = || format!("in the statement of line {}, column {}", step.place.line, step.place.column);
        tell(&stage.take(step).with_context(at)?)?;
    }
    Ok(())
}

fn ends_in_local(steps: &[Step]) -> bool {
    steps.last().is_some_and(|step| step.statement == phytomer_asystem::Statement::Local)
}

fn tell(written: &Written) -> Result<()> {
    if !written.told.is_empty() {
        terminal::put(written.told.trim_end())?;
    }
    written.files.iter().try_for_each(|path| terminal::put(&path.display().to_string()))
}

fn refuse(name: &str, refused: &Refused) -> Verdict {
    for fault in &refused.faults {
        terminal::say(&format!("{name}:{fault}"));
    }
    if refused.more > 0 {
        terminal::say(&format!("and {} more", refused.more));
    }
    Verdict::Invalid
}

fn read(path: &Path) -> Result<String> {
    let wrong = || format!("cannot read {}", path.display());
    let mut bytes = Vec::new();
    let source: Box<dyn Read> =
        if path == Path::new("-") { Box::new(io::stdin()) } else { Box::new(File::open(path).with_context(wrong)?) };
    source.take(MOST_BYTES + 1).read_to_end(&mut bytes).with_context(wrong)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(Misuse(format!("{}: a script has at most {MOST_BYTES} bytes", path.display())).into());
    }
    let problem =
        || Misuse(format!("{}: this is no text in UTF-8; a script of the A-system is expected", path.display()));
    String::from_utf8(bytes).map_err(|_| problem().into())
}
