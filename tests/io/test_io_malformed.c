/* test_io_malformed.c - readers of meshes: every kind of malformed file is refused by name and
 * line. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "support/write_mesh_file.h"

typedef struct bad_mesh {
    const char *name, *text;
    int64_t line;
    const char *says;
} bad_mesh;

#define OFF3 "0 0 0\n1 0 0\n0 1 0\n"
#define PLY3                                                                                       \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float " \
    "z\n"
#define PLYF PLY3 "element face 1\nproperty list uchar int vertex_indices\nend_header\n" OFF3
#define VTK_HEAD "# vtk DataFile Version 3.0\ntitle\nASCII\n"
#define VTK_GRID "DATASET UNSTRUCTURED_GRID\n"
#define VTK_3 VTK_HEAD VTK_GRID "POINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
#define FORT14 "title\n1 3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n"
#define SMS3 "MESH2D\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\n"
#define MSH "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define MSH3 MSH "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
#define VTU(parts)                                                                                 \
    "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='3' "                \
    "NumberOfCells='1'>" parts "</Piece></UnstructuredGrid></VTKFile>"
#define VTU_3(corners, ends, types)                                                                \
    VTU("<Points><DataArray type='Float64'>0 0 0 1 0 0 0 1 0</DataArray></Points><Cells>"          \
        "<DataArray type='Int64' Name='connectivity'>" corners "</DataArray>"                      \
        "<DataArray type='Int64' Name='offsets'>" ends "</DataArray>"                              \
        "<DataArray type='UInt8' Name='types'>" types "</DataArray></Cells>")
static const bad_mesh bads[] = {
    {"e.off", "", 1, "begins with OFF"},
    {"e.off", "  \n\n", 2, "begins with OFF"},
    {"e.off", "OF\n3 1 0\n", 1, "begins with OFF"},
    {"e.off", "OFF BINARY\n", 1, "binary OFF"},
    {"e.off", "4OFF\n1 0 0\n1 1 1 1\n", 1, "'4OFF'"},
    {"e.off", "nOFF\n3\n1 0 0\n1 1 1\n", 1, "'nOFF'"},
    {"e.dat", "nOFF\n3\n1 0 0\n1 1 1\n", 1, "'nOFF'"},
    {"e.dat", "STCN4nOFF\n3\n1 0 0\n1 1 1\n", 1, "'STCN4nOFF'"},
    {"e.off", "OFF\n", 1, "numbers of vertices and faces"},
    {"e.off", "OFF\n3\n", 2, "numbers of vertices and faces"},
    {"e.off", "OFF\nthree one\n", 2, "numbers of vertices and faces"},
    {"e.off", "OFF\n-3 1 0\n", 2, "negative"},
    {"e.off", "OFF\n3 1.5 0\n" OFF3, 2, "numbers of vertices and faces"},
    {"e.off", "OFF\n353535235358 6 0\n" OFF3, 5, "ends after 3 of 353535235358 vertices"},
    {"e.off", "OFF\n99999999999999999999999 6 0\n" OFF3, 2,
     "the number 99999999999999999999999 is too large"},
    {"e.off", "OFF\n3 4000000000 0\n" OFF3 "3 0 1 2\n", 6, "ends after 1 of 4000000000 faces"},
    {"e.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", 4, "2 coordinates"},
    {"e.off", "OFF\n3 1 0\n0 0 0\n\n1 zero 0\n0 1 0\n3 0 1 2\n", 5, "'zero' is not a number"},
    {"e.off", "OFF\n3 1 0\n0 0 0\n0,5 0 0\n0 1 0\n3 0 1 2\n", 4, "'0,5' is not a number"},
    {"e.off", "OFF\n3 1 0\n0 0 0\n1e 0 0\n0 1 0\n3 0 1 2\n", 4, "'1e' is not a number"},
    {"e.off", "OFF\n3 1 0\n0 0 0\n0x1p3 0 0\n0 1 0\n3 0 1 2\n", 4, "'0x1p3' is not a number"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1\n", 6, "3 corners, but has 2"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 3\n", 6,
     "vertex 3 does not exist: there are 3, numbered from 0"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 -1\n", 6, "vertex -1 does not exist"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 4294967296\n", 6, "vertex 4294967296 does not exist"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 18446744073709551617\n", 6,
     "the number 18446744073709551617 is too large"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 1.0\n", 6, "'1.0' is not a vertex number"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 x\n", 6, "'x' is not a vertex number"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "2 0 1\n", 6, "a face has 2 corners"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "0\n", 6, "a face has 0 corners"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "-3 0 1 2\n", 6, "'-3' is not a number of corners"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "4000000000 0 1 2\n", 6, "4000000000 corners, but has 3"},
    {"e.off", "OFF\n3 1 0\n" OFF3 "3 0 1 2\n3 0 1 2\n", 7, "more than the 1 faces"},
    {"e.off", "\xff\xfeO\1F\1F\1", 1, "UTF-16"},
    {"e.off", "OFF\n3 1 0\n0 0 \033[31m\n", 3, "'?[31m' is not a number"},

    {"e.obj", "", 1, "no vertex"},
    {"e.obj", "# only a comment\n", 1, "no vertex"},
    {"e.obj", "v 0 0\n", 1, "2 coordinates"},
    {"e.obj", "v 0 0 0\nv 0 zero 0\n", 2, "'zero' is not a number"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", 4, "a face has 2 corners"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf \n", 4, "a face has 0 corners"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", 4, "'0' is not a vertex number"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nf 1 2 4\nv 0 1 0\n", 3,
     "vertex 4 does not exist: there are 3, numbered from 1"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nf 1 2 4294967297\nv 0 1 0\n", 3,
     "4294967297 is not a vertex number"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nf 1 2 4294967294\nv 0 1 0\n", 3,
     "vertex 4294967294 does not exist"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", 3,
     "vertex -3 does not exist: there are 2"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/x 2 3\n", 4, "'1/x' is not a vertex number"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/2/3/4 2 3\n", 4, "'1/2/3/4' is not a vertex number"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3a\n", 4, "'3a' is not a vertex number"},
    {"e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 \\\n", 5, "a face has 2 corners"},

    {"e.ply", "", 1, "ends before 'end_header'"},
    {"e.ply", "plyx\n", 1, "begins with 'ply'"},
    {"e.ply", "ply\nend_header\n", 2, "the line with the format is missing"},
    {"e.ply", "ply\nformat ascii\n", 2, "the format has to be"},
    {"e.ply", "ply\nformat ascii 2.0\n", 2, "the format has to be"},
    {"e.ply", "ply\nformat binary 1.0\n", 2, "the format has to be"},
    {"e.ply", PLY3, 6, "ends before 'end_header'"},
    {"e.ply", "ply\nformat ascii 1.0\nend_header\n", 3, "no element 'vertex'"},
    {"e.ply", "ply\nformat ascii 1.0\nproperty float x\n", 3, "before the first element"},
    {"e.ply", "ply\nformat ascii 1.0\nelement vertex\n", 3, "a name and a count"},
    {"e.ply", "ply\nformat ascii 1.0\nelement vertex -1\n", 3, "a name and a count"},
    {"e.ply", "ply\nformat ascii 1.0\nelement vertex 3x\n", 3, "a name and a count"},
    {"e.ply", PLY3 "element vertex 3\n", 7, "second element 'vertex'"},
    {"e.ply", PLY3 "property float x\n", 7, "second property 'x'"},
    {"e.ply", PLY3 "property real w\n", 7, "'real' is not a property type"},
    {"e.ply", PLY3 "property list float int w\n", 7, "count of a list"},
    {"e.ply", PLY3 "property list int\n", 7, "'' is not a property type"},
    {"e.ply", PLY3 "property float\n", 7, "a property has no name"},
    {"e.ply", PLY3 "propertee float w\n", 7, "'propertee' was not expected"},
    {"e.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float z\nend_header\n", 6,
     "no property 'y'"},
    {"e.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty list int int "
     "y\nend_header\n",
     6, "no property 'y'"},
    {"e.ply", PLY3 "element face 1\nproperty list int float vertex_indices\nend_header\n" OFF3, 12,
     "no list of integers"},
    {"e.ply", PLY3 "element face 1\nproperty int vertex_indices\nend_header\n" OFF3, 12,
     "no list of integers"},
    {"e.ply", PLY3 "element face 1\nproperty list int int corners\nend_header\n" OFF3, 12,
     "no list of integers"},
    {"e.ply", PLY3 "end_header\n0 0 0\n1 0 0\n", 9, "ends after 2 of 3 elements 'vertex'"},
    {"e.ply", PLY3 "end_header\n0 0 0\n1 0\n0 1 0\n", 9, "ends before its last value"},
    {"e.ply", PLY3 "end_header\n0 0 0\n1 0 0 0\n0 1 0\n", 9, "'0' follows the last value"},
    {"e.ply", PLY3 "end_header\n0 0 0\n1 zero 0\n0 1 0\n", 9, "'zero' is not a number"},
    {"e.ply", PLY3 "end_header\n" OFF3 "more\n", 11, "more data"},
    {"e.ply", PLYF "3 0 1\n", 13, "ends before its last value"},
    {"e.ply", PLYF "3 0 1 3\n", 13, "vertex 3 does not exist"},
    {"e.ply", PLYF "3 0 1 -1\n", 13, "vertex -1 does not exist"},
    {"e.ply", PLYF "3 0 1 4294967296\n", 13, "vertex 4294967296 does not exist"},
    {"e.ply", PLYF "2 0 1\n", 13, "a face has 2 corners"},
    {"e.ply", PLYF "-1 0 1\n", 13, "a list announces -1 values"},
    {"e.ply", PLYF "3.5 0 1 2\n", 13, "'3.5' is not an integer"},
    {"e.ply", PLYF "9000000000000000000 0 1 2\n", 13, "ends before its last value"},
    {"e.ply",
     "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement "
     "vertex 1\nproperty float "
     "x\n"
     "property float y\nend_header\n3 0 1 2\n5 5\n",
     9, "vertex 2 does not exist: there are 1"},
    {"e.ply",
     "ply\nformat ascii 1.0\nelement vertex 4000000000000\nproperty float x\nproperty float "
     "y\nend_header\n1 1\n",
     7, "ends after 1 of 4000000000000"},

    {"e.stl", "solid\n", 1, "ends before 'endsolid'"},
    {"e.stl", "solid\nendsolid\nmore\n", 3, "expected 'solid'"},
    {"e.stl", "solid\nfacet normal 0 0 1\nendfacet\nendsolid\n", 3,
     "a facet has 0 vertices, not 3"},
    {"e.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n",
     7, "a fourth vertex"},
    {"e.stl", "solid\nfacet\nouter loop\nvertex 0 0\n", 4, "2 coordinates"},
    {"e.stl", "solid\nfacet\nouter loop\nvertex 0 x 0\n", 4, "'x' is not a number"},
    {"e.stl", "solid\nvertex 0 0 0\n", 2, "'vertex' was not expected"},
    {"e.stl", "solid\nfacet\nfacet\n", 3, "'facet' was not expected"},
    {"e.stl", "solid\nfacet\nendsolid\n", 3, "'endsolid' was not expected"},
    {"e.stl", "solid\nwhat is this\n", 2, "'what' was not expected"},

    {"e.txt", "nothing here\n", -1,
     "this is not a mesh in a known format (off, ply, node, obj, stl, netcdf, vtk, vtu, fort.14, "
     "gr3, ll, 2dm, msh, selafin, su2, npz, mwm)"},
    {"e.txt", "", -1, "this is not a mesh in a known format"},
    {"e.xyz", "0 0\n1 0\n0 1\n", -1, "this is not a mesh in a known format"},
    {"e.csv", "x,y\n0,0\n", -1, "this is not a mesh in a known format"},

    {"e.vtk", "# vtk DataFile Version 3.0\n", 1, "expected ASCII or BINARY"},
    {"e.vtk", VTK_HEAD "DATASET STRUCTURED_GRID\n", 4, "dataset 'STRUCTURED_GRID' is not read"},
    {"e.vtk", VTK_HEAD VTK_GRID "POINTS 3 double\n0 0 0 1 0\n", 6, "ends before the coordinate"},
    {"e.vtk", VTK_HEAD VTK_GRID "POINTS 99999999999 double\n0 0 0\n", 6, "ends before the"},
    {"e.vtk", VTK_HEAD VTK_GRID "POINTS 3 string\n0 0 0\n", 5, "values of type 'string'"},
    {"e.vtk", VTK_3 "CELLS 1 4\n4 0 1 2\nCELL_TYPES 1\n5\n", 9, "CELL_TYPES"},
    {"e.vtk", VTK_3 "CELLS 1 4\n7 0 1 2\nCELL_TYPES 1\n5\n", 8, "7 corners, but only 4"},
    {"e.vtk", VTK_3 "CELLS 1 4\n3 0 1 3\nCELL_TYPES 1\n5\n", 10, "vertex 3 does not exist"},
    {"e.vtk", VTK_3 "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n9\n", 10, "type 9 has 3 corners"},
    {"e.vtk", VTK_3 "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n22\n", 10, "type 22 are not read"},
    {"e.vtk", VTK_3 "CELLS 1 4\n3 0 1 2\n", 8, "1 cells, but types for 0"},
    {"e.vtk", VTK_3 "CELLS 1 5\n4 0 1 2 0\nCELL_TYPES 1\n10\n", 10,
     "only volumes: cells of type 10"},
    {"e.vtk", VTK_3 "POINT_DATA 4\n", 7, "4 values for 3 points"},
    {"e.vtk", VTK_3 "NONSENSE 4\n", 7, "'NONSENSE' was not expected"},
    {"e.vtk", VTK_3 "POINT_DATA 3\nSCALARS q float\nLOOKUP_TABLE default\n1 2 x\n", 10,
     "'x' is not a number"},

    {"fort.14", "", 1, "the line with the numbers"},
    {"fort.14", "title\n", 1, "the line with the numbers"},
    {"fort.14", "title\n1 x\n", 2, "expected the number of vertices, found 'x'"},
    {"fort.14", "title\n-1 3\n", 2, "a count is negative"},
    {"fort.14", "title\n1 3\n1 0 0 1\n3 0 0 1\n", 4, "number of the vertex is 3, not 2"},
    {"fort.14", "title\n1 3\n1 0 0\n", 3, "the line ends before the depth"},
    {"fort.14", "title\n1 3000000000\n1 0 0 1\n", 3, "ends after 1 of 3000000000 vertices"},
    {"fort.14", FORT14 "1 3 1 2\n", 6, "the line ends before the corner"},
    {"fort.14", FORT14 "1 5 1 2 3 1 2\n", 6, "an element has 5 corners"},
    {"fort.14", FORT14 "1 3 0 1 2\n", 6, "vertex 0 does not exist: there are 3, numbered from 1"},
    {"fort.14", FORT14, 5, "ends after 0 of 1 elements"},
    {"fort.14", FORT14 "1 3 1 2 3\n1\n2\n2\n1\n", 10, "ends after 1 of 2 vertices of a boundary"},
    {"fort.14", FORT14 "1 3 1 2 3\n1\n2\n2\n1\n9\n", 11, "vertex 9 does not exist"},
    {"fort.14", FORT14 "1 3 1 2 3\n-1\n", 7, "the number of boundaries is -1"},
    {"e.gr3", FORT14 "1 3 1 2 3\n2\n0\n", 8, "ends after 0 of 2 boundaries"},

    {"e.2dm", "this is no mesh\n", 1, "begins with MESH2D"},
    {"e.2dm", "MESH2D\nE3T 1 1 2 3 1\n", 2, "vertex 1 does not exist"},
    {"e.2dm", "MESH2D\n", 1, "no vertex ('ND')"},
    {"e.2dm", "MESH2D\nND 1 0 0\n", 2, "the line ends before the z"},
    {"e.2dm", "MESH2D\nND 1 0 0 0\nND 1 1 0 0\n", 3, "this vertex has the same number as"},
    {"e.2dm", SMS3 "E3T 1 1 2 3\nE3T 1 1 2 3\n", 6, "this element has the same number as"},
    {"e.2dm", SMS3 "E3T 1 1 2 4\nE3T 2 1 2 3\n", 5, "vertex 4 does not exist"},
    {"e.2dm", SMS3 "E3T 1 1 2 -3\n", 5, "-3 is not a vertex number"},
    {"e.2dm", SMS3 "E6T 1 1 2 3 4 5 6 1\n", 5, "E6T: elements with vertices on their sides"},
    {"e.2dm", "MESH2D\nE4Q 1 1 2 3 4\nND 1 0 0 0\nND 2 4 0 0\nND 3 1 1 0\nND 4 0 4 0\n", 2,
     "face 1 with 4 corners is not convex"},

    {"e.su2", "NDIME= 3\n", 1, "the mesh is not in the plane"},
    {"e.su2", "NDIME= 2\n", 1, "no vertices ('NPOIN=')"},
    {"e.su2", "NZONE= 2\n", 1, "several zones"},
    {"e.su2", "NDIME= 2\nNPOIN= -1\n", 2, "the vertices is -1"},
    {"e.su2", "NDIME= 2\nNPOIN= 9000000000\n0 0 0\n", 3, "ends after 1 of 9000000000 vertices"},
    {"e.su2", "NDIME= 2\nNELEM= 1\n12 0 1 2 3 4 5 6 7\n", 3, "an element has type 12"},
    {"e.su2", "NDIME= 2\nNELEM= 1\n5 0 1 3\nNPOIN= 3\n0 0\n1 0\n0 1\n", 3,
     "vertex 3 does not exist: there are 3, numbered from 0"},
    {"e.su2", "NDIME= 2\nNPOIN= 1\n0 0\nNPOIN= 1\n0 0\n", 4, "the vertices come a second time"},
    {"e.su2", "NDIME= 2\nNPOIN= 1\n0 0\nMARKER_ELEMS= 1\n3 0 0\n", 4,
     "there is no MARKER_TAG before MARKER_ELEMS"},
    {"e.su2", "NDIME= 2\nNPOIN= 1\n0 0\nMARKER_TAG= a\nMARKER_ELEMS= 2\n1 0\n5 0 0 0\n", 7,
     "a marker has an element of type 5; edges have type 3"},

    {"e.msh", "$Nodes\n1\n", 1, "no $MeshFormat before this"},
    {"e.msh", "$MeshFormat\n3 0 8\n$EndMeshFormat\n", 2, "MSH version 3 is not read"},
    {"e.msh", "$MeshFormat\n2.2 0 4\n", 2, "numbers of 4 bytes"},
    {"e.msh", MSH "$Comments\n1\n", 5, "the file ends before $EndComments"},
    {"e.msh", MSH, 3, "no vertices ($Nodes)"},
    {"e.msh", MSH "nonsense\n", 4, "expected a section ('$...'), found 'nonsense'"},
    {"e.msh", MSH "$Elements\n1\n", 4, "the elements stand before the vertices"},
    {"e.msh", MSH "$Nodes\n3\n1 0 0 0\n", 6, "the file ends before the number of a vertex"},
    {"e.msh", MSH "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n$Elements\n", 9,
     "vertex 2 of the file has the same number as another one"},
    {"e.msh", "$MeshFormat\n4 1 8\n", 2, "binary MSH 4.0 is not read; save it as text, or as 4.1"},
    {"e.msh", MSH "$Nodes\n-3\n", 5, "the number of vertices is -3"},
    {"e.msh", MSH3 "$Nodes\n1\n", 10, "the vertices come a second time"},
    {"e.msh", MSH3 "$Elements\n1\n1 2 -1 1 2 3\n", 12, "a count is negative or 0"},
    {"e.msh", MSH3 "$Elements\n1\n1 2 0 1 2 4\n", 12, "vertex 4 does not exist"},
    {"e.msh", MSH3 "$Elements\n1\n1 9 0 1 2 3 1 2 3\n", 12, "type 9 have vertices on their sides"},
    {"e.msh", MSH3 "$Elements\n1\n1 99 0 1 2 3\n", 12, "elements of type 99 are not read"},
    {"e.msh", MSH3 "$Elements\n1\n1 4 0 1 2 3 1\n$EndElements\n", 13,
     "no triangles or quadrilaterals, only elements of type 4"},
    {"e.msh", MSH3 "$Elements\n1\n1 2 0 1 2 3\n$EndNodes\n", 13, "expected $EndElements"},

    {"e.vtu", "<?xml version='1.0'?>\n<VTKFile type='PolyData'>\n", -1,
     "files of type 'PolyData' are not read"},
    {"e.vtu", "<VTKFile type='UnstructuredGrid'>\n</VTKFile>", -1, "no <Piece>"},
    {"e.vtk", VTK_3 "POINTS 3 double\n", 7, "the points come a second time"},
    {"e.vtk", VTK_HEAD VTK_GRID "POINTS -3 double\n", 5, "the number of points is -3"},
    {"e.vtk", VTK_3 "POINT_DATA 3\nTEXTURE_COORDINATES t 0 float\n", 8,
     "the values have 0 numbers each"},
    {"e.vtk", VTK_3 "POINT_DATA 3\nSCALARS t float 1001\n", 8, "the values have 1001 numbers each"},
    {"e.vtk", VTK_3 "POINT_DATA 4\n", 7, "4 values for 3 points"},
    {"e.vtu",
     "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='0' "
     "NumberOfCells='0'></Piece><Piece NumberOfPoints='0' NumberOfCells='0'></Piece>"
     "</UnstructuredGrid></VTKFile>",
     -1, "a file of several pieces is not read"},
    {"e.vtu", VTU("<Points></Points>"), -1, "no <Points>"},
    {"e.vtu", VTU("<Points><DataArray type='Float64'>0 0 0 1 0 x</DataArray></Points>"), -1,
     "'x' is not a number"},
    {"e.vtu", VTU("<Points><DataArray type='Float64'>0 0 0</DataArray></Points>"), -1,
     "the array has 3 numbers, not 9"},
    {"e.vtu", VTU("<Points><DataArray type='Float9'>0 0 0</DataArray></Points>"), -1,
     "an array of type 'Float9'"},
    {"e.vtu", VTU("<Points><DataArray type='Float64' format='appended' offset='0'/></Points>"), -1,
     "in <AppendedData>, which ends before it"},
    {"e.vtu",
     VTU("<Points><DataArray type='Float64' format='binary'>/////w==</DataArray></Points>"), -1,
     "the data of the array end early"},
    {"e.vtu", VTU_3("0 1 3", "3", "5"), -1, "vertex 3 does not exist"},
    {"e.vtu", VTU_3("0 1 2", "9", "5"), -1, "cell 0 has no corners"},
    {"e.vtu", VTU_3("0 1 2", "3", "-5"), -1, "types: the numbers must be whole"},
    {"e.vtu", VTU_3("0 1 2", "3", "23"), -1, "cells of type 23 are not read"},

    {"e.npz", "PK\3\4", -1, "this is not a zip file"},
    {"e.npz", "", -1, "this is not a zip file"},
};

static void test_malformed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bads / sizeof *bads; i++) {
        mw_mesh_file file;
        mw_error error;
        char place[64];
        files_write_text(bads[i].name, bads[i].text);
        if (mw_read_mesh(bads[i].name, NULL, &file, &error) != MW_ERROR_INPUT)
            fail_msg("case %zu, '%s' (%s) was taken", i, bads[i].text, bads[i].says);
        files_expect_error(&error, MW_ERROR_INPUT, bads[i].line, bads[i].says);
        if (bads[i].line > 0) {
            snprintf(place, sizeof place, "%s:%d: ", bads[i].name, (int)bads[i].line);
            assert_int_equal(strncmp(error.message, place, strlen(place)), 0);
        }
        assert_null(file.points);
        assert_int_equal(mw_read_mesh(bads[i].name, NULL, &file, NULL), MW_ERROR_INPUT);
        unlink(bads[i].name);
    }
}

static void test_malformed_pairs(void **state)
{
    (void)state;
    static const char node[] = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n", ele[] = "1 3 0\n1 1 2 3\n";
    const struct {
        const char *node, *ele, *says;
        int64_t line;
    } cases[] = {
        {"", ele, "p.node:1: the file is empty", 1},
        {"three 2\n", ele, "p.node:1: expected the number of rows, found 'three'", 1},
        {"3 2 0 0 \n1 0 0\n2 1 0\n", ele, "p.node:3: the file ends after 2 of 3 vertices", 3},
        {"4000000000 2 0 0\n1 0 0\n", ele, "p.node:2: the file ends after 1 of 4000000000 vertices",
         2},
        {"3 4 0 0\n", ele, "p.node:1: the vertices have 4 coordinates", 1},
        {"3 2 4000000000 0\n1 0 0\n", ele, "p.node:1: more than 4096 attributes", 1},
        {"3 2 -1 0\n1 0 0\n", ele, "p.node:1: a number in the header is negative", 1},
        {"3 2 1 0\n1 0 0\n", ele, "p.node:2: the line ends before the attribute", 2},
        {"3 2 0 0\n1 0\n", ele, "p.node:2: the line ends before the coordinate", 2},
        {"3 2 0 0\n7 0 0\n", ele, "p.node:2: the first vertex has the number 7", 2},
        {"3 2 0 0\n1 0 0\n3 0 1\n", ele, "p.node:3: vertex 3 where 2 was expected", 3},
        {"3 2 0 0\n1 0 0\n2 0,5 1\n", ele, "p.node:3: coordinate: '0,5' is not a number", 3},
        {"3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n4 1 1\n", ele,
         "p.node:5: there are more than the 3 vertices", 5},
        {node, "", "p.ele:1: the file is empty", 1},
        {node, "1 4 0\n1 1 2 3 3\n", "p.ele:1: the elements have 4 corners", 1},
        {node, "1 3 0\n", "p.ele:1: the file ends after 0 of 1 triangles", 1},
        {node, "1 3 0\n1 1 2\n", "p.ele:2: the line ends before the corner", 2},
        {node, "1 3 0\n1 0 1 2\n", "p.ele:2: vertex 0 does not exist: there are 3, numbered from 1",
         2},
        {node, "1 3 0\n1 1 2 4\n", "p.ele:2: vertex 4 does not exist", 2},
        {node, "1 3 0\n1 1 2 4294967298\n", "p.ele:2: vertex 4294967298 does not exist", 2},
        {node, "2 3 0\n1 1 2 3\n3 1 2 3\n", "p.ele:3: triangle 3 where 2 was expected", 3},
        {node, "1 3 0\n1 1 2 3\n2 1 2 3\n", "p.ele:3: there are more than the 1 triangles", 3},
        {node, "1 3 0\n1 1 2 x\n", "p.ele:2: expected the corner, found 'x'", 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mw_mesh_file file;
        mw_error error;
        files_write_text("p.node", cases[i].node);
        files_write_text("p.ele", cases[i].ele);
        if (mw_read_mesh("p", NULL, &file, &error) != MW_ERROR_INPUT)
            fail_msg("case %zu was taken", i);
        files_expect_error(&error, MW_ERROR_INPUT, cases[i].line, cases[i].says);
        assert_null(file.points);
    }
    files_clear();
}

static void expect_bad_bytes(const char *name, bytes contents, const char *says)
{
    mw_mesh_file file;
    mw_error error;
    files_write(name, contents);
    assert_int_equal(mw_read_mesh(name, NULL, &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, error.line, says);
    unlink(name);
}

static void test_malformed_binary(void **state)
{
    (void)state;
    char room[512];
    static const float corners[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}};
    expect_bad_bytes("e.stl", BYTES(""), "e.stl: at byte 0: the data end early");
    expect_bad_bytes("e.stl", BYTES("too short"), "e.stl: at byte 9: the data end early");
    expect_bad_bytes("e.stl", mesh_file_stl(room, "", 3, corners, 2),
                     "e.stl: at byte 184: the data end after 2 of 3 triangles");
    expect_bad_bytes("e.stl", mesh_file_stl(room, "", 4000000000u, corners, 1),
                     "at byte 134: the data end after 1 of 4000000000");
    bytes cut = mesh_file_stl(room, "solid cut", 2, corners, 2);
    cut.size -= 7;
    expect_bad_bytes("e.stl", cut, "at byte 134: the data end after 1 of 2 triangles");
    expect_bad_bytes("e.stl", mesh_file_stl(room, "", 1, corners, 2),
                     "more data after the 1 triangles");
    expect_bad_bytes("e.off", BYTES("OFF\n1 0 0\n0\0 0 0\n"), "e.off:3: a NUL byte");
    expect_bad_bytes("e.obj", BYTES("v 0 0 0\nv \0\n"), "e.obj:2: a NUL byte");
#define PLYB                                                                                       \
    "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\n"
#define PLYBF PLYB "element face 1\nproperty list char char vertex_indices\nend_header\n\1\2"
    expect_bad_bytes("e.ply", BYTES(PLYB "end_header\n\1"), "at byte 99: the data end early");
    expect_bad_bytes("e.ply", BYTES(PLYB "end_header\n\1\2x"), "at byte 100: there are more data");
    expect_bad_bytes("e.ply", BYTES(PLYBF "\3\0\0\1"), "vertex 1 does not exist");
    expect_bad_bytes("e.ply", BYTES(PLYBF "\3\0\0\xff"), "vertex -1 does not exist");
    expect_bad_bytes("e.ply", BYTES(PLYBF "\xff\0\0\0"), "a list announces -1 values");
    expect_bad_bytes("e.ply", BYTES(PLYBF "\2\0\0"), "a face has 2 corners");
    expect_bad_bytes("e.ply", BYTES(PLYBF "\x7f\0\0\0"), "the data end early");
}

/* gzip that ends early or is damaged; a name that says gzip is not needed, nor trusted. */
static void test_gzip(void **state)
{
    (void)state;
    static const char text[] = "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n";
    files_write_text("plain.off.gz", text);
    mw_mesh_file file = mesh_file_read("plain.off.gz");
    mw_mesh_file_release(&file);
    files_write_gzip("packed.off", BYTES(text));
    file = mesh_file_read("packed.off");
    mesh_file_expect_triangles(&file, 4, 2, square_triangles);
    mw_mesh_file_release(&file);
    size_t size;
    char *packed = files_read("packed.off", &size);
    for (size_t cut = 10; cut < size; cut++) {
        mw_error error;
        files_write("cut.off", (bytes){packed, cut});
        assert_int_equal(mw_read_mesh("cut.off", NULL, &file, &error), MW_ERROR_INPUT);
        assert_non_null(strstr(error.message, "cut.off:"));
        assert_non_null(strstr(error.message, "gzip data end early"));
        /* at the line that is missing or cut */
        assert_true(error.line >= 1 && error.line <= 8);
        if (cut + 1 == size) assert_int_equal(error.line, 8);
    }
    assert_true(size > 30);
    packed[size - 6] ^= 1; /* the checksum */
    files_write("damaged.off", (bytes){packed, size});
    mw_error error;
    assert_int_equal(mw_read_mesh("damaged.off", NULL, &file, &error), MW_ERROR_INPUT);
    assert_non_null(strstr(error.message, "gzip data are damaged"));
    free(packed);
    files_clear();
}

