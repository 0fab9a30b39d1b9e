// Slender rod of the four-bar linkage and the pendulum chain.
// A straight bar along x, root face at x = 0 in the middle of the section,
// hexahedra swept from one end to the other. Unit: metre.
length = 0.500;
width = 0.010;      // along y
thickness = 0.010;  // along z
layers = 30;

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
Transfinite Curve {1, 3} = 2;
Transfinite Curve {2, 4} = 2;
Transfinite Surface {1};
Recombine Surface {1};
swept[] = Extrude {length, 0, 0} {
  Surface{1}; Layers{layers}; Recombine;
};

Physical Surface("root") = {1};
Physical Surface("tip") = {swept[0]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
