// A bar, 1:25.
Point(1) = {0, 0, 0};
l[] = Extrude {0.04, 0, 0} { Point{1}; Layers{1}; };
s[] = Extrude {0, 0.05, 0} { Line{l[1]}; Layers{1}; Recombine; };
v[] = Extrude {0, 0, 1} { Surface{s[1]}; Layers{8}; Recombine; };
Physical Surface("near") = {s[1]};
Physical Surface("far") = {v[0]};
Physical Volume("body") = {v[1]};
