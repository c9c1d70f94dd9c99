//! The light of all sources, added up in their order while they are still followed.
//!
//! Each thread takes the next source that nobody follows yet. What it finds waits until the sources before it are
//! added: the thread that hands in the source which is due adds it, and the sources behind it that wait. So sums are
//! those of one thread to the last bit, no thread waits for another before the last source, and mostly one source a
//! thread is kept in memory, 16 bytes a wanted voxel. Absent: how a source is followed (`field`).

use super::beam::{Along, Shone};
use super::{Balance, Source};
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The sums of each voxel: its light, and the light that it keeps.
type Sums = Vec<[f64; 2]>;

/// What is added up.
struct Added {
    /// The sums; `None` while a thread adds to them.
    sums: Option<(Sums, Balance)>,
    /// The source that is added next.
    due: usize,
    /// What was found of each source, until it is added.
    waiting: Vec<Option<Shone>>,
    /// Memory of sources that are added, for those to come: the system need not clear it anew.
    rooms: Vec<Along>,
}

/// The light of all sources in so many voxels, and what becomes of it; `shone` follows one, with memory for its result.
pub(super) fn sums(
    sources: &[Source],
    voxels: usize,
    shone: impl Fn(&Source, Along) -> Shone + Sync,
) -> (Sums, Balance) {
    let added = Mutex::new(Added {
        sums: Some((vec![[0.0; 2]; voxels], Balance::default())),
        due: 0,
        waiting: sources.iter().map(|_| None).collect(),
        rooms: Vec::new(),
    });
    let next = AtomicUsize::new(0);
    let follow = |_: usize| {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(source) = sources.get(number) else { return };
            let room = lock(&added).rooms.pop().unwrap_or_default();
            hand_in(&added, sources, number, shone(source, room));
        }
    };
    let threads = rayon::current_num_threads().min(sources.len());
    (0..threads).into_par_iter().with_max_len(1).for_each(follow);
    let added = added.into_inner().unwrap_or_else(PoisonError::into_inner);
    added.sums.unwrap_or_default()
}

fn lock(added: &Mutex<Added>) -> MutexGuard<'_, Added> {
    added.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Hands in what was found of a source. The sums are taken out while they are added to, so that no thread waits.
fn hand_in(added: &Mutex<Added>, sources: &[Source], number: usize, shone: Shone) {
    let mut all = lock(added);
    all.waiting[number] = Some(shone);
    let Some((mut sums, mut balance)) = all.sums.take() else { return };
    loop {
        let due = all.due;
        let Some(shone) = all.waiting.get_mut(due).and_then(Option::take) else { break };
        all.due += 1;
        drop(all);
        balance = add(&mut sums, balance, &sources[due], &shone);
        all = lock(added);
        all.rooms.push(shone.along);
    }
    all.sums = Some((sums, balance));
}

/// Adds the light of a source to the sums of the voxels, and to what becomes of all light.
fn add(sums: &mut Sums, balance: Balance, source: &Source, shone: &Shone) -> Balance {
    // Light across a beam of 1 m² falls on 1/sine m² of level ground.
    let on_ground = source.weight / source.towards[2];
    let (of_light, of_kept) = (source.weight, on_ground * shone.section);
    for ([light, kept], [share, lost]) in sums.iter_mut().zip(&shone.along) {
        *light += of_light * share;
        *kept += of_kept * lost;
    }
    let Balance { sent, kept, stopped, passed } = shone.balance;
    let [sent, kept, stopped, passed] = [sent, kept, stopped, passed].map(|of| of * on_ground);
    balance.with(Balance { sent, kept, stopped, passed })
}
