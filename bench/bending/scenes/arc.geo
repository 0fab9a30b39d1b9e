// Arc of 90 degrees and 1 m, 50 mm wide in its plane, 25 mm thick; root face at
// x = 0 across x, centre on the y axis. Unit: metre.
radius = 1.0 / (Pi / 2);
width = 0.05;
thickness = 0.025;

Point(1) = {0, -width / 2, -thickness / 2};
line[] = Extrude {0, width, 0} { Point{1}; Layers{1}; };
root[] = Extrude {0, 0, thickness} { Line{line[1]}; Layers{1}; Recombine; };
swept[] = Extrude {{0, 0, 1}, {0, radius, 0}, Pi / 2} {
  Surface{root[1]}; Layers{20}; Recombine;
};

Physical Surface("root") = {root[1]};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
