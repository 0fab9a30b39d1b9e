// A block of tetrahedra, 1:3.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.33, 0.3, 1};
MeshSize{:} = 0.35;
Physical Surface("near") = {5};
Physical Surface("far") = {6};
Physical Volume("body") = {1};