/* Every prefix of good files is refused or, where nothing tells, read; it never crashes. */
static void test_prefixes(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text;
    } files[] = {{"t.off", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n"},
                 {"t.obj", SQUARE_V "f 1 2 3 4\n"},
                 {"t.ply", PLYF "3 0 1 2\n"},
                 {"t.stl", "solid a\n" STL_FACET("0 0 0", "1 0 0", "1 1 0.5") "endsolid\n"}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        size_t size = strlen(files[i].text);
        for (size_t cut = 0; cut < size; cut++) {
            mw_mesh_file file;
            mw_error error;
            files_write(files[i].name, (bytes){files[i].text, cut});
            mw_status status = mw_read_mesh(files[i].name, NULL, &file, &error);
            /* OBJ announces nothing; of the others only the last line end, or a shorter last
             * number, may be missed */
            if (status == MW_OK && i != 1 && cut + 2 < size)
                fail_msg("%s of %zu bytes was taken", files[i].name, cut);
            if (status != MW_OK) assert_int_equal(status, MW_ERROR_INPUT);
            mw_mesh_file_release(&file);
        }
    }
    files_clear();
}

static void test_long_line(void **state)
{
    (void)state;
    size_t size = ((size_t)1 << 24) + 100;
    char *text = malloc(size);
    assert_non_null(text);
    memset(text, ' ', size);
    memcpy(text, "OFF\n4 1 0\n", 10);
    expect_bad_bytes("e.off", (bytes){text, size}, "e.off:3: a line is longer than 16777216 bytes");
    /* a line of some megabytes is taken, and so are many blocks without a line end among them */
    memcpy(text + 5000000, "\n" SQUARE_BODY "4 0 1 2 3\n", strlen("\n" SQUARE_BODY "4 0 1 2 3\n"));
    mw_mesh_file file = mesh_file_read_bytes(
        "a.off", (bytes){text, 5000000 + strlen("\n" SQUARE_BODY "4 0 1 2 3\n")});
    mesh_file_expect_triangles(&file, 4, 2, square_triangles);
    mw_mesh_file_release(&file);
    free(text);
}

static void test_not_there(void **state)
{
    (void)state;
    mw_mesh_file file;
    mw_error error;
    assert_int_equal(mw_read_mesh("missing.off", NULL, &file, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "missing.off: No such file or directory");
    assert_int_equal(mw_read_mesh(".", NULL, &file, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "Is a directory");
    assert_int_equal(mw_read_mesh(NULL, NULL, &file, &error), MW_ERROR_ARGUMENT);
    assert_int_equal(mw_read_mesh("x", NULL, NULL, &error), MW_ERROR_ARGUMENT);
    mw_mesh_file_release(&file);
    mw_mesh_file_release(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_malformed),        cmocka_unit_test(test_malformed_pairs),
        cmocka_unit_test(test_malformed_binary), cmocka_unit_test(test_gzip),
        cmocka_unit_test(test_prefixes),         cmocka_unit_test(test_long_line),
        cmocka_unit_test(test_not_there),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
