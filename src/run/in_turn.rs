//! Shards grow on all threads of the pool, one a thread: each thread takes the next shard when its own is complete.
//!
//! So there are never more shards in memory than threads, whatever their plots are: a thread that waits for others to
//! help with the plants of its plot may take up their plants and the encoding of full row groups, but never a further
//! shard. A shard is taken when there is a thread for it, so that what the writer cannot take up delays growth, and no
//! thread waits for the end of others. Absent: what is done with a shard.

use rayon::Yield;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Calls `work` for each item, on all threads of the present pool; returns the results in the order of the items.
///
/// # Errors
/// The first error in the order of the items; after an error no further item is begun.
pub fn on_all_threads<T, E>(items: &[u32], work: impl Fn(u32) -> Result<T, E> + Sync) -> Result<Vec<T>, E>
where
    T: Send,
    E: Send,
{
    let next = AtomicUsize::new(0);
    let of_thread = |_: rayon::BroadcastContext<'_>| {
        let mut done = Vec::new();
        loop {
            let place = next.fetch_add(1, Relaxed);
            let Some(item) = items.get(place) else { return done };
            let result = work(*item);
            if result.is_err() {
                next.store(items.len(), Relaxed);
            }
            done.push((place, result));
            // What other threads have left to be done: columns to encode, memory to give back.
            while rayon::yield_now() == Some(Yield::Executed) {}
        }
    };
    let mut done: Vec<(usize, Result<T, E>)> = rayon::broadcast(of_thread).into_iter().flatten().collect();
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::iter::{IntoParallelIterator, ParallelIterator};
    use std::time::Duration;

    fn pool(threads: usize) -> rayon::ThreadPool {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
    }

    /// Each item waits for help of other threads, as a plot of many plants does.
    #[test]
    fn no_more_items_are_under_way_than_there_are_threads() {
        let items: Vec<u32> = (0..60).collect();
        for threads in [1, 2, 3] {
            let (under_way, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
            let work = |item: u32| {
                most.fetch_max(under_way.fetch_add(1, Relaxed) + 1, Relaxed);
                (0..16_u32).into_par_iter().for_each(|_| std::thread::sleep(Duration::from_micros(100)));
                under_way.fetch_sub(1, Relaxed);
                Ok::<u32, ()>(2 * item)
            };
            let done = pool(threads).install(|| on_all_threads(&items, work)).unwrap();
            assert_eq!(done, items.iter().map(|item| 2 * item).collect::<Vec<_>>());
            assert!(most.into_inner() <= threads, "{threads} threads");
        }
    }

    #[test]
    fn an_error_ends_the_work_and_the_first_is_told() {
        let items: Vec<u32> = (0..1000).collect();
        let begun = AtomicUsize::new(0);
        let work = |item: u32| {
            begun.fetch_add(1, Relaxed);
            if item >= 5 { Err(item) } else { Ok(item) }
        };
        assert_eq!(pool(2).install(|| on_all_threads(&items, work)), Err(5));
        assert!(begun.into_inner() <= 8);
    }
}
