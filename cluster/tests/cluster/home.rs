//! A folder of a test with processes that end with it, and the run that its scenario has without a cluster.

use phytomer::run::{self, Progress, Settings};
use phytomer_cluster::order::Stated;
use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

const PROGRAM: &str = env!("CARGO_BIN_EXE_phytomer-cluster");

/// Twelve parts of four plants, with meshes.
pub fn stated() -> Stated {
    let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/runs/parts.toml");
    let scenario = fs::canonicalize(scenario).expect("the scenario").display().to_string();
    Stated { scenario, seed: None, plants: Some(48) }
}

/// A process that is killed with the value.
pub struct Process(pub Child);

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A scheduler, and where it listens.
pub struct Scheduler {
    pub address: String,
    pub process: Process,
}

/// What a process said.
pub struct Said {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Said {
    fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Self { code: output.status.code(), stdout: text(&output.stdout), stderr: text(&output.stderr) }
    }

    pub fn ending(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "stdout:\n{}\nstderr:\n{}", self.stdout, self.stderr);
        self
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.stdout))
    }
}

/// A folder for runs.
pub struct Home(TempDir);

impl Home {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The files of the run that one process grows.
    pub fn whole(&self) -> BTreeMap<String, Vec<u8>> {
        let folder = self.path("whole");
        if !folder.exists() {
            let resolved = stated().resolved().unwrap_or_else(|report| panic!("{}", report.render(false)));
            let settings = Settings { threads: 2, ..Settings::in_folder(&folder) };
            run::run(&resolved, &settings, &Progress::default()).expect("a run");
        }
        contents(&folder)
    }

    fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(PROGRAM);
        command.args(words).current_dir(self.0.path()).stdin(Stdio::null());
        command
    }

    /// Starts a process and reads the line by which it says that it is ready.
    fn ready(&self, words: &[&str]) -> (Process, String) {
        let mut command = self.command(words);
        let mut process = Process(command.stdout(Stdio::piped()).spawn().expect("a process"));
        let mut line = String::new();
        BufReader::new(process.0.stdout.take().expect("a pipe")).read_line(&mut line).expect("a line");
        (process, line)
    }

    /// A scheduler that gives executors up soon.
    pub fn scheduler(&self) -> Scheduler {
        self.scheduler_at("127.0.0.1:0")
    }

    pub fn scheduler_at(&self, address: &str) -> Scheduler {
        let (process, line) = self.ready(&["scheduler", "--listen", address, "--executor-timeout", "6"]);
        let address = line.split_whitespace().last().expect("an address").to_owned();
        Scheduler { address, process }
    }

    pub fn executor(&self, scheduler: &Scheduler, name: &str) -> Process {
        let words = ["executor", "--scheduler", &scheduler.address, "--port", "0", "--threads", "1", "--work", "work"];
        let (process, line) = self.ready(&[&words[..], &["--name", name]].concat());
        assert!(line.contains("answers on port"), "{line}");
        process
    }

    fn words_of_grow<'a>(stated: &'a Stated, more: &[&'a str]) -> Vec<&'a str> {
        [&["grow", &stated.scenario, "--plants", "48"], more].concat()
    }

    pub fn grow(&self, more: &[&str]) -> Said {
        self.run(&Self::words_of_grow(&stated(), more))
    }

    pub fn start_grow(&self, more: &[&str]) -> Process {
        let stated = stated();
        let mut command = self.command(&Self::words_of_grow(&stated, more));
        Process(command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("a process"))
    }

    pub fn run(&self, words: &[&str]) -> Said {
        Said::of(&self.command(words).output().expect("a process"))
    }

    /// How many parts of a run have their names.
    pub fn parts_of(&self, run: &str) -> usize {
        let Ok(entries) = fs::read_dir(self.path(&format!("{run}.parts"))) else { return 0 };
        let names = entries.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()));
        names.filter(|name| !name.starts_with('.') && name.contains('-')).count()
    }
}

/// Every file of a run folder by its path there; of `run.json` all but what depends on the time. The lock is left out.
pub fn contents(run: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut contents = BTreeMap::new();
    let mut folders = vec![run.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            let name = path.strip_prefix(run).expect("below the run").display().to_string();
            if path.is_dir() {
                folders.push(path);
            } else if name != "run.lock" {
                contents.insert(name, fs::read(&path).expect("a readable file"));
            }
        }
    }
    let text = contents.get("run.json").expect("run.json");
    let mut json: serde_json::Map<String, serde_json::Value> = serde_json::from_slice(text).expect("JSON");
    assert_eq!(json["status"], "complete");
    ["timings_s", "check"].iter().for_each(|key| _ = json.remove(*key));
    contents.insert("run.json".to_owned(), serde_json::to_vec(&json).expect("JSON"));
    contents
}

/// Sends a signal by its name.
#[cfg(unix)]
pub fn signal(process: &Child, name: &str) {
    let sent = Command::new("kill").args([&format!("-{name}"), &process.id().to_string()]).status().expect("kill");
    assert!(sent.success());
}
