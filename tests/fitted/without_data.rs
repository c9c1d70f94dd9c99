//! The behaviour of these tests where the measured counts are absent: they fail in CI unless the environment leaves
//! them out, and are skipped elsewhere with a message.
//!
//! A test of this program is run again by itself, in an environment of its own.

use crate::absent::{DATA, NONE};
use std::process::Command;

/// Whether one of these tests passes, and the stderr of its program.
fn coffee(variables: &[(&str, &str)]) -> (bool, String) {
    let test = "coffee::branches_of_the_shipped_species_die_as_measured";
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    command.args(["--exact", test]).env_remove("CI").env_remove(DATA).envs(variables.iter().copied());
    let done = command.output().expect("it starts");
    let told = String::from_utf8_lossy(&[done.stdout, done.stderr].concat()).into_owned();
    assert!(told.contains("running 1 test"), "{told}");
    (done.status.success(), told)
}

#[test]
fn absent_data_fail_in_ci_and_are_said_to_be_skipped_elsewhere() {
    let nowhere = (DATA, "/nowhere");
    for ci in ["true", "1", "yes"] {
        let (passed, told) = coffee(&[("CI", ci), nowhere]);
        assert!(!passed && told.contains("/nowhere/greenlab_published_tables.csv cannot be read"), "CI={ci}: {told}");
    }
    for (what, variables) in [
        ("no CI", vec![nowhere]),
        ("an empty CI", vec![("CI", ""), nowhere]),
        ("CI=false", vec![("CI", "false"), nowhere]),
    ] {
        let (passed, told) = coffee(&variables);
        assert!(passed && told.contains("skipped (1 so far): coffee::branches_of"), "{what}: {told}");
    }
}

#[test]
fn data_are_left_out_where_that_is_said() {
    for variables in [vec![(DATA, NONE)], vec![("CI", "true"), (DATA, NONE)]] {
        let (passed, told) = coffee(&variables);
        assert!(passed && told.contains("measured data are left out by PHYTOMER_DATA=none"), "{variables:?}: {told}");
    }
}
