//! Each trap of weather files in a small file of its own: what is read right, and what is told, word for word.
//!
//! The files are texts in the tests, written for them. `read` is what a day has; `told` what people see. Absent: files
//! of stations, which `measured` has, and broken bytes, which `broken` has.

use phytomer_weather::{Asked, Beyond, Day, Format, Kind, Refused, Weather, read};

fn ask(name: &str, text: impl AsRef<[u8]>, asked: &Asked) -> Result<Weather, Refused> {
    read(name, text.as_ref(), asked)
}

fn weather(name: &str, text: impl AsRef<[u8]>) -> Weather {
    ask(name, text, &Asked::default()).unwrap_or_else(|refused| panic!("{refused}"))
}

/// The faults as people see them.
fn told(name: &str, text: impl AsRef<[u8]>) -> String {
    match ask(name, text, &Asked::default()) {
        Ok(weather) => panic!("nothing is told: {weather:?}"),
        Err(refused) => refused.to_string(),
    }
}

/// Maximum, minimum and rain of each day.
fn days(weather: &Weather) -> Vec<(f64, f64, Option<f64>)> {
    weather.days().map(|day| (day.maximum, day.minimum, day.rain)).collect()
}

fn day(weather: &Weather, number: usize) -> Day {
    weather.days().nth(number).expect("a day")
}

const PLAIN: [(f64, f64, Option<f64>); 2] = [(24.8, 14.3, Some(0.0)), (22.1, 15.0, Some(1.5))];

#[test]
fn a_wth_with_all_that_is_harmless_is_read() {
    let text = "*WEATHER DATA : Estação\t\t\r\n! a comment\r\n\r\n@ INSI      LAT     LONG  ELEV   TAV   AMP REFHT WNDHT\t\r\n  \
                ABCD  -22.500   47.648   524  22.8   7.5 -99.0 -99.0\r\n@DATE  SRAD  TMAX  TMIN  RAIN  WIND   PAR\0\0\r\n\
                95001   3.4  24.8  14.3    .0  86.4      \r\n95002e  3.5  22.1  15.0   1.5  -99    Wind from Ames 8 WSW\r\n\
                \x1a      \r\n   \r\n";
    for text in [text.as_bytes().to_vec(), text.chars().map(|c| c as u8).collect(), text.replace("\r\n", "\r").into()] {
        let weather = weather("a.WTH", text);
        assert_eq!(days(&weather), PLAIN);
        assert_eq!(
            (weather.first().to_string(), weather.last().to_string()),
            ("1995-01-01".into(), "1995-01-02".into())
        );
        let (first, station) = (day(&weather, 0), &weather.station);
        assert_eq!((first.radiation, first.wind), (Some(3.4), Some(1.0)), "86.4 km/d are 1 m/s");
        assert_eq!((day(&weather, 1).wind, weather.notes.flagged_rows), (None, 1));
        assert_eq!(station.name.as_deref(), Some("ABCD"));
        assert_eq!((station.latitude, station.elevation_m), (Some(-22.5_f64.to_radians()), Some(524.0)));
        assert_eq!(weather.notes.unused, ["PAR"]);
        assert_eq!((weather.notes.absent[0].quantity, weather.notes.absent[0].days), ("wind", 1));
    }
}

#[test]
fn years_of_two_digits_and_of_four() {
    for (date, year) in [("00001", 2000), ("35001", 2035), ("36001", 1936), ("99001", 1999), ("1988001", 1988)] {
        let weather = weather("a.WTH", format!("$WEATHER\n*DAILY DATA\n@  DATE  TMAX  TMIN\n{date:>7}  24.8  14.3\n"));
        assert_eq!(weather.first().year(), year, "{date}");
    }
}

