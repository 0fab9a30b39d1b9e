// Flat bar of 1 m, 30 mm wide along y and 10 mm thick along z, root face at
// x = 0, hexahedra swept from one end to the other. Unit: metre.
length = 1.0;
width = 0.030;
thickness = 0.010;

Point(1) = {0, -width / 2, -thickness / 2};
line[] = Extrude {0, width, 0} { Point{1}; Layers{1}; };
root[] = Extrude {0, 0, thickness} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {length, 0, 0} { Surface{root[1]}; Layers{40}; Recombine; };

Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Surface("top") = {swept[4]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
