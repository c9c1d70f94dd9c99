/* The tropism of Fig. 2.8b, Table 2.3. */
initial line width: 1
tropism direction: 0.00,-1.00,0.00
initial elasticity: 0.14
