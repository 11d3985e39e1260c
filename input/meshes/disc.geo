// A disc for doc/meshes.md: Gmsh meshes it, scripts/mesh2deck.py makes cards of the mesh.
//
//            _________
//         .-'   top   '-.
//       /                 \
//      |       disc        |    "disc": a part; "rim": its edge, a segment set and a node set;
//       \                 /     "top": a node set
//         '-._________.-'  rim
//
// Units: any consistent set. Change r and h here, or for one run: gmsh -2 disc.geo -setnumber h 0.05

DefineConstant[ r = 1.0, h = 0.1 ];   // radius and size of elements [L]

Point(1) = {0, 0, 0, h};
Point(2) = {r, 0, 0, h};
Point(3) = {0, r, 0, h};
Point(4) = {-r, 0, 0, h};
Point(5) = {0, -r, 0, h};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Surface("disc") = {1};
Physical Curve("rim") = {1, 2, 3, 4};
Physical Point("top") = {3};