#[test]
fn columns_in_any_order_blank_shifted_or_touching_are_read_right() {
    for text in [
        "@DATE  RAIN  TMIN  SRAD  TMAX\n95001   0.0  14.3   3.4  24.8\n95002   1.5  15.0   3.4  22.1\n",
        "@DATE  SRAD  TMAX  TMIN  RAIN  DEWP\n95001         24.8  14.3   0.0\n95002         22.1  15.0   1.5\n",
        "@DATE SRAD  TMAX  TMIN  RAIN  DEWP\n95001   3.4  24.8  14.3   0.0\n95002   3.4  22.1  15.0   1.5\n",
        "@DATE  SRAD  TMAX  TMIN  RAIN\n95001 3.4 24.8 14.3 0.0\n95002 3.4 22.1 15.0 1.5\n",
        "@DATE  SRAD  TMAX  TMIN  RAIN\n95001\t3.4\t24.8\t14.3\t0.0\n95002\t3.4\t22.1\t15.0\t1.5\n",
    ] {
        assert_eq!(days(&weather("a.WTH", text)), PLAIN, "{text}");
    }
    let touching = "@DATE  SRAD  TMAX  TMIN  RAIN\n95001  8.00 -0.20-10.40  0.00\n95002  8.00 24.80 13.00113.60\n";
    assert_eq!(days(&weather("a.WTH", touching)), [(-0.2, -10.4, Some(0.0)), (24.8, 13.0, Some(113.6))]);
}

#[test]
fn what_cannot_be_known_is_told_with_its_place() {
    let rows = "@DATE  SRAD  TMAX  TMIN  RAIN\n95001   3.4  24.8  14.3   0.0\n";
    for (row, expected) in [
        (
            "95002     24.8  14.3   0.0\n",
            "a.WTH:3:11: it cannot be known which column `24.8` stands in; expected values that end below the end of \
             their header, or one for each header\n",
        ),
        (
            "95002         3.4  24.8  14.3   0.0\n",
            "a.WTH:3:33: it cannot be known which column `0.0` stands in; expected values that end below the end of \
             their header, or one for each header\n",
        ),
        (
            "95002   3.4  24.8 14.34113.6\n",
            "a.WTH:3:19: `14.34113.6` begins below the header before its own: it may be two values; expected blanks \
             between values\n",
        ),
        (
            "95002   3.4  24.8  ****   0.0\n",
            "a.WTH:3:20: the minimum temperature did not fit its column when it was written: `****`; expected a \
             number, or -99\n",
        ),
        (
            "95002   3.4  24.8  14,3   0.0\n",
            "a.WTH:3:20: the minimum temperature `14,3` has a comma; expected a decimal point, as in `12.5`\n",
        ),
        (
            "95002   3.4  99.9  14.3   0.0\n",
            "a.WTH:3:14: no station measures a maximum temperature of 99.9 °C; expected a value in [-90, 60] °C\n",
        ),
        (
            "95002   3.4   4.8  14.3   0.0\n",
            "a.WTH:3:20: the minimum of 14.3 °C is above the maximum of 4.8 °C; expected a minimum that is at most the \
             maximum of its day\n",
        ),
        (
            "95001   3.4  24.8  14.3   0.0\n",
            "a.WTH:3:1: 1995-01-01 was there before; expected the day after 1995-01-01, 1995-01-02\n",
        ),
        (
            "94365   3.4  24.8  14.3   0.0\n",
            "a.WTH:3:1: 1994-12-31 comes after 1995-01-01; expected the day after 1995-01-01, 1995-01-02\n",
        ),
        (
            "95003   3.4  24.8  14.3   0.0\n",
            "a.WTH:3:1: 1995-01-02 is missing before this row; expected a row for each day, or `gaps = { \
             interpolate_days = 1 }`\n",
        ),
        (
            "95002   3.4   -99  14.3   0.0\n95003   3.4  24.8  14.3   0.0\n",
            "a.WTH:3:1: 1995-01-02 has no maximum temperature; expected a maximum and a minimum for each day, or \
             `gaps = { interpolate_days = 1 }`\n",
        ),
        (
            "95366   3.4  24.8  14.3   0.0\n",
            "a.WTH:3:1: `95366` is no date; expected a date: two or four digits of the year and three of the day\n",
        ),
        (
            "*NOTES\n95002   3.4  24.8  14.3   0.0\n",
            "a.WTH:4:1: this row stands below no header of days: a section has ended their table; expected a line with \
             `@DATE` before it\n",
        ),
        (
            "*****   3.4  24.8  14.3   0.0\n",
            "a.WTH:3:1: `*****` is no date; expected a date: two or four digits of the year and three of the day\n",
        ),
        (
            "\x1a\n95002   3.4\n",
            "a.WTH:3:1: ^Z ends the text, and more follows; expected nothing but blanks behind it\n",
        ),
    ] {
        assert_eq!(told("a.WTH", format!("{rows}{row}")), expected);
    }
}

