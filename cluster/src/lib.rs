//! A run grown on many machines: its parts are dealt to the executors of a Ballista cluster, and become one run folder.
//!
//! `phytomer-cluster grow` makes a row for each part that is missing ([`parts`]) and a plan over these rows ([`plan`]),
//! and hands the plan to a [`scheduler`]. Each task of an [`executor`] reads its row, grows the part into a folder that
//! all machines see ([`store`]), and answers with a row. When every part is there, they are merged ([`growing`]), and
//! each file has the hash that it has after `phytomer grow`. A cluster trusts its network: nothing is encrypted, and
//! whoever reaches a port can ask for work. Absent: growth and files (`phytomer`), and what Ballista does: dealing out
//! tasks, and giving them to others when an executor is gone.

pub mod cli;
pub mod codec;
pub mod executor;
pub mod fault;
pub mod growing;
pub mod local;
pub mod order;
pub mod parts;
pub mod plan;
pub mod program;
pub mod scheduler;
pub mod store;
pub mod submission;
pub mod worker;
