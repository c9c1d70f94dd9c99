/* How the turtle draws plant.l. What cpfg says of windows and lights may stand here too; it is passed over. */
line style: cylinder
initial line width: 1

/* After each line the turtle turns upward a little, as shoots do. */
tropism direction: 0,1,0
initial elasticity: 0.12

/* The surface that ~l draws: a Bezier patch. */
surface: l leaf.s 1