#[test]
fn all_faults_are_told_at_once_and_none_is_an_echo() {
    let text = "@DATE  SRAD  TMAX  TMIN  RAIN\n95001   3.4  24.8  14.3   0.0\n95xx2   3.4  24.8  14.3   0.0\n\
                95003   3.4  99.9  14.3   0.0\n95004   3.4   4.8  14.3   0.0\n95004   3.4  24.8  14.3   0.0\n\
                95006   3.4  24.8  14.3   0.0\n95007   3.4   -99   -99   0.0\n";
    let refused = ask("a.WTH", text, &Asked::default()).expect_err("six faults");
    let found: Vec<(usize, Kind)> = refused.faults.iter().map(|fault| (fault.line, fault.kind)).collect();
    let kinds = [
        (3, Kind::Unreadable),
        (4, Kind::Impossible),
        (5, Kind::Crossed),
        (6, Kind::Order),
        (7, Kind::Gap { days: 1 }),
        (8, Kind::Missing { days: 1 }),
    ];
    assert_eq!(found, kinds, "{refused}");
    for fault in &refused.faults {
        assert!(text.get(fault.bytes.clone()).is_some_and(|at| !at.is_empty()), "{fault:?}");
    }
}

#[test]
fn headers_are_told() {
    let row = "95001  3.4  24.8\n";
    for (text, expected) in [
        (
            "",
            "a.WTH:1:1: no table of days: no line begins with `@` and names a date; expected a line such as `@DATE  SRAD  TMAX  TMIN  RAIN`\n",
        ),
        (
            "@DATE  SRAD  TMXA  TMIN\n95001   3.4  24.8  14.3\n",
            "a.WTH:1:1: there is no column for the maximum temperature; expected `TMAX` for `TMXA`\n\
             a.WTH:2:1: 1995-01-01 has no maximum temperature; expected a maximum and a minimum for each day\n",
        ),
        ("@DATE  TMAX  TMAX  TMIN\n", "a.WTH:1:14: a second column `TMAX`; expected each column once\n"),
        (
            "@ INSI      LAT     LONG\n  ABCD     95.0     10.0\n@DATE  TMAX  TMIN\n95001  24.8  14.3\n",
            "a.WTH:2:12: `95.0` is no latitude; expected a number in [-90, 90]°, or -99 where it is not known\n",
        ),
    ] {
        assert_eq!(told("a.WTH", text), expected);
    }
    assert!(told("a.txt", row).contains("the ending of `a.txt` is of no weather file"));
    assert!(told("a.WTH", b"\xff\xfe@\0D\0").contains("UTF-16"));
    assert_eq!(
        ask("a.txt", "W_DATE,TMAX,TMIN\n2001-01-01,2,1\n", &Asked { format: Some(Format::Csv), ..Asked::default() })
            .map(|weather| weather.days().len()),
        Ok(1)
    );
}

#[test]
fn years_joined_to_one_file_are_of_one_station() {
    let year = |date: &str, latitude: &str| {
        format!(
            "*WEATHER\n@ INSI      LAT     LONG\n  ABCD {latitude:>8}     10.0\n@DATE  TMAX  TMIN\n{date}  24.8  14.3\n"
        )
    };
    let joined = weather("a.WTH", year("95365", "45.0") + &year("96001", "45.0"));
    assert_eq!((joined.days().len(), joined.station.latitude), (2, Some(45_f64.to_radians())));
    let told = told("a.WTH", year("95365", "45.0") + &year("96001", "46.0"));
    assert_eq!(told, "a.WTH:8:3: a second station; expected the weather of one station a file\n");
}

#[test]
fn agmip_files_have_the_wind_in_metres_a_second() {
    let text = "*WEATHER DATA : Ames\n\n@ INSI      LAT     LONG  ELEV   TAV   AMP REFHT WNDHT\n  \
                ABCD   42.017  -93.750   329   9.4  15.0   2.0   2.0\n\
                @DATE    YYYY  MM  DD  SRAD  TMAX  TMIN  RAIN  WIND  DEWP  VPRS  RHUM\n\
                1980001  1980   1   1   7.9  24.8  14.3   0.0   2.5  -5.0   4.2    81\n\
                1980002  1980   1   2   7.9  22.1  15.0   1.5   2.5  -5.0   4.2    81\n";
    let read = weather("a.AgMIP", text);
    assert_eq!(days(&read), PLAIN);
    let Day { wind, dew_point, vapour_pressure, humidity, .. } = day(&read, 0);
    assert_eq!((wind, dew_point, vapour_pressure, humidity), (Some(2.5), Some(-5.0), Some(420.0), Some(0.81)));
    let other_day = text.replace("1980   1   2", "1980   2   1");
    assert!(
        told("a.AgMIP", other_day).contains("a.AgMIP:7:1: the columns for year, month and day do not say 1980-01-02")
    );
}

