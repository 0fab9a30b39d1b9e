// A bar along x of eight second-order hexahedra. Unit: metre.
length = 0.200;
width = 0.020;
thickness = 0.008;
layers = 4;

Point(1) = {0, -width / 2, -thickness / 2};
Point(2) = {0, width / 2, -thickness / 2};
Point(3) = {0, width / 2, thickness / 2};
Point(4) = {0, -width / 2, thickness / 2};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 3;
Transfinite Curve {2, 4} = 2;
Transfinite Surface {1};
Recombine Surface {1};
swept[] = Extrude {length, 0, 0} {
  Surface{1}; Layers{layers}; Recombine;
};
Physical Surface("root") = {1};
Physical Surface("tip") = {swept[0]};
Physical Surface("top") = {swept[4]};
Physical Volume("body") = {swept[1]};
Mesh.ElementOrder = 2;
