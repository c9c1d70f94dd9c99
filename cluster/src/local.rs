//! A cluster on this machine: a scheduler and executors as processes of their own, for as long as a run takes.
//!
//! They listen on 127.0.0.1 and end when the program that began them ends, however it ends: they read from a pipe that
//! closes then ([`ends_with_parent`]).

use anyhow::{Context, Result, bail};
use std::io::{self, BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread;

/// The processes of a cluster on this machine.
pub struct Local {
    /// HOST:PORT of the scheduler.
    pub scheduler: String,
    children: Vec<(Child, Option<ChildStdin>)>,
    /// The folder for answers.
    work: PathBuf,
}

impl Local {
    /// Starts a scheduler and executors, each with so many threads, and waits until they are ready.
    ///
    /// # Errors
    /// Where one of them ends before it is ready.
    pub fn start(executors: usize, threads: usize) -> Result<Self> {
        let work = std::env::temp_dir().join(format!("phytomer-cluster-{}", std::process::id()));
        let mut local = Self { scheduler: String::new(), children: Vec::new(), work };
        local.scheduler = local.child(&["scheduler".to_owned(), "--listen".to_owned(), "127.0.0.1:0".to_owned()])?;
        for number in 1..=executors {
            let work = local.work.join(number.to_string()).display().to_string();
            let (name, threads) = (format!("executor {number}"), threads.to_string());
            let words = ["executor", "--scheduler", &local.scheduler, "--port", "0", "--work", &work];
            let words = words.into_iter().chain(["--name", &name, "--threads", &threads]).map(ToOwned::to_owned);
            local.child(&words.collect::<Vec<_>>())?;
        }
        Ok(local)
    }

    /// Starts this program anew, and returns the last word of the line by which it says that it is ready.
    fn child(&mut self, words: &[String]) -> Result<String> {
        let program = std::env::current_exe().context("cannot tell the path of this program")?;
        let mut command = Command::new(&program);
        command.args(words).arg("--with-parent").stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().with_context(|| format!("cannot start {}", program.display()))?;
        let (pipe, said) = (child.stdin.take(), child.stdout.take());
        self.children.push((child, pipe));
        let mut line = String::new();
        BufReader::new(said.context("a pipe is missing")?)
            .read_line(&mut line)
            .context("cannot read from a process")?;
        match line.split_whitespace().last() {
            Some(word) => Ok(word.to_owned()),
            None => bail!("`phytomer-cluster {}` has ended before it was ready", words.join(" ")),
        }
    }
}

impl Drop for Local {
    fn drop(&mut self) {
        for (child, _) in self.children.iter_mut().rev() {
            // A process that has ended already cannot be ended.
            let _ = child.kill();
            let _ = child.wait();
        }
        // Nobody fetches what is left of answers.
        let _ = std::fs::remove_dir_all(&self.work);
    }
}

/// Ends this process when the one that began it has ended, and with it the other end of stdin.
pub fn ends_with_parent() {
    thread::spawn(|| {
        // An error is an end of the pipe too.
        let _ = io::copy(&mut io::stdin().lock().by_ref(), &mut io::sink());
        std::process::exit(0);
    });
}
