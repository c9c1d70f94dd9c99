//! The estimators against measured plants: every figure was found by an independent program.
//!
//! The counts are outside the project (`absent`): without them the tests fail in CI, and are skipped elsewhere. Absent:
//! simulated data (`coverage`).

#[path = "../../../tests/program/absent.rs"]
mod absent;
#[path = "measured/apple.rs"]
mod apple;
#[path = "measured/coffee.rs"]
mod coffee;
#[path = "measured/nodes.rs"]
mod nodes;
#[path = "measured/robusta.rs"]
mod robusta;
#[path = "measured/table.rs"]
mod table;
