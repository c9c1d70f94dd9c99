//! phytomer-outputs
