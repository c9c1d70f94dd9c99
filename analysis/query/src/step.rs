//! A step of a plan as the rules of this crate take it apart.

use datafusion::common::{DataFusionError, Result};
use datafusion::physical_plan::ExecutionPlan;
use std::sync::Arc;

/// A step of a plan, with those below it.
pub type Plan = Arc<dyn ExecutionPlan>;

/// The one step below another.
pub fn only(children: Vec<Plan>) -> Result<Plan> {
    let one = <[Plan; 1]>::try_from(children);
    one.map(|[child]| child).map_err(|_| DataFusionError::Internal("one step below is expected".to_owned()))
}
