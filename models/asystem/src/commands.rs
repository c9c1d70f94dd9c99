//! The commands, with their operands and what each does: what `help` tells.

/// A command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Command {
    /// Its word.
    pub word: &'static str,
    /// Its operands, as the appendix writes them.
    pub operands: &'static str,
    /// What it does, in a sentence.
    pub about: &'static str,
}

const fn command(word: &'static str, operands: &'static str, about: &'static str) -> Command {
    Command { word, operands, about }
}

/// All commands, in the order of the appendix's operations.
pub const COMMANDS: [Command; 46] = [
    command("create", "type tree level descriptor", "Makes a tree of this type and growth level."),
    command("delete", "tree", "Takes a tree away."),
    command("copy", "tree1 tree2", "Makes a tree like the first, under the second name."),
    command("abs_translate", "tree x y z", "Moves a tree to this place."),
    command("rel_translate", "tree x y z", "Moves a tree by this way."),
    command("abs_zoom", "tree factor", "Makes a tree so many times as large as it was created."),
    command("rel_zoom", "tree factor", "Makes a tree so many times larger."),
    command("abs_rotate", "tree angle", "Turns a tree about its main axis to this angle, degrees."),
    command("rel_rotate", "tree angle", "Turns a tree about its main axis by this angle, degrees."),
    command("release", "tree", "Takes back how a tree was moved, zoomed and turned."),
    command("animate", "type tree level {lag}", "Writes a frame of each growth level of a tree, up to this one."),
    command("inform", "tree", "Prints a tree as a species file."),
    command("glue", "tree1 tree2 tree3", "Joins two trees on one root to the third, which takes their place."),
    command(
        "combine",
        "tree level { { type levels descriptor } ... }",
        "Makes a tree that branches by ranges of levels.",
    ),
    command("cluster", "cluster tree { tree } ...", "Makes a cluster of trees."),
    command("remove", "cluster", "Takes a cluster apart; its trees stay."),
    command("append", "cluster tree", "Adds a tree to a cluster."),
    command("expel", "cluster tree", "Takes a tree out of a cluster."),
    command("flush", "cluster {lag}", "Writes frames in which the trees of a cluster appear, one after another."),
    command("merge", "cluster1 cluster2 cluster3", "Joins two clusters to the third, which takes their place."),
    command("inquire", "cluster", "Prints the trees of a cluster."),
    command("compose", "tree {view} {x y z}", "Shows one tree on the workstations, in this view, from this place."),
    command("view", "cluster {view} {x y z}", "Shows one cluster on the workstations, in this view, from this place."),
    command("color", "{tree} color", "Gives a tree, or all trees that are made from now on, their colour."),
    command("appear", "tree flag", "Shows a tree or hides it."),
    command("visible", "cluster flag", "Shows the trees of a cluster or hides them."),
    command(
        "girth",
        "{tree} flag {first ratio dense shade axis corners}",
        "Gives branches a girth or takes it from them.",
    ),
    command("cont", "flag {steps}", "Lets frames of a growing tree lead through each growth level in steps."),
    command("cut_axis", "flag {level}", "Cuts the main axis of trees made from now on from a growth level on."),
    command("cut_lateral", "flag {level {{last level} ...}}", "Cuts lateral branches of trees made from now on."),
    command("divergence", "angle", "Gives trees made from now on their divergence, degrees or a fraction of a turn."),
    command(
        "deform",
        "tree flag flag flag {dx dy dz} {controller ... {x y z length}}",
        "Lets a tree grow anew under deviators.",
    ),
    command("leaf", "tree type form level color {length width}", "Gives a tree leaves from a growth level on."),
    command("shadow", "tree type x y z color {merge}", "Gives a tree its shadow on the ground by a light at a place."),
    command("open", "workstation type", "Begins a file: a display, a plotter or a model."),
    command("close", "workstation", "Writes the file of a workstation and ends it."),
    command("port", "workstation view left right top bottom", "Adds a port with a view to a workstation."),
    command("window", "workstation left right top bottom", "States the part of the view that ports show, metres."),
    command("activate", "workstation device", "Turns a logical device of a workstation on."),
    command("deactivate", "workstation device", "Turns a logical device of a workstation off."),
    command("clear", "workstation", "Takes all ports from a workstation, and shows nothing on it until a new view."),
    command("back_color", "color", "States the colour of the background."),
    command("defer", "lag", "States the time between frames, seconds."),
    command("help", "{command}", "Prints what a command does, or all commands."),
    command("local", "", "Reads on from the standard input, until `exit`."),
    command("exit", "", "Writes all workstations and ends."),
];

/// The command of a word.
pub fn command_of(word: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|command| command.word == word)
}
