/* How the clipped trees and hedges are drawn. */
angle increment: 32
line style: cylinder
initial line width: 1
surface: l leaf.s 1
