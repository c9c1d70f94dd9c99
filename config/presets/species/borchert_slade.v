/* Shoots turn upward a little as they grow. */
angle increment: 30
line style: cylinder
initial line width: 1
tropism direction: 0,1,0
initial elasticity: 0.15
surface: l borchert_slade.s 1
