//! `fit.json`: all rivals with estimates, covariance, ln L, BIC, correlations, tests and notes.
//!
//! A number that is not finite is null. Absent: writing the file.

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
