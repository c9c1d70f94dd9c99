/* The tropism of Fig. 2.8d, Table 2.3. */
initial line width: 1
tropism direction: -0.61,0.77,-0.19
initial elasticity: 0.4
