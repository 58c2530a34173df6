// SPDX-License-Identifier: MIT
//
// The channel (-0.2, 2) x (-0.2, 0.2) with a round obstacle of radius 0.05 at the origin [K Ex 4].
//
//     gmsh channel.geo -setnumber refinements 1 -setstring file channel.msh -
//
// The numbers of edges follow from the sizes that the lecture's Table 4 prints: from one line to the
// next the pressures (nodes) are those of halving all edges of one coarse mesh, 526 nodes with 132
// boundary edges; 94 of them carry Dirichlet conditions, 30 lie on the obstacle, 8 on the outflow.
DefineConstant[
  size = {0.0512, Name "Edge length along the channel"},
  growth = {0.666, Name "Edge length per distance from the obstacle"},
  refinements = {0, Name "How often all edges are halved"},
  file = {"channel.msh", Name "Mesh file"}
];

along = Ceil(2.2 / size);
across = Ceil(0.4 / size);
factor = 0.0512 / size;

Point(1) = {-0.2, -0.2, 0, size};
Point(2) = {2, -0.2, 0, size};
Point(3) = {2, 0.2, 0, size};
Point(4) = {-0.2, 0.2, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1, 3} = along + 1;
Transfinite Curve {2, 4} = across + 1;

// Two half circles, so that nodes are evenly spaced for any even number of them.
Point(5) = {0, 0, 0, size};
Point(6) = {0.05, 0, 0, size};
Point(7) = {-0.05, 0, 0, size};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 6};
Transfinite Curve {5, 6} = Round(15 * factor) + 1;

Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6};
Plane Surface(1) = {1, 2};

Physical Curve("walls") = {1, 3};
Physical Curve("outflow") = {2};
Physical Curve("inflow") = {4};
Physical Curve("obstacle") = {5, 6};
Physical Surface("fluid") = {1};

// As fine as the obstacle next to it, as coarse as the channel far from it.
Field[1] = Distance;
Field[1].CurvesList = {5, 6};
Field[1].NumPointsPerCurve = 200;
Field[2] = MathEval;
Field[2].F = Sprintf("Min(%g, %g + %g * F1)", size, 3.14159265 * 0.05 / (15 * factor), growth);
Background Field = 2;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.Algorithm = 6;
Mesh.MshFileVersion = 2.2;

Mesh 2;
For i In {1 : refinements}
  RefineMesh;
EndFor
Save Str(file);
