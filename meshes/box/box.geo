// Box 1 x 1 x 5 m, corner at the origin, z along its length.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 5};
Physical Surface("root") = {5};
Physical Surface("tip") = {6};
Physical Surface("side") = {1, 2, 3, 4};
Physical Volume("body") = {1};
