// The strip of the Princeton beam experiment, 0.508 m x 12.77 mm x 3.2024 mm,
// root face at x = 0, thin along z. Unit: metre.
length = 0.508;
width = 12.77e-3;
thickness = 3.2024e-3;

Point(1) = {0, -width / 2, -thickness / 2};
line[] = Extrude {0, width, 0} { Point{1}; Layers{2}; };
root[] = Extrude {0, 0, thickness} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {length, 0, 0} { Surface{root[1]}; Layers{40}; Recombine; };

Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
