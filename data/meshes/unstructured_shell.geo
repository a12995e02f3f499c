// One octant of a spherical shell (inner radius 10 mm, outer 12 mm) in hexahedra that follow nothing: tetrahedra, each cut in four.
//     gmsh -3 -bin -setnumber size 2.5 unstructured_shell.geo -o unstructured_shell_coarse.msh    (fine: 1.5)
DefineConstant[size = 2.5];
a = 10; b = 12;
Point(1) = {0, 0, 0, size};
Point(2) = {a, 0, 0, size}; Point(3) = {0, a, 0, size}; Point(4) = {0, 0, a, size};
Point(5) = {b, 0, 0, size}; Point(6) = {0, b, 0, size}; Point(7) = {0, 0, b, size};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 2};
Circle(4) = {5, 1, 6}; Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 5};
Line(7) = {2, 5}; Line(8) = {3, 6}; Line(9) = {4, 7};
Curve Loop(1) = {1, 2, 3}; Surface(1) = {1};
Curve Loop(2) = {4, 5, 6}; Surface(2) = {2};
Curve Loop(3) = {1, 8, -4, -7}; Plane Surface(3) = {3};
Curve Loop(4) = {2, 9, -5, -8}; Plane Surface(4) = {4};
Curve Loop(5) = {3, 7, -6, -9}; Plane Surface(5) = {5};
Surface Loop(1) = {1, 2, 3, 4, 5}; Volume(1) = {1};
Physical Volume("shell") = {1};
Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
Mesh.SubdivisionAlgorithm = 2;
