// Plate of 200 x 200 x 4 mm about its middle, with the patch in the middle of its
// upper face that a ball strikes. Hexahedra, one over the thickness. Unit: metre.
half = 0.100;
patch = 0.010;  // half of its edge
thickness = 0.004;
DefineConstant[ size = {0.005, Name "edge of the elements of the patch"} ];

x[] = {-half, -patch, patch, half};
For j In {0:3}
  For i In {0:3}
    Point(1 + i + 4 * j) = {x[i], x[j], -thickness / 2};
  EndFor
EndFor
n[] = {Round((half - patch) / size / 1.5), Round(2 * patch / size), Round((half - patch) / size / 1.5)};
For j In {0:3}
  For i In {0:2}
    Line(100 + i + 3 * j) = {1 + i + 4 * j, 2 + i + 4 * j};
    Transfinite Curve {100 + i + 3 * j} = n[i] + 1;
    Line(200 + i + 3 * j) = {1 + j + 4 * i, 1 + j + 4 * (i + 1)};
    Transfinite Curve {200 + i + 3 * j} = n[i] + 1;
  EndFor
EndFor
top[] = {};
body[] = {};
For j In {0:2}
  For i In {0:2}
    s = 300 + i + 3 * j;
    Curve Loop(s) = {100 + i + 3 * j, 200 + j + 3 * (i + 1), -(100 + i + 3 * (j + 1)), -(200 + j + 3 * i)};
    Plane Surface(s) = {s};
    Transfinite Surface {s};
    Recombine Surface {s};
    swept[] = Extrude {0, 0, thickness} { Surface{s}; Layers{1}; Recombine; };
    top[] += {swept[0]};
    body[] += {swept[1]};
  EndFor
EndFor
Physical Surface("struck") = {top[4]};
Physical Volume("body") = {body[]};

Mesh.ElementOrder = 2;
