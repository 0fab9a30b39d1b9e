// A rod of 1 m with square ends, along x, hexahedra swept from one end to the other. Unit: metre.
length = 1.0;
side = 0.01;

Point(1) = {0, -side / 2, -side / 2};
line[] = Extrude {0, side, 0} { Point{1}; Layers{1}; };
root[] = Extrude {0, 0, side} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {length, 0, 0} { Surface{root[1]}; Layers{100}; Recombine; };

Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
