// A ball for doc/meshes.md: Gmsh meshes it with -3, scripts/mesh2deck.py makes cards of the mesh.
//
//       .-'"'-.      "ball": a part of tetrahedra
//      /       \
//     |  ball   |    "skin": its surface, a segment set and a node set
//      \       /
//       '-._.-'      "top": a node set
//
// Units: any consistent set. Change r and h here, or for one run: gmsh -3 ball.geo -setnumber h 0.3

DefineConstant[ r = 1.0, h = 0.45 ];   // radius and size of elements [L]

SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, r};
Mesh.MeshSizeMax = h;
top() = Point In BoundingBox { -r/9, -r/9, r - r/9, r/9, r/9, r + r/9 };

Physical Volume("ball") = {1};
Physical Surface("skin") = {1};
Physical Point("top") = {top()};
