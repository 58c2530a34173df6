// SPDX-License-Identifier: MIT
//
// A brick of 3 x 1 x 1 with a hole across, of cells of length h.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 3, 1, 1};
Cylinder(2) = {1.6, -1, 0.55, 0, 3, 0, 0.25};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
