//! De Reffye's bud model (de Reffye, Edelin, Françon, Jaeger & Puech 1988, §§2–5).

pub mod law;
