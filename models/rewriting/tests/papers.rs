//! The L-systems of *Synthetic Topiary* (Prusinkiewicz, James & Měch 1994) and of chapter 2 of *The Algorithmic Beauty
//! of Plants*, as far as their strings tell: published strings, counts and closed forms.

mod common;
use common::{Turtle, counts, derive, derive_program, lines, read, string, text};
use std::collections::BTreeMap;

#[test]
fn l_system_1_has_its_four_outcomes() {
    let program = read(
        "ω : A(1)B(3)A(5)\n\
         p1 : A(x) → A(x+1) : 0.4\n\
         p2 : A(x) → B(x−1) : 0.6\n\
         p3 : A(x) < B(y) > A(z) : y < 4 → B(x+z)[A(y)]\n",
    );
    const PLANTS: u64 = 8000;
    let mut outcomes = BTreeMap::new();
    for plant in 0..PLANTS {
        let derived = derive_program(&program, plant, 1, &mut phytomer_rewriting::Unanswered);
        *outcomes.entry(text(&program, &derived)).or_insert(0_u32) += 1;
    }
    let expected = [
        ("A(2)B(6)[A(3)]A(6)", 0.16),
        ("A(2)B(6)[A(3)]B(4)", 0.24),
        ("B(0)B(6)[A(3)]A(6)", 0.24),
        ("B(0)B(6)[A(3)]B(4)", 0.36),
    ];
    assert_eq!(outcomes.len(), 4, "{outcomes:?}");
    for (outcome, share) in expected {
        let found = f64::from(outcomes[outcome]) / PLANTS as f64;
        let error = (share * (1.0 - share) / PLANTS as f64).sqrt();
        assert!((found - share).abs() < 4.0 * error, "{outcome}: {found}, not {share}");
    }
    assert!(program.warnings().is_empty(), "{:?}", program.warnings());
}

#[test]
fn l_system_2_to_the_character() {
    let program = read("ω : A\np1 : A → F(1)?P(x, y) − A\np2 : F(k) → F(k+1)\n");
    let strings = ["A", "F(1)?P(0,1)-A", "F(2)?P(0,2)-F(1)?P(1,2)-A", "F(3)?P(0,3)-F(2)?P(2,3)-F(1)?P(2,2)-A"];
    for (step, expected) in (0_u32..).zip(strings) {
        let derived = derive_program(&program, 1, step, &mut Turtle::new(90.0));
        assert_eq!(text(&program, &derived), expected, "μ{step}");
    }
}

const THIRD: &str = "ω : A\n\
    p1 : A → [+B][−B]F?P(x, y)A\n\
    p2 : B → F?P(x, y)@oB\n\
    p3 : ?P(x, y) : 4x^2 + (y − 10)^2 > 10^2\n    → [+ (2y)F] [− (2y)F] %\n";

#[test]
fn l_system_3_is_pruned_to_its_ellipse() {
    let program = read(THIRD);
    let mut turtle = Turtle::new(60.0);
    let mut derived = derive_program(&program, 1, 0, &mut turtle);
    let mut drawn = Vec::new();
    for step in 1..=30 {
        program.step(&mut derived, &mut turtle).unwrap();
        drawn.push(counts(&program, &derived).get("F").copied().unwrap_or(0));
        if step >= 23 {
            let counts = counts(&program, &derived);
            assert_eq!(derived.string().len(), 1045, "step {step}");
            assert_eq!((counts["?P"], counts["F"]), (184, 313), "step {step}");
        }
    }
    assert_eq!(drawn[..3], [1, 4, 9]);
    // 21 of the stem, which no bracket holds; 43 pairs of tentacles, which have a length; 206 of the branches.
    let (mut depth, mut of_stem, mut tentacles) = (0, 0, 0);
    for module in derived.string().modules() {
        match program.symbols().name(module.symbol) {
            "[" => depth += 1,
            "]" => depth -= 1,
            "F" if depth == 0 => of_stem += 1,
            "+" | "-" if !module.parameters.is_empty() => tentacles += 1,
            _ => {}
        }
    }
    assert_eq!((of_stem, tentacles, 313 - 21 - 2 * 43), (21, 2 * 43, 206));
}

/// As the text asks for: T is erased, branches turn by 32°, contexts see `F A B ?P S T @o` alone, and L is 5.2.
const FOURTH: &str = "#define L 5.2\n\
    consider: F A B ?P S T @o\n\
    prune(x, y) = (x < −L/2) ‖ (x > L/2) ‖ (y < 0) ‖ (y > L),\n\
    ω : FA?P(x, y)\n\
    p1 : A > ?P(x, y) : !prune(x, y) → @oF/(180)A\n\
    p2 : A > ?P(x, y) : prune(x, y) → T%\n\
    p3 : F > T → S\n\
    p4 : F > S → SF\n\
    p5 : S → ε\n\
    p6 : @o > S → [+FA?P(x, y)]\n\
    p7 : T → ε\n";

