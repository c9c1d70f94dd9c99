//! phytomer-analysis
