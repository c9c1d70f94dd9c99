//! Work of a test on two plain threads, for tests that look at one species after another.
//!
//! A run has threads of its own: a pool that lends its threads would begin a second piece of work within the first
//! while that waits.

use std::sync::Mutex;

/// The results of a piece of work for every item, in the order of the items.
///
/// # Panics
/// Where the work panics.
pub fn each<T: Send, R: Send>(items: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    let waiting = Mutex::new(items.into_iter().enumerate());
    let next = || waiting.lock().expect("the queue does not panic").next();
    let some = || std::iter::from_fn(next).map(|(place, item)| (place, work(item))).collect::<Vec<_>>();
    let mut done = std::thread::scope(|scope| {
        let threads = [(); 2].map(|()| scope.spawn(some));
        threads.into_iter().flat_map(|thread| thread.join().expect("the work does not fail")).collect::<Vec<_>>()
    });
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}
