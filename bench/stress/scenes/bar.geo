// 1 m x 0.1 m x 0.05 m along x, 16 x 2 x 1 bricks.
Point(1) = {0, 0, 0};
l[] = Extrude {0, 0.1, 0} { Point{1}; Layers{2}; };
s[] = Extrude {0, 0, 0.05} { Line{l[1]}; Layers{1}; Recombine; };
v[] = Extrude {1, 0, 0} { Surface{s[1]}; Layers{16}; Recombine; };
Physical Surface("root") = {s[1]};
Physical Surface("tip") = {v[0]};
Physical Volume("bar") = {v[1]};
