//! The choice among rivals: the law of the least BIC, or a simpler one within 2 of it.
//!
//! A difference of less than 2 is "not worth more than a bare mention" (Kass & Raftery 1995, §3.2, on the scale of 2 ln
//! Bayes factor). All laws within 2 are rivals and are told; of them the one of the fewest parameters is taken, and of
//! equally many the one of the least BIC.

use crate::fit::Fit;

/// The largest difference of BIC between rivals.
pub const WITHIN: f64 = 2.0;

/// All fits of one data set in order of BIC, and which is taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// In order of BIC, the least first.
    pub fits: Vec<Fit>,
    /// The place of the law that is taken.
    pub taken: usize,
    /// How many of the first are within 2 of the least.
    pub rivals: usize,
}

impl Choice {
    /// The law that is taken.
    pub fn taken(&self) -> &Fit {
        &self.fits[self.taken]
    }

    /// The laws within 2 of the least BIC, but the one that is taken.
    pub fn rivals(&self) -> impl Iterator<Item = &Fit> {
        self.fits[..self.rivals].iter().enumerate().filter(|(place, _)| *place != self.taken).map(|(_, fit)| fit)
    }
}

/// Orders fits by BIC and chooses; `None` where there is none with a likelihood.
pub fn choose(mut fits: Vec<Fit>) -> Option<Choice> {
    fits.retain(|fit| fit.bic().is_some_and(f64::is_finite));
    let bic = |fit: &Fit| fit.bic().unwrap_or(f64::INFINITY);
    fits.sort_by(|a, b| bic(a).total_cmp(&bic(b)));
    let least = bic(fits.first()?);
    let rivals = fits.iter().take_while(|fit| bic(fit) <= least + WITHIN).count();
    let simplest = fits[..rivals].iter().map(|fit| fit.parameters).min()?;
    let taken = fits.iter().position(|fit| fit.parameters == simplest)?;
    Some(Choice { fits, taken, rivals })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(law: &str, log_likelihood: f64, parameters: usize) -> Fit {
        let (estimates, covariance, tests, notes) = Default::default();
        let log_likelihood = Some(log_likelihood);
        Fit { law: law.to_owned(), estimates, covariance, log_likelihood, parameters, n: 100, tests, notes }
    }

    #[test]
    fn the_simplest_of_the_rivals_is_taken() {
        let choice = choose(vec![fit("simple", -100.0, 1), fit("rich", -97.0, 2), fit("worse", -120.0, 1)]).unwrap();
        assert_eq!((choice.fits[0].law.as_str(), choice.taken().law.as_str()), ("rich", "simple"));
        assert_eq!(choice.rivals().map(|fit| fit.law.as_str()).collect::<Vec<_>>(), ["rich"]);
        let choice = choose(vec![fit("simple", -100.0, 1), fit("rich", -90.0, 2), fit("none", f64::NAN, 1)]).unwrap();
        assert_eq!((choice.taken().law.as_str(), choice.rivals, choice.fits.len()), ("rich", 1, 2));
        assert_eq!(choose(Vec::new()), None);
    }
}
