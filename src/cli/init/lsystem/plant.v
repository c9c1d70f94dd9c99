/* How the turtle draws plant.l. What cpfg says of windows and lights may stand here too; it is passed over. */
angle increment: 30
line style: cylinder
initial line width: 1
