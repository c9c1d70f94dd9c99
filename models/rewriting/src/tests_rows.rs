//! Successors that take their place as rows, beside the same successors piece by piece; and strings in the memory of
//! others.

use crate::string::Slot;
use crate::symbol::Symbol;
use crate::{Derived, Program, Reading, Unanswered};
use phytomer_sim::random::PlantRandom;

/// The ternary tree; productions that compete, with parameters that are computed and drawn; a module that goes on in
/// the middle, brackets first and last, and a cut; what is erased, so that slots and parameters are free.
const TEXTS: [&str; 4] = [
    "ω : !(1)F(200)/(45)A\np1 : A → !(1.732)F(50)[&(18.95)F(50)A]/(94.74)[&(18.95)F(50)A]\n\
     p2 : F(l) → F(l*1.109)\np3 : !(w) → !(w*1.732)\n",
    "lsystem: 1\nAxiom: FA(1)\nA(k) --> /(90)[+(32)FA(k+1)]-(ran(20))FA(k+1) : 2/(k+1)\n\
     A(k) --> /(90)B(k,k)-(20)FA(k+1) : 1-2/(k+1)\nB(m,n) --> B(m+1,n)[+(m)A(n)]B(0,m) : 1\nendlsystem\n",
    "lsystem: 1\nAxiom: A(0)\nA(n) : n < 3 --> G(n)[+F(1)]A(n+1)[-F(2,n)]F(3)\nA(n) : n >= 3 --> [F(n)]A(0)%G(1)\n\
     G(x) --> H(x)G(x+1)H(2)\nF(x) --> [F(x+1)]\nendlsystem\n",
    "lsystem: 1\nAxiom: A(3)B(1,2)\nA(n) --> A(n)C(n,n)B(n,1)D\nB(x,y) --> *\nC(x,y) : x > 2 --> D\n\
     C(x,y) --> D[C(y,x)]\nD --> DA(1)\nendlsystem\n",
];

/// A module: where it is kept, its symbol, the bits of its parameters, whence it comes, and its bracket's other half.
type Kept = (Slot, Symbol, Vec<u64>, crate::Identity, Option<Slot>);

/// Every module of a string.
fn modules(derived: &Derived) -> Vec<Kept> {
    let string = derived.string();
    let of = |module: crate::Module<'_>| {
        let parameters = module.parameters.iter().map(|value| value.to_bits()).collect();
        (module.slot, module.symbol, parameters, module.identity, string.partner(module.slot))
    };
    string.modules().map(of).collect()
}

fn sown(program: &Program, memory: Option<Derived>) -> Derived {
    program.sow_again(memory, PlantRandom::new(3, 5), &mut Unanswered).unwrap()
}

#[test]
fn rows_make_what_pieces_make() {
    for text in TEXTS {
        let rows = Program::read(text, &Reading::of("rows")).unwrap();
        let mut pieces = Program::read(text, &Reading::of("pieces")).unwrap();
        pieces.forget_rows();
        let (mut one, mut other) = (sown(&rows, None), sown(&pieces, None));
        for step in 1..=7 {
            rows.step(&mut one, &mut Unanswered).unwrap();
            pieces.step(&mut other, &mut Unanswered).unwrap();
            assert_eq!(modules(&one), modules(&other), "{text}, step {step}");
            assert_eq!((&one.active, &one.updated, &one.cut), (&other.active, &other.updated, &other.cut));
        }
        assert!(one.string().len() > 20, "{text}");
    }
}

/// A plant in the memory of one of another program is the plant that it would be.
#[test]
fn what_was_in_the_memory_before_leaves_no_trace() {
    let programs = TEXTS.map(|text| Program::read(text, &Reading::of("memory")).unwrap());
    let mut memory = None;
    for (place, program) in programs.iter().chain(programs.iter().rev()).enumerate() {
        let (mut fresh, mut again) = (sown(program, None), sown(program, memory.take()));
        for _ in 0..6 {
            program.step(&mut fresh, &mut Unanswered).unwrap();
            program.step(&mut again, &mut Unanswered).unwrap();
            assert_eq!(modules(&again), modules(&fresh), "the program at place {place}");
        }
        memory = Some(again);
    }
}
