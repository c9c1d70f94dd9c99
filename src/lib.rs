//! phytomer
