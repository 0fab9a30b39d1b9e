// A boom as a solid bar with the bending stiffness of the tube, along x, root face at x = 0;
// hexahedra swept from one end to the other. Unit: metre.
length = 6.4;
side = 0.1;

Point(1) = {0, -side / 2, -side / 2};
line[] = Extrude {0, side, 0} { Point{1}; Layers{1}; };
root[] = Extrude {0, 0, side} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {length, 0, 0} { Surface{root[1]}; Layers{40}; Recombine; };

Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
