//! How settings for drawing from near are written: their numbers as short as they were stated.
//!
//! Settings hold single-precision numbers. Written as doubles, 0.3 would be 0.30000001192092896. Absent: the settings
//! themselves (`phytomer_looks`).

use serde::ser::Error;
use serde::{Serialize, Serializer};
use serde_json::{Number, Value as Json};

/// Writes settings, each number in the fewest digits that lead back to the same single-precision number.
pub fn shortest<T: Serialize, S: Serializer>(stated: &T, to: S) -> Result<S::Ok, S::Error> {
    let mut json = serde_json::to_value(stated).map_err(S::Error::custom)?;
    shorten(&mut json);
    json.serialize(to)
}

fn shorten(json: &mut Json) {
    match json {
        Json::Number(number) if number.is_f64() => {
            let single = number.as_f64().map(|number| number as f32);
            let short = single.and_then(|single| single.to_string().parse().ok()).and_then(Number::from_f64);
            *number = short.unwrap_or_else(|| number.clone());
        }
        Json::Array(all) => all.iter_mut().for_each(shorten),
        Json::Object(keys) => keys.values_mut().for_each(shorten),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_looks::{Blade, Near, NearStem};

    #[test]
    fn numbers_are_as_short_as_they_were_stated_and_lead_back() {
        let blade = Blade { stalk: 0.3, widest_at: 0.28, fold_deg: 8.0, wave: 0.03, ..Blade::default() };
        let written = shortest(&Some(Near::Blade(blade)), serde_json::value::Serializer).expect("settings");
        let text = written.to_string();
        for number in ["\"stalk\":0.3,", "\"widest_at\":0.28,", "\"fold_deg\":8.0,", "\"wave\":0.03,"] {
            assert!(text.contains(number), "{number}: {text}");
        }
        assert_eq!(serde_json::from_value::<Near>(written).expect("settings"), Near::Blade(blade));
        let stem = NearStem { profile: vec![[0.0, 0.7], [1.0, 1.1]], ranks: Some([2, 2]), ..NearStem::default() };
        let written = shortest(&stem, serde_json::value::Serializer).expect("settings");
        assert_eq!(written.to_string(), r#"{"profile":[[0.0,0.7],[1.0,1.1]],"ranks":[2,2]}"#);
    }
}
