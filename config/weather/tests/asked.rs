//! The keys of `[weather]` and of degree-days, as a scenario will state them: read, refused, and told in the JSON
//! Schema.
//!
//! Absent: their place in a scenario, and the reports of faults.

use phytomer_law::fault::Path;
use phytomer_sim::site::degree_days;
use phytomer_weather::{Asked, Beyond, DegreeDays, Format, Method, Station, WeatherFile};
use serde_json::{from_value, json, to_value};

#[test]
fn what_is_not_stated_changes_nothing() {
    let plain: WeatherFile = from_value(json!({ "file": "a.WTH" })).expect("a file alone");
    assert_eq!(plain.asked(), Asked::default());
    let stated = json!({
        "file": "weather/a.txt",
        "format": "agmip",
        "gaps": { "interpolate_days": 3 },
        "beyond": "repeat",
        "latitude_deg": -20.0,
    });
    let all: WeatherFile = from_value(stated.clone()).expect("all keys");
    let asked = Asked { format: Some(Format::Agmip), interpolate_days: 3, beyond: Beyond::Repeat };
    assert_eq!((all.asked(), all.latitude_deg), (asked, Some(-20.0)));
    let known = Station { latitude: Some(0.5), longitude: Some(1.0), ..Station::default() };
    let placed = Station { latitude: Some(-20_f64.to_radians()), ..known.clone() };
    assert_eq!((all.placed(known.clone()), plain.placed(known.clone())), (placed, known));
    assert_eq!(to_value(&all).expect("JSON"), stated, "what is written is what was read");
    for wrong in [json!({}), json!({ "file": "a.WTH", "gap": 3 }), json!({ "file": "a.WTH", "beyond": "loop" })] {
        assert!(from_value::<WeatherFile>(wrong).is_err());
    }
}

#[test]
fn degree_days_must_say_their_method_and_base() {
    let sine = json!({ "method": "sine", "base_celsius": 10.0, "upper_limit_celsius": 30.0 });
    let sine: DegreeDays = from_value(sine).expect("degree-days");
    assert_eq!(
        sine.felt(),
        degree_days::DegreeDays { method: degree_days::Method::Sine, base: 10.0, upper: Some(30.0) }
    );
    assert!(sine.faults(&Path::root()).is_empty());
    for wrong in
        [json!({ "base_celsius": 10.0 }), json!({ "method": "sine" }), json!({ "method": "mean", "base_celsius": 1 })]
    {
        assert!(from_value::<DegreeDays>(wrong).is_err());
    }
    let none = DegreeDays { method: Method::Average, base_celsius: 10.0, upper_limit_celsius: Some(10.0) };
    let faults = none.faults(&Path::root().key("degree_days"));
    let told: Vec<String> = faults.iter().map(ToString::to_string).collect();
    let expected = "degree_days.upper_limit_celsius: the limit of 10 °C is not above the base of 10 °C; expected a \
                    temperature above 10 °C";
    assert_eq!(told, [expected]);
}

#[test]
fn the_schema_tells_ranges_and_words() {
    let schema = to_value(schemars::schema_for!(WeatherFile)).expect("JSON");
    assert_eq!(schema["properties"]["latitude_deg"]["minimum"], json!(-90));
    assert_eq!((&schema["additionalProperties"], &schema["required"]), (&json!(false), &json!(["file"])));
    assert_eq!(schema["$defs"]["Gaps"]["properties"]["interpolate_days"]["maximum"], json!(31));
    let methods = to_value(schemars::schema_for!(Method)).expect("JSON").to_string();
    assert!(["average", "thresholded", "sine"].iter().all(|word| methods.contains(word)), "{methods}");
}

#[test]
fn formats_are_known_by_the_endings_of_names() {
    for (name, format) in [
        ("a.WTH", Some(Format::Dssat)),
        ("dir.met/a.wth", Some(Format::Dssat)),
        ("a.AgMIP", Some(Format::Agmip)),
        ("a.met", Some(Format::Apsim)),
        ("a.CSV", Some(Format::Csv)),
        ("a.tsv", Some(Format::Csv)),
        ("a.txt", None),
        ("WTH", None),
    ] {
        assert_eq!(Format::of_name(name), format, "{name}");
    }
}