#[test]
fn l_system_4_activates_bud_after_bud() {
    let program = read(FOURTH);
    let steps = [6, 7, 8, 10, 12, 13, 14, 17, 20, 40, 75, 94];
    let internodes = [6, 5, 6, 5, 6, 7, 7, 7, 6, 12, 18, 20];
    let buds = [5, 5, 4, 4, 3, 4, 4, 3, 3, 3, 2, 0];
    let modules = [17, 16, 20, 18, 22, 25, 24, 26, 25, 52, 84, 98];
    let mut turtle = Turtle::new(32.0);
    let mut derived = derive_program(&program, 1, 0, &mut turtle);
    let mut at = 0;
    for step in 1..=94 {
        program.step(&mut derived, &mut turtle).unwrap();
        let counts = counts(&program, &derived);
        let of = |name: &str| counts.get(name).copied().unwrap_or(0);
        assert!(of("@o") > 0 || step <= 5 || step == 94, "step {step} has no dormant bud");
        if steps[at] == step {
            assert_eq!(
                (of("F"), of("@o"), derived.string().len()),
                (internodes[at], buds[at], modules[at]),
                "step {step}"
            );
            at += 1;
        }
    }
    assert_eq!(at, steps.len());
}

/// The signal S stands at (0, 5) after steps 7 and 10, and at (0, 3) after step 20.
#[test]
fn l_system_4_sends_its_signals_down() {
    let program = read(FOURTH);
    for (step, height) in [(7, 5.0), (10, 5.0), (20, 3.0)] {
        let mut turtle = Turtle::new(32.0);
        derive_program(&program, 1, step, &mut turtle);
        assert_eq!(turtle.signals.len(), 1, "step {step}");
        let [x, y, z] = turtle.signals[0];
        assert!(x.abs() < 1e-9 && (y - height).abs() < 1e-9 && z.abs() < 1e-9, "step {step}: {x} {y}");
    }
}

/// What the text says of the tree holds for sides from 5 to 5.28, and for none beyond.
#[test]
fn l_system_4_asks_for_a_box_of_its_size() {
    let told = |side: f64| {
        let program = read(&FOURTH.replace("#define L 5.2", &format!("#define L {side}")));
        let mut turtle = Turtle::new(32.0);
        let of = |step| counts(&program, &derive_program(&program, 1, step, &mut Turtle::new(32.0)));
        let last = derive_program(&program, 1, 94, &mut turtle).string().len();
        (last, of(20)["F"], of(75)["F"], of(75).get("@o").copied().unwrap_or(0))
    };
    for side in [5.0, 5.1, 5.2, 5.28] {
        assert_eq!(told(side), (98, 6, 18, 2), "{side}");
    }
    for side in [4.9, 5.29] {
        assert_ne!(told(side), (98, 6, 18, 2), "{side}");
    }
}

/// The life table of the internodes of L-system 4, by the keys of modules alone.
#[test]
fn l_system_4_has_a_life_table() {
    let program = read(FOURTH);
    let mut turtle = Turtle::new(32.0);
    let mut derived = derive_program(&program, 1, 0, &mut turtle);
    let mut lives: BTreeMap<&str, BTreeMap<u64, (u32, u32)>> = BTreeMap::new();
    for step in 0..=94 {
        if step > 0 {
            program.step(&mut derived, &mut turtle).unwrap();
        }
        for module in derived.string().modules() {
            let name = match program.symbols().name(module.symbol) {
                "F" => "F",
                "@o" => "@o",
                _ => continue,
            };
            let life = lives.entry(name).or_default().entry(module.identity.key.0).or_insert((step, step));
            assert!(life.1 + 1 >= step, "a key comes back");
            assert_eq!(module.identity.birth, life.0, "a module is born when it appears first");
            life.1 = step;
        }
    }
    let internodes = &lives["F"];
    let dead: Vec<u32> = internodes.values().filter(|life| life.1 < 94).map(|life| life.1 + 1 - life.0).collect();
    assert_eq!((internodes.len(), dead.len()), (39, 19));
    assert!(dead.iter().all(|&age| age == 2), "{dead:?}");
    let mut waits = BTreeMap::new();
    for life in lives["@o"].values().filter(|life| life.1 < 94) {
        *waits.entry(life.1 + 1 - life.0).or_insert(0) += 1;
    }
    assert_eq!(waits, BTreeMap::from([(3, 10), (8, 4), (13, 1), (18, 1), (23, 1), (48, 1), (93, 1)]));
}

