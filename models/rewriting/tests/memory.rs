//! The memory of a derivation, as the allocator counts it: a string is rewritten where it stands, so that the peak is
//! little more than the last string.

use peak_alloc::PeakAlloc;
use phytomer_rewriting::{Program, Reading, Unanswered};
use phytomer_sim::random::PlantRandom;

#[global_allocator]
static PEAK: PeakAlloc = PeakAlloc;

/// The ternary tree of The Algorithmic Beauty of Plants (Fig. 2.8), a program without contexts, of which a step triples
/// the string; and the same tree with a production that looks at contexts, so that all successors are made before any
/// of them takes its place. The bar of the first is 1.3 times the bytes of its last two strings.
#[test]
fn the_peak_of_a_derivation() {
    let ternary = "ω : !(1)F(200)/(45)A\np1 : A → !(1.7)F(50)[&(19)F(50)A]/(95)[&(19)F(50)A]/(133)[&(19)F(50)A]\n\
        p2 : F(l) → F(l*1.1)\np3 : !(w) → !(w*1.7)\n";
    for (more, bar) in [("", 1.3), ("p4 : Z < Z → Z\n", 3.0)] {
        let program = Program::read(&format!("{ternary}{more}"), &Reading::of("ternary")).expect("a program");
        let mut derived = program.sow(PlantRandom::new(1, 1), &mut Unanswered).expect("an axiom");
        PEAK.reset_peak_usage();
        let before = PEAK.current_usage();
        let mut last_two = [0, 0];
        for _ in 0..9 {
            program.step(&mut derived, &mut Unanswered).expect("a step");
            last_two = [last_two[1], derived.string().bytes()];
        }
        let peak = PEAK.peak_usage() - before;
        let strings: usize = last_two.iter().sum();
        assert_eq!(derived.string().len(), 9 * 3_usize.pow(9) - 5);
        let ratio = peak as f64 / strings as f64;
        println!("peak {ratio:.2} of the last two strings{more:?}");
        assert!(ratio <= bar, "{peak} bytes for {last_two:?}");
    }
}
