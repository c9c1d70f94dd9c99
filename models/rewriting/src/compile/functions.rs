//! The functions that every program knows, and those of cpfg that none may call here, as they read files or ask for
//! windows.
//!
//! Absent: the functions of the file and of the world outside (`names`).

use crate::code::Builtin;

/// What is wrong with a function that no program here may call.
pub(super) fn forbidden(name: &str) -> Option<&'static str> {
    match name {
        "fopen" | "fclose" | "fprintf" | "fflush" | "fscanf" | "input" | "output" => Some("reads or writes files"),
        "system" | "play" | "Display" => Some("calls the system"),
        "vvXmin" | "vvXmax" | "vvYmin" | "vvYmax" | "vvZmin" | "vvZmax" | "vvScale" => Some("asks for a window"),
        _ => None,
    }
}

/// A function that every program knows, with the fewest and the most arguments. `None` as the function stands for
/// `srand` and for the number of steps.
pub(super) fn builtin(name: &str) -> Option<(Option<Builtin>, usize, usize)> {
    let of = |builtin, arguments| Some((Some(builtin), arguments, arguments));
    match name {
        "sin" => of(Builtin::Sin, 1),
        "cos" => of(Builtin::Cos, 1),
        "tan" => of(Builtin::Tan, 1),
        "asin" => of(Builtin::Asin, 1),
        "acos" => of(Builtin::Acos, 1),
        "atan" => of(Builtin::Atan, 1),
        "atan2" => of(Builtin::Atan2, 2),
        "exp" => of(Builtin::Exp, 1),
        "log" | "ln" => of(Builtin::Log, 1),
        "sqrt" => of(Builtin::Sqrt, 1),
        "floor" => of(Builtin::Floor, 1),
        "ceil" => of(Builtin::Ceil, 1),
        "trunc" => of(Builtin::Round, 1),
        "fabs" | "abs" => of(Builtin::Absolute, 1),
        "sign" => of(Builtin::Sign, 1),
        "min" => Some((Some(Builtin::Min), 1, usize::MAX)),
        "max" => Some((Some(Builtin::Max), 1, usize::MAX)),
        "ran" => of(Builtin::Uniform, 1),
        "nran" => of(Builtin::Normal, 2),
        "bran" => of(Builtin::Beta, 2),
        "biran" => of(Builtin::Binomial, 2),
        "printf" | "stop" => Some((Some(Builtin::Silent), 1, usize::MAX)),
        "srand" | "sran" => Some((None, 1, 1)),
        "GetDerivationLength" => Some((None, 0, 1)),
        _ => None,
    }
}
