//! Telling a query from another thread to stop.
//!
//! Absent: Ctrl-C, which is the program's.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::sync::Notify;

/// Stops queries; its copies stop the same ones.
#[derive(Debug, Clone, Default)]
pub struct Stop {
    told: Arc<AtomicBool>,
    wake: Arc<Notify>,
}

impl Stop {
    /// Stops the query that runs, and those that would follow.
    pub fn stop(&self) {
        self.told.store(true, Ordering::SeqCst);
        self.wake.notify_one();
    }

    /// Whether it was told to stop.
    pub fn is_stopped(&self) -> bool {
        self.told.load(Ordering::SeqCst)
    }

    /// Waits until it is told to stop.
    pub(crate) async fn stopped(&self) {
        while !self.is_stopped() {
            self.wake.notified().await;
        }
    }
}
