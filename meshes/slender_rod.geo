// Slender rod of square section along x, root face at x = 0, hexahedra swept
// from one end to the other: 10 m, E A = 2.8e7 N and E I = 1.4e4 N m^2 for
// E = 4.6667e9 Pa. Unit: metre.
length = 10.0;
side = 0.0774596669241483;
layers = 40;

Point(1) = {0, -side / 2, -side / 2};
line[] = Extrude {0, side, 0} { Point{1}; Layers{1}; };
root[] = Extrude {0, 0, side} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {length, 0, 0} {
  Surface{root[1]}; Layers{layers}; Recombine;
};

Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
