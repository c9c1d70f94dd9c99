//! What the verbs share of the process: its threads, and addresses as people type them.

use anyhow::{Context, Result};
use tokio::runtime::Runtime;

/// A host and a port.
pub fn host_and_port(text: &str) -> Result<(String, u16), String> {
    let pair = text.rsplit_once(':').and_then(|(host, port)| Some((host, port.parse::<u16>().ok()?)));
    pair.filter(|(host, _)| !host.is_empty())
        .map(|(host, port)| (host.to_owned(), port))
        .ok_or_else(|| "a host and a port are expected, such as 10.0.0.1:50050".to_owned())
}

/// The threads for calls and waiting.
pub fn runtime() -> Result<Runtime> {
    tokio::runtime::Builder::new_multi_thread().enable_all().build().context("cannot start the threads")
}

/// The threads of this machine.
pub fn threads_here() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