#[test]
fn met_files_have_constants_units_and_comments() {
    let text = "[weather.met.weather]\n!comment\nlatitude = -27.5 (DECIMAL DEGREES) ! south\nsite = Dalby\nradn = 12.5 (MJ/m^2)\n\
                tav = 19.1 (oC)\nyear day maxt mint rain wind vp code\n () () (oC) (oC) (mm) (m/s) (hPa) ()\n\
                1995 1 24.8 14.3 0 2.5 10 222222 ! first\n1995 2 22.1 15 1.5 2.5 10 222222\n";
    let read = weather("a.met", text);
    assert_eq!(days(&read), PLAIN);
    let (day, station) = (day(&read, 1), &read.station);
    assert_eq!((day.radiation, day.wind, day.vapour_pressure), (Some(12.5), Some(2.5), Some(1000.0)));
    assert_eq!((station.name.as_deref(), station.latitude), (Some("Dalby"), Some(-27.5_f64.to_radians())));
    let year = text.replace("[weather", "year = 1995\n[weather").replace("year day", "day").replace("\n1995 ", "\n");
    assert_eq!(days(&weather("a.met", year.replace(" () () (oC)", " () (oC)"))), PLAIN);
    let dated = text.replace("year day", "date").replace("() () (oC)", "(dd/mm/yyyy) (oC)");
    let dated = dated.replace("1995 1 ", "01/01/1995 ").replace("1995 2 ", "02/01/1995 ");
    assert_eq!(days(&weather("a.met", dated)), PLAIN);
    for (from, to, expected) in [
        ("(oC) (mm)", "(oF) (mm)", "a.met:8:13: the minimum temperature is in `oF`; expected (°C), as APSIM has it"),
        ("15 1.5", "15", "a.met:10:1: this row has 7 values; expected 8, one for each column"),
        (
            "1995 2",
            "1995 366",
            "a.met:10:1: `1995 366 22.1 15 1.5 2.5 10 222222` is no date; expected a year and a day",
        ),
        (
            "radn =",
            "maxt =",
            "a.met:5:1: `maxt` stands above the rows and is a column of them too; expected one of them",
        ),
        ("year day", "yaer day", "a.met:7:1: no column tells the date; expected columns `year` and `day`, or `date`"),
    ] {
        let told = told("a.met", text.replace(from, to));
        assert!(told.contains(expected), "{expected}\n{told}");
    }
    assert!(told("a.met", "[weather]\n").contains("no line names the columns"));
}

#[test]
fn csv_has_codes_of_icasa_and_any_separator() {
    let text = "\u{feff}# from the monthly normals of a station\nW_DATE,SRAD,TMAX,TMIN,RAIN,WST_LAT,WIND,VPRSD\n\
                1995-01-01,3.4,24.8,14.3,0,-22.5,86.4,1.2\n19950102, ,\"22.1\",15.0,1.5,-22.5,NA,1.2,,\n";
    for text in [text.to_owned(), text.replace(',', "\t"), text.replace(',', ";")] {
        let read = weather("a.csv", &text);
        assert_eq!(days(&read), PLAIN, "{text}");
        let first = day(&read, 0);
        assert_eq!((first.radiation, first.wind, first.vapour_pressure), (Some(3.4), Some(1.0), Some(1200.0)));
        assert_eq!((day(&read, 1).radiation, read.station.latitude), (None, Some(-22.5_f64.to_radians())));
    }
    let commas = "W_DATE;TMAX;TMIN;RAIN\n1995-01-01;24,8;14,3;0\n1995-01-02;22,1;15;1,5\n";
    assert_eq!(days(&weather("a.csv", commas)), PLAIN);
    let parts = "YEAR,DOY,TMAX,TMIN,RAIN\n1995,1,24.8,14.3,0\n1995,2,22.1,15,1.5\n";
    assert_eq!(days(&weather("a.csv", parts)), PLAIN);
    let parts = "year,month,day,maximum-temperature,TMIN,rain\n1995,1,1,24.8,14.3,0\n1995,1,2,22.1,15,1.5\n";
    assert_eq!(days(&weather("a.csv", parts)), PLAIN);
    for (from, to, expected) in [
        ("1995,2,", "03/04/1995,2,", "a.csv:3:1: `03/04/1995` is no date"),
        (",15,1.5", ",15,1,5", "a.csv:3:1: this row has 6 values; expected 5, one for each column"),
        ("22.1", "warm", "a.csv:3:8: the maximum temperature is no number: `warm`"),
    ] {
        let base = "YEAR,DOY,TMAX,TMIN,RAIN\n1995,1,24.8,14.3,0\n1995,2,22.1,15,1.5\n";
        let told = told("a.csv", base.replace(from, to));
        assert!(told.contains(expected), "{expected}\n{told}");
    }
    let two = "WST_ID,W_DATE,TMAX,TMIN\nA,1995-01-01,2,1\nB,1995-01-02,2,1\n";
    assert!(told("a.csv", two).contains("a.csv:3:1: a second station: `B` after `A`"));
}

