// A quarter of a ring, 1:15.
Point(1) = {0.6, 0, 0};
l[] = Extrude {0.06, 0, 0} { Point{1}; Layers{1}; };
s[] = Extrude {0, 0.08, 0} { Line{l[1]}; Layers{1}; Recombine; };
v[] = Extrude {{0, 1, 0}, {0, 0, 0}, Pi / 2} {
  Surface{s[1]}; Layers{10}; Recombine; };
Physical Surface("near") = {s[1]};
Physical Surface("far") = {v[0]};
Physical Volume("body") = {v[1]};
