// Lower link of the capture arm: 0.6 m from pin to pin, 50 x 50 x 3 mm tube.
// A hollow tube along x with a pierced lug at each end. Unit: metre. The root
// pin is at the origin, the tip pin at x = length; both turn about y.
length = 0.600;  // pin to pin
width = 0.050;
wall = 0.003;
pin = 0.016;  // diameter
size = 0.025;  // of the elements, at most

SetFactory("OpenCASCADE");

lug = 0.060;      // of the pin's centre from the end of the tube
thickness = 0.020;  // of a lug, along y
half = width / 2;

// The tube: outer box minus inner box, closed by plates of twice the wall.
Box(1) = {lug, -half, -half, length - 2 * lug, width, width};
Box(2) = {lug + 2 * wall, -half + wall, -half + wall,
          length - 2 * lug - 4 * wall, width - 2 * wall, width - 2 * wall};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

// The lugs: a plate with a rounded end around each pin.
Box(4) = {0, -thickness / 2, -half / 1.5, lug, thickness, 2 * half / 1.5};
Cylinder(5) = {0, -thickness / 2, 0, 0, thickness, 0, half / 1.5};
Box(6) = {length - lug, -thickness / 2, -half / 1.5, lug, thickness,
          2 * half / 1.5};
Cylinder(7) = {length, -thickness / 2, 0, 0, thickness, 0, half / 1.5};
BooleanUnion(8) = { Volume{3}; Delete; }{ Volume{4, 5, 6, 7}; Delete; };

// The bores of the pins.
Cylinder(9) = {0, -thickness, 0, 0, 2 * thickness, 0, pin / 2};
Cylinder(10) = {length, -thickness, 0, 0, 2 * thickness, 0, pin / 2};
BooleanDifference(11) = { Volume{8}; Delete; }{ Volume{9, 10}; Delete; };

// A bore is every surface that a box little larger than the pin holds.
e = pin / 2 * 1.02;
bore_root() = Surface In BoundingBox {-e, -thickness, -e, e, thickness, e};
bore_tip() = Surface In BoundingBox {length - e, -thickness, -e,
                                     length + e, thickness, e};
Physical Volume("body") = {11};
Physical Surface("root") = {bore_root()};
Physical Surface("tip") = {bore_tip()};

Mesh.MeshSizeMin = size / 4;
Mesh.MeshSizeMax = size;
Mesh.MeshSizeFromCurvature = 8;
Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
