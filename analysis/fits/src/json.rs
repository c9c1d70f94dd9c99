//! `fit.json`: all rivals with estimates, covariance, ln L, BIC, correlations, tests and notes.
//!
//! A number that is not finite is null. Absent: writing the file.

use crate::check::Checked;
use crate::fit::{Fit, Test};
use crate::outcome::Outcome;
use serde_json::{Value, json};

fn test(test: &Test) -> Value {
    json!({"name": test.name, "statistic": test.statistic, "df": test.df, "p": test.p})
}

fn fit(fit: &Fit) -> Value {
    let estimates: Vec<Value> = fit
        .estimates
        .iter()
        .map(|e| json!({"name": e.name, "value": e.value, "error": e.error, "low": e.low, "high": e.high}))
        .collect();
    let correlated: Vec<Value> =
        fit.correlated().into_iter().map(|(a, b, r)| json!({"of": a, "with": b, "correlation": r})).collect();
    json!({"law": fit.law, "n": fit.n, "parameters": fit.parameters, "log_likelihood": fit.log_likelihood,
        "bic": fit.bic(), "estimates": estimates, "covariance": fit.covariance, "correlated": correlated,
        "tests": fit.tests.iter().map(test).collect::<Vec<_>>(), "notes": fit.notes})
}

/// The object of an outcome; `data` is the file's name, `sha256` its hash.
pub fn object(outcome: &Outcome, data: &str, sha256: &str) -> Value {
    let rivals = outcome.fits[..outcome.rivals].iter().map(|fit| fit.law.clone()).collect::<Vec<_>>();
    let stated: Vec<Value> = outcome.stated.iter().map(|key| json!({"key": key.key, "value": key.value})).collect();
    json!({"status": "done", "data": data, "data_sha256": sha256, "taken": outcome.taken().law,
        "within_2_bic": rivals, "fits": outcome.fits.iter().map(fit).collect::<Vec<_>>(),
        "tests": outcome.tests.iter().map(test).collect::<Vec<_>>(), "stated": stated})
}

/// What came of a check.
pub fn checked(checked: &Checked) -> Value {
    let parameters: Vec<Value> = checked
        .parameters
        .iter()
        .map(|p| {
            json!({"name": p.name, "drawn_from": p.truth, "bias": p.bias, "error": p.error,
                "coverage": p.coverage.map(|own| own.0), "coverage_interval": p.coverage.map(|own| own.1)})
        })
        .collect();
    let predicted = checked
        .predicted
        .as_ref()
        .map(|p| json!({"measure": p.name, "measured": p.measured, "mean_drawn": p.mean, "share_at_least": p.above}));
    let left_out: Vec<Value> = checked.left_out.iter().map(|(law, l)| json!({"law": law, "mean_ln_l": l})).collect();
    json!({"refits": checked.refits.0, "of": checked.refits.1, "parameters": parameters, "predicted": predicted,
        "left_out": left_out})
}