#[test]
fn gaps_are_filled_on_request_alone_and_noted() {
    let text = "@DATE  SRAD  TMAX  TMIN  RAIN  RHUM\n95001   2.0  20.0  10.0   1.0  80.0\n95003   -99   -99   3.0   5.0  60.0\n\
                95005   6.0  28.0  14.0   0.0  70.0\n";
    let asked = |interpolate_days| Asked { interpolate_days, ..Asked::default() };
    let read = ask("a.WTH", text, &asked(3)).unwrap_or_else(|refused| panic!("{refused}"));
    assert_eq!(
        days(&read),
        [
            (20.0, 10.0, Some(1.0)),
            (22.0, 11.0, None),
            (24.0, 3.0, Some(5.0)),
            (26.0, 13.0, None),
            (28.0, 14.0, Some(0.0))
        ]
    );
    let radiation: Vec<_> = read.days().map(|day| day.radiation).collect();
    assert_eq!(radiation, [Some(2.0), Some(3.0), None, Some(5.0), Some(6.0)], "what a row lacks is not filled");
    let notes = serde_json::to_value(&read.notes).expect("JSON");
    assert_eq!(notes["filled"], serde_json::json!([{ "from": "1995-01-02", "days": 3 }]));
    let refused = ask("a.WTH", text, &asked(2)).expect_err("three days");
    let found: Vec<Kind> = refused.faults.iter().map(|fault| fault.kind).collect();
    assert_eq!(found, [Kind::Gap { days: 1 }, Kind::Missing { days: 1 }, Kind::Gap { days: 1 }]);
    assert!(refused.to_string().contains("interpolate_days = 3"), "{refused}");
    let open = "@DATE  TMAX  TMIN\n95001   -99  10.0\n95002  20.0  10.0\n95003   -99  10.0\n";
    let refused = ask("a.WTH", open, &asked(31)).expect_err("no day before and none behind");
    assert_eq!(refused.faults.len(), 2, "{refused}");
    let measured = "@DATE  TMAX  TMIN\n95001  20.0   8.0\n95002   -99  25.0\n95003  20.0   8.0\n";
    let read = ask("a.WTH", measured, &asked(1)).unwrap_or_else(|refused| panic!("{refused}"));
    assert_eq!(days(&read)[1], (25.0, 25.0, None), "what was measured stands");
}

#[test]
fn weather_is_repeated_on_request_alone() {
    let header = "@DATE  TMAX  TMIN\n".to_owned();
    let year = |days: u32| (1..=days).fold(header.clone(), |text, day| text + &format!("95{day:03}  24.8  14.3\n"));
    let asked = Asked { beyond: Beyond::Repeat, ..Asked::default() };
    let read = ask("a.WTH", year(365), &asked).unwrap_or_else(|refused| panic!("{refused}"));
    assert!(read.day(read.last().plus(1000)).is_some());
    assert!(weather("a.WTH", year(365)).day(read.last().plus(1)).is_none());
    let refused = ask("a.WTH", year(364), &asked).expect_err("no whole year").to_string();
    let expected = "a.WTH:365:1: this weather cannot be repeated: its 364 days are no whole year; expected at least a whole \
                    year, or no `beyond`\n";
    assert_eq!(refused, expected);
}