#[test]
fn l_system_5_has_tips_as_the_crown_has_room() {
    let program = read(
        "#define φ 90\n#define α 32\n#define β 20\n\
         ω : FA(1)\n\
         p1 : A(k) → /(φ)[+(α)FA(k+1)] −(β)FA(k+1) :\n    min{1, (2k+1)/k^2}\n\
         p2 : A(k) → /(φ)B −(β)FA(k+1) :\n    max{0, 1 − (2k+1)/k^2}\n",
    );
    const PLANTS: u64 = 1000;
    let (mut sums, mut all) = ([0.0; 2], 0.0);
    for plant in 0..PLANTS {
        let derived = derive_program(&program, plant, 18, &mut phytomer_rewriting::Unanswered);
        let counts = counts(&program, &derived);
        let tips = counts["A"] as f64;
        sums = [sums[0] + tips, sums[1] + tips * tips];
        all += counts["F"] as f64;
    }
    let n = PLANTS as f64;
    let mean = sums[0] / n;
    let deviation = (sums[1] / n - mean * mean).sqrt();
    // 4 (n + 1)² / 9 tips, and the published deviations of tips and internodes.
    let exact = 4.0 * 19.0 * 19.0 / 9.0;
    assert!((exact - 160.44_f64).abs() < 0.01);
    assert!((mean - exact).abs() < 4.0 * 42.79 / n.sqrt(), "{mean} tips");
    assert!((deviation - 42.79).abs() < 4.0 * 42.79 / (2.0 * n).sqrt() * 1.5, "{deviation}");
    assert!((all / n - 1098.56).abs() < 4.0 * 272.04 / n.sqrt(), "{} internodes", all / n);
}

/// 4 (n + 1)² / 9 tips after n steps, from the second on.
#[test]
fn l_system_5_has_its_tips_at_every_step() {
    let program = read(
        "ω : FA(1)\np1 : A(k) → /(90)[+(32)FA(k+1)]−(20)FA(k+1) : min{1, (2k+1)/k^2}\n\
         p2 : A(k) → /(90)B−(20)FA(k+1) : max{0, 1 − (2k+1)/k^2}\n",
    );
    const PLANTS: u64 = 400;
    let mut sums = [[0.0; 2]; 13];
    for plant in 0..PLANTS {
        let mut derived = derive_program(&program, plant, 0, &mut phytomer_rewriting::Unanswered);
        for sum in &mut sums {
            let tips = counts(&program, &derived)["A"] as f64;
            *sum = [sum[0] + tips, sum[1] + tips * tips];
            program.step(&mut derived, &mut phytomer_rewriting::Unanswered).unwrap();
        }
    }
    let n = PLANTS as f64;
    for (steps, [sum, squares]) in (0_u32..).zip(sums).skip(2) {
        let (mean, exact) = (sum / n, 4.0 * f64::from((steps + 1) * (steps + 1)) / 9.0);
        let error = ((squares / n - mean * mean).max(0.0) / n).sqrt();
        assert!((mean - exact).abs() <= 4.0 * error + 1e-9, "{steps} steps: {mean} ± {error}, not {exact}");
    }
}

const SIXTH: &str = "#define φ 90\n#define α 32\n#define β 20\n#define E 6\n\
    consider: F A B ?P S T @o\n\
    prune(x, y, z) = (x < −E) ‖ (x > E) ‖ (y < 0) ‖ (y > 12) ‖ (z < −E) ‖ (z > E)\n\
    ω : FA(1)?P(x, y, z)\n\
    p1 : A(k) > ?P(x, y, z) : !prune(x, y, z) →\n    /(φ)[+(α)FA(k+1)?P(x, y, z)]−(β)FA(k+1) :\n    min{1, (2k+1)/k^2}\n\
    p2 : A(k) > ?P(x, y, z) : !prune(x, y, z) →\n    /(φ)B(k+1, k+1)−(β)FA(k+1) :\n    max{0, 1 − (2k+1)/k^2}\n\
    p3 : A(k) > ?P(x, y, z) : prune(x, y, z) → T%\n\
    p4 : F > T → S\np5 : F > S → SF\np6 : S → ε\n\
    p7 : B(m, n) > S → [+(α)FA(a*m+b*n+c)?P(x, y, z)]\n\
    p8 : B(m, n) > F → B(m+1, n)\n\
    p9 : T → ε\n";

