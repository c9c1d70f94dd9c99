//! Macros as table functions: `at_age(10)` is the plan of the macro's body with the number in the place of its
//! parameter.
//!
//! The body is planned once, when the runs are opened, with `$1` for the parameter. Absent: the bodies
//! (`phytomer_outputs::views`).

use datafusion::catalog::{TableFunctionArgs, TableFunctionImpl, TableProvider};
use datafusion::common::{DataFusionError, ParamValues, Result, ScalarValue, plan_err};
use datafusion::datasource::ViewTable;
use datafusion::logical_expr::{Expr, LogicalPlan};
use std::sync::Arc;

/// A macro over the tables of runs.
#[derive(Debug)]
pub struct Macro {
    /// Its name.
    pub name: &'static str,
    /// The names of its parameters.
    pub parameters: &'static [&'static str],
    /// The plan of its body, with `$1` for its first parameter.
    pub plan: LogicalPlan,
}

impl TableFunctionImpl for Macro {
    fn call_with_args(&self, args: TableFunctionArgs) -> Result<Arc<dyn TableProvider>> {
        let given = args.exprs();
        let (name, parameters) = (self.name, self.parameters);
        if given.len() != parameters.len() {
            let shown = parameters.join(", ");
            return plan_err!("{name}({shown}) takes {} arguments, and {} are given", parameters.len(), given.len());
        }
        let values = given.iter().zip(parameters).map(|(value, parameter)| self.number(value, parameter));
        let values = values.collect::<Result<Vec<ScalarValue>>>()?;
        let plan = match values.is_empty() {
            true => self.plan.clone(),
            false => self.plan.clone().with_param_values(ParamValues::from(values))?,
        };
        Ok(Arc::new(ViewTable::new(plan, None)))
    }
}

impl Macro {
    /// An argument as a number. Ages and ticks are whole; a real number is equal to none or to one of them.
    fn number(&self, argument: &Expr, parameter: &str) -> Result<ScalarValue> {
        match argument {
            Expr::Literal(value, _) if value.data_type().is_numeric() => Ok(value.clone()),
            Expr::Negative(inner) => self.number(inner, parameter)?.arithmetic_negate(),
            _ => Err(DataFusionError::Plan(format!(
                "the argument `{parameter}` of {}({}) is `{argument}`; expected a number, such as {}(10)",
                self.name,
                self.parameters.join(", "),
                self.name
            ))),
        }
    }
}
