/* The branching angle of section 4 of the paper. */
angle increment: 32