/// Internodes of L-system 6 after 31 steps with the constants of Fig. 7: a = 1 and b = 1 with c = −5, and c = 1.
/// Expected are means with their standard errors by another interpreter. With c = −5 an apex may begin at 0 or below:
/// then 1/0 is infinite, min{1, ∞} is 1, and a weight below 0 is 0. Nothing stands a whole internode outside the cube.
#[test]
fn l_system_6_fills_its_cube() {
    const PLANTS: u64 = 100;
    for ((a, b, c), (expected, known)) in
        [((1, 0, -5), (675.0, 11.0)), ((0, 1, -5), (878.0, 15.0)), ((0, 0, 1), (1874.0, 35.0_f64))]
    {
        let program = read(&format!("#define a {a}\n#define b {b}\n#define c ({c})\n{SIXTH}"));
        let mut sums = [0.0; 2];
        for plant in 0..PLANTS {
            let mut turtle = Turtle::new(90.0);
            let derived = derive_program(&program, plant, 31, &mut turtle);
            let lines = counts(&program, &derived)["F"] as f64;
            sums = [sums[0] + lines, sums[1] + lines * lines];
            for end in &turtle.ends {
                let outside = [end[0].abs() - 6.0, end[2].abs() - 6.0, end[1] - 12.0, -end[1]];
                assert!(outside.iter().all(|&beyond| beyond < 1.0 + 1e-9), "{end:?}");
            }
        }
        let n = PLANTS as f64;
        let mean = sums[0] / n;
        let error = ((sums[1] / n - mean * mean) / n + known * known).sqrt();
        assert!((mean - expected).abs() < 4.0 * error, "{mean} ± {error}, not {expected}");
    }
}

#[test]
fn the_trees_of_honda_have_two_segments_for_each() {
    let sixth = "n = 10\n#define r1 0.9 /* contraction ratio for the trunk */\n#define r2 0.6\n#define a0 45\n#define a2 45\n\
        #define d 137.5\n#define wr 0.707\n\n\
        ω : A(1,10)\n\
        p1 : A(l,w) : * → !(w)F(l) [&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)\n\
        p2 : B(l,w) : * → !(w)F(l) [-(a2)$C(l*r2,w*wr)]C(l*r1,w*wr)\n\
        p3 : C(l,w) : * → !(w)F(l) [+(a2)$B(l*r2,w*wr)]B(l*r1,w*wr)\n";
    let program = read(sixth);
    assert_eq!(program.settings().steps, Some(10));
    let derived = derive_program(&program, 1, 10, &mut phytomer_rewriting::Unanswered);
    assert_eq!(lines(&program, &derived), (1 << 10) - 1);
}

const EIGHTH: &str = "#define d1 94.74      /* divergence angle 1 */\n#define d2 132.63\n#define a 18.95\n#define lr 1.109\n#define vr 1.732\n\n\
    ω : !(1)F(200)/(45)A\n\
    p1 : A : * → !(vr)F(50) [&(a)F(50)A]/(d1)\n      [&(a)F(50)A]/(d2) [&(a)F(50)A]\n\
    p2 : F(l) : * → F(l*lr)\n\
    p3 : !(w) : * → !(w*vr)\n";

#[test]
fn ternary_trees_have_nine_modules_for_each_power_of_three() {
    let program = read(EIGHTH);
    let mut derived = derive_program(&program, 1, 0, &mut phytomer_rewriting::Unanswered);
    for n in 1..=8 {
        program.step(&mut derived, &mut phytomer_rewriting::Unanswered).unwrap();
        let power = 3_usize.pow(n);
        assert_eq!(derived.string().len(), 9 * power - 5, "n = {n}");
        let counts = counts(&program, &derived);
        assert_eq!(counts["F"], 2 * power - 1 - usize::from(n == 0), "n = {n}");
        // w² summed over the widths that one step has made is 3ⁿ, but for the rounding of √3.
        let mut squares: BTreeMap<u32, f64> = BTreeMap::new();
        for module in derived.string().modules().filter(|module| program.symbols().name(module.symbol) == "!") {
            *squares.entry(module.identity.birth).or_insert(0.0) += module.parameters[0] * module.parameters[0];
        }
        for (birth, sum) in squares {
            assert!((sum / power as f64 - 1.0).abs() < 0.002, "n = {n}, born in {birth}: {sum}");
        }
    }
}

#[test]
fn intercalary_growth_gives_births_in_the_order_of_the_axis() {
    let (_, derived) = derive("ω : F\np1 : F → FF\n", 3);
    let births: Vec<u32> = derived.string().modules().map(|module| module.identity.birth).collect();
    assert_eq!(births, [0, 3, 2, 3, 1, 3, 2, 3]);
}

#[test]
fn koch_and_dragon() {
    assert_eq!(string("Lsystem: 1\nderivation length: 1\nAxiom: F\nF --> F+F\nendlsystem\n", 2), "F+F+F+F");
}
