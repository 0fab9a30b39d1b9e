// Thin bar that a ball strikes, about its middle, along x, the struck face upwards.
// Hexahedra swept from one end to the other. Unit: metre.
length = 0.200;
width = 0.020;      // along y
thickness = 0.003;  // along z
DefineConstant[ size = {0.0025, Name "edge of the elements"} ];

Point(1) = {-length / 2, -width / 2, -thickness / 2};
Point(2) = {-length / 2, width / 2, -thickness / 2};
Point(3) = {-length / 2, width / 2, thickness / 2};
Point(4) = {-length / 2, -width / 2, thickness / 2};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = Round(width / size) + 1;
Transfinite Curve {2, 4} = Round(thickness / size) + 1;
Transfinite Surface {1};
Recombine Surface {1};
swept[] = Extrude {length, 0, 0} {
  Surface{1}; Layers{Round(length / size)}; Recombine;
};

Physical Surface("top") = {swept[4]};
Physical Volume("body") = {swept[1]};

Mesh.ElementOrder = 2;
