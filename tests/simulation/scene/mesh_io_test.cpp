#include "simulation/scene/mesh/mesh_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

// Corners with coordinates that no 32-bit float holds.
SurfaceMesh Tetrahedron() {
  SurfaceMesh surface;
  surface.vertices = {{0.1, 0, 1.0 / 3}, {1, 0.1, 0}, {0, 1.0 / 7, 0}, {0, 1e-17, 0.7}};
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return surface;
}

std::string SentenceOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.sentence().find('\n'), std::string::npos) << "one sentence, one line";
    return error.what();
  }
  return "";
}

// Writes `bytes` under `name` and says why they are refused; empty when they are not.
std::string FaultOf(const std::string& name, const std::string& bytes) {
  test::TempFolder folder;
  WriteAtomically(folder / name, bytes);
  return SentenceOf([&] { ReadSurface(folder / name, 1.0); });
}

#define EXPECT_SAYS(sentence, part) \
  EXPECT_NE((sentence).find(part), std::string::npos) << "it said: " << (sentence)

const char* const kSquareObj =
    "# a unit square\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nvn 0 0 1\r\n"
    "f 1//1 2//1 3//1 \\\r\n4//1\r\n";

TEST(SurfaceFiles, PlyAndObjKeepEveryBitAndStlItsFloats) {
  test::TempFolder folder;
  const SurfaceMesh surface = Tetrahedron();
  for (const char* name : {"a.ply", "a.obj"}) {
    WriteSurface(folder / name, surface);
    const SurfaceMesh back = ReadSurface(folder / name, 1.0);
    EXPECT_EQ(back.vertices, surface.vertices) << name;
    EXPECT_EQ(back.triangles, surface.triangles) << name;
  }
  WriteSurface(folder / "a.stl", surface);
  SurfaceReadReport report;
  const SurfaceMesh back = ReadSurface(folder / "a.stl", 1.0, &report);
  ASSERT_EQ(back.vertices.size(), 4u) << "the twelve corners of the soup are four points";
  EXPECT_EQ(report.merged_vertices, 8);
  EXPECT_EQ(back.triangles.size(), 4u);
  EXPECT_EQ(back.vertices[0].z, static_cast<double>(static_cast<float>(1.0 / 3)));
}

TEST(SurfaceFiles, DeclaredUnitBecomesMetres) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.OBJ", kSquareObj);
  EXPECT_EQ(ReadSurface(folder / "a.OBJ", 1e-3).vertices[2], glm::dvec3(1e-3, 1e-3, 0));
}

TEST(SurfaceFiles, TextStlOfOneTriangleIsRead) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.stl",
                  "solid a b c\n facet normal 0 0 1\n outer loop\n vertex -5.49e-003 0 +1\n"
                  " VERTEX 1 0 0\n vertex 0 1 0\n endloop\n endfacet\nendsolid a b c\n");
  const SurfaceMesh surface = ReadSurface(folder / "a.stl", 1.0);
  ASSERT_EQ(surface.triangles.size(), 1u);
  EXPECT_EQ(surface.vertices[0], glm::dvec3(-5.49e-3, 0, 1));
}

TEST(SurfaceFiles, BinaryStlWhoseHeaderBeginsWithSolidIsBinary) {
  test::TempFolder folder;
  WriteSurface(folder / "a.stl", Tetrahedron());
  std::string bytes = ReadWholeFile(folder / "a.stl");
  bytes.replace(0, 5, "solid");
  WriteAtomically(folder / "a.stl", bytes);
  EXPECT_EQ(ReadSurface(folder / "a.stl", 1.0).triangles.size(), 4u);
}

TEST(SurfaceFiles, TextAndBigEndianPlyWithColoursAndUnknownElementsAreRead) {
  const std::string head =
      " 1.0\ncomment made by hand\nelement material 1\nproperty list uchar int ids\n"
      "element vertex 3\nproperty uchar red\nproperty float z\nproperty float y\n"
      "property float x\nelement face 1\nproperty list uchar uint vertex_index\nend_header\n";
  test::TempFolder folder;
  WriteAtomically(folder / "a.ply",
                  "ply\nformat ascii" + head + "2 7 8\n9 0 0 0\n9 0 0 1\n9 0 1 0\n3 0 1 2\n");
  std::string binary = "ply\nformat binary_big_endian" + head;
  const auto add = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    binary.append(std::make_reverse_iterator(raw + sizeof value), std::make_reverse_iterator(raw));
  };
  add(std::uint8_t{2}), add(7), add(8);
  for (const glm::vec3 zyx : {glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0)})
    add(std::uint8_t{9}), add(zyx.x), add(zyx.y), add(zyx.z);
  add(std::uint8_t{3}), add(0u), add(1u), add(2u);
  WriteAtomically(folder / "b.ply", binary);
  for (const char* name : {"a.ply", "b.ply"}) {
    const SurfaceMesh surface = ReadSurface(folder / name, 1.0);
    ASSERT_EQ(surface.vertices.size(), 3u) << name;
    EXPECT_EQ(surface.vertices[1], glm::dvec3(1, 0, 0)) << name;
    EXPECT_EQ(surface.vertices[2], glm::dvec3(0, 1, 0)) << name;
  }
}

TEST(SurfaceFiles, OffWithCommentsAndColoursIsRead) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.off",
                  "COFF # colours\n\n4 1 0\n0 0 0 255 0 0\n1 0 0 1 2 3\n# between\n1 1 0 1 2 3\n"
                  "0 1 0 1 2 3\n4 0 1 2 3 0.5 0.5 0.5\n");
  EXPECT_EQ(ReadSurface(folder / "a.off", 1.0).triangles.size(), 2u);
}

TEST(SurfaceFiles, VtpWithPolygonsAndStripsIsRead) {
  test::TempFolder folder;
  WriteAtomically(
      folder / "a.vtp",
      R"(<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="5" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="1" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 0 0.1 2 0</DataArray></Points>
<Strips><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Strips>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">2 3 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys>
</Piece></PolyData></VTKFile>)");
  const SurfaceMesh surface = ReadSurface(folder / "a.vtp", 1.0);
  ASSERT_EQ(surface.triangles.size(), 3u);
  EXPECT_EQ(surface.vertices[4], glm::dvec3(0.1, 2, 0));
  for (const auto& [a, b, c] : surface.triangles) {  // all of them face +z
    const glm::dvec3 ab = surface.vertices[b] - surface.vertices[a];
    const glm::dvec3 ac = surface.vertices[c] - surface.vertices[a];
    EXPECT_GT(ab.x * ac.y - ab.y * ac.x, 0);
  }
}

TEST(SurfaceFiles, ConcavePolygonKeepsItsArea) {
  test::TempFolder folder;
  // A letter L of area 3, begun at a corner from which a fan would leave it.
  WriteAtomically(folder / "a.obj",
                  "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
  const SurfaceMesh surface = ReadSurface(folder / "a.obj", 1.0);
  ASSERT_EQ(surface.triangles.size(), 4u);
  double area = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const glm::dvec3 ab = surface.vertices[b] - surface.vertices[a];
    const glm::dvec3 ac = surface.vertices[c] - surface.vertices[a];
    const double part = 0.5 * (ab.x * ac.y - ab.y * ac.x);
    EXPECT_GE(part, 0);
    area += part;
  }
  EXPECT_DOUBLE_EQ(area, 3.0);
}

TEST(SurfaceFiles, WhatReadingChangedIsCounted) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.obj",
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\nv 9 9 9\nf 1 2 3\nf 1 2 4\n");
  SurfaceReadReport report;
  const SurfaceMesh surface = ReadSurface(folder / "a.obj", 1.0, &report);
  EXPECT_EQ(surface.vertices.size(), 3u);
  EXPECT_EQ(report.merged_vertices, 1) << "-0 is 0";
  EXPECT_EQ(report.degenerate_triangles, 1);
  EXPECT_EQ(report.unreferenced_vertices, 1);
}

TEST(SurfaceFiles, DamagedFilesAreRefusedInOneSentence) {
  EXPECT_SAYS(FaultOf("a.obj", ""), "empty (0 bytes)");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), "names vertex 3");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nf 1 2 -2\n"), "vertex -2 does not exist");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nf 1 1 0\n"), "vertex 0 does not exist");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nv 0,5 0 0\n"), "line 2: \"0,5\" is not a number");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"), "vertex 1");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nv 1 1e999 0\nv 0 1 0\nf 1 2 3\n"), "finite");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nv 1 0 0\n"), "no triangle");
  EXPECT_SAYS(FaultOf("a.obj", "v 0 0 0\nv 1 0 0\nf 1 1 2\n"), "two corners on one point");
  EXPECT_SAYS(FaultOf("a.off", "OFF\n4 1 0\n0 0 0\n"), "cut off");
  EXPECT_SAYS(FaultOf("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "vertex 3");
  EXPECT_SAYS(FaultOf("a.off", "OFF\n999999999999 1 0\n"), "cannot be in a file of this size");
  EXPECT_SAYS(FaultOf("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
              "no \"endsolid\"");
  EXPECT_SAYS(FaultOf("a.stl", "this is a letter"), "not an STL file");
  EXPECT_SAYS(FaultOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"),
              "header has no end");
  EXPECT_SAYS(FaultOf("a.vtp", "this is a letter"), "VTP");
  EXPECT_SAYS(FaultOf("a.step", "ISO-10303-21;"), "use .stl, .obj, .ply, .off or .vtp");
  test::TempFolder folder;
  EXPECT_SAYS(SentenceOf([&] { ReadSurface(folder / "no.stl", 1.0); }), "could not be opened");
  EXPECT_SAYS(SentenceOf([&] { ReadSurface(folder.path(), 1.0); }), "folder");
}

TEST(SurfaceFiles, EveryCutOfABinaryFileIsRefused) {
  test::TempFolder folder;
  for (const char* name : {"a.stl", "a.ply"}) {
    WriteSurface(folder / name, Tetrahedron());
    const std::string whole = ReadWholeFile(folder / name);
    for (std::size_t size = 1; size < whole.size(); ++size) {
      const std::string fault = FaultOf(name, whole.substr(0, size));
      EXPECT_FALSE(fault.empty()) << name << " of " << size << " bytes";
    }
  }
}

// A damaged file gives a whole surface or one sentence.
TEST(SurfaceFiles, RandomDamageIsReadWholeOrRefusedInOneSentence) {
  test::TempFolder folder;
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525u + 1013904223u; };
  for (const char* name : {"a.stl", "a.ply", "a.obj"}) {
    WriteSurface(folder / name, Tetrahedron());
    const std::string whole = ReadWholeFile(folder / name);
    int read = 0, refused = 0;
    for (int trial = 0; trial < 300; ++trial) {
      std::string bytes = whole;
      for (int hit = 0; hit < 3; ++hit)
        bytes[(next() >> 8) % bytes.size()] = static_cast<char>(next() >> 24);
      WriteAtomically(folder / name, bytes);
      SurfaceMesh surface;
      const std::string fault = SentenceOf([&] { surface = ReadSurface(folder / name, 1.0); });
      if (!fault.empty()) {
        ++refused;
        EXPECT_EQ(fault.find('\n'), fault.npos) << name << ": " << fault;
        continue;
      }
      ++read;
      EXPECT_FALSE(surface.triangles.empty()) << name << ", trial " << trial;
      for (const glm::dvec3& x : surface.vertices)
        EXPECT_TRUE(std::isfinite(x.x + x.y + x.z)) << name << ", trial " << trial;
      for (const auto& triangle : surface.triangles)
        for (const int corner : triangle) {
          EXPECT_GE(corner, 0) << name << ", trial " << trial;
          EXPECT_LT(corner, static_cast<int>(surface.vertices.size())) << name << ", " << trial;
        }
    }
    EXPECT_GT(refused, 0) << name;
    EXPECT_GT(read, 0) << name;
  }
}

TEST(SurfaceFiles, RealCartilageIsClosedAfterWelding) {
  ARTHRO_REQUIRE_SHARED(file, "data/knee_cartilage_jam/lenhart2015-R-tibia-cartilage.stl");
  SurfaceReadReport report;
  const SurfaceMesh surface = ReadSurface(file, 1.0, &report);
  EXPECT_EQ(surface.triangles.size() + report.degenerate_triangles, 8602u);
  EXPECT_LT(surface.vertices.size(), 8602u) << "a welded surface has about half as many vertices";
}

TEST(SurfaceFiles, UnknownExtensionIsNotWritten) {
  test::TempFolder folder;
  EXPECT_THROW(WriteSurface(folder / "a.vtk", Tetrahedron()), Error);
  EXPECT_FALSE(fs::exists(folder / "a.vtk"));
}

// --- volumes ---

TetMesh TwoTets() {
  TetMesh mesh;
  mesh.rest_positions = {{0.1, 0, 0}, {1, 1.0 / 3, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.elements = {0, 1, 2, 3, 1, 2, 3, 4};
  if (glm::dot(glm::cross(mesh.rest_positions[2] - mesh.rest_positions[1],
                          mesh.rest_positions[3] - mesh.rest_positions[1]),
               mesh.rest_positions[4] - mesh.rest_positions[1]) < 0)
    std::swap(mesh.elements[4], mesh.elements[5]);
  mesh.sets["clamp"] = {1, 0, 0, 1, 0};
  return mesh;
}

TetMesh OneQuadraticTet() {
  TetMesh mesh;
  mesh.order = 2;
  const glm::dvec3 x[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  mesh.rest_positions.assign(x, x + 4);
  for (const auto& [a, b] : edges) mesh.rest_positions.push_back(0.5 * (x[a] + x[b]));
  for (int i = 0; i < 10; ++i) mesh.elements.push_back(i);
  mesh.sets["all"] = std::vector<std::uint8_t>(10, 1);
  return mesh;
}

void ExpectSame(const TetMesh& a, const TetMesh& b) {
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.rest_positions, b.rest_positions);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.sets, b.sets);
}

TEST(TetFiles, BothOrdersKeepEveryBitAndGiveTheSameBytesTwice) {
  test::TempFolder folder;
  for (const TetMesh& mesh : {TwoTets(), OneQuadraticTet()}) {
    WriteTetMesh(folder / "a.vtu", mesh);
    WriteTetMesh(folder / "b.vtu", mesh);
    TetReadReport report;
    ExpectSame(ReadTetMesh(folder / "a.vtu", &report), mesh);
    EXPECT_TRUE(report.messages.empty()) << report.messages[0];
    EXPECT_EQ(ReadWholeFile(folder / "a.vtu"), ReadWholeFile(folder / "b.vtu"));
  }
}

// A VTU in text, so that faults can be put into it.
std::string VtuText(const std::string& points, const std::string& cells,
                    const std::string& types = "10 10", const std::string& offsets = "4 8") {
  const auto count = std::to_string(1 + std::count(types.begin(), types.end(), ' '));
  const auto rows = std::to_string(1 + std::count(points.begin(), points.end(), ','));
  std::string numbers = points;
  std::replace(numbers.begin(), numbers.end(), ',', ' ');
  return R"(<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints=")" +
         rows + R"(" NumberOfCells=")" + count +
         R"("><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">)" + numbers +
         R"(</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">)" +
         cells + R"(</DataArray><DataArray type="Int64" Name="offsets" format="ascii">)" + offsets +
         R"(</DataArray><DataArray type="UInt8" Name="types" format="ascii">)" + types +
         "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

const char* const kFivePoints = "0 0 0,1 0 0,0 1 0,0 0 1,1 1 1";

std::string TetFaultOf(const std::string& bytes) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.vtu", bytes);
  return SentenceOf([&] { ReadTetMesh(folder / "a.vtu"); });
}

// Repairs that reading reports, in one line.
std::string RepairsOf(const std::string& bytes, TetMesh* mesh) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.vtu", bytes);
  TetReadReport report;
  *mesh = ReadTetMesh(folder / "a.vtu", &report);
  std::string all;
  for (const auto& message : report.messages) all += message + "; ";
  return all;
}

TEST(TetFiles, DamagedFilesAreRefusedInOneSentence) {
  EXPECT_EQ(TetFaultOf(VtuText(kFivePoints, "0 1 2 3 1 2 3 4")), "");
  EXPECT_SAYS(TetFaultOf(""), "empty");
  EXPECT_SAYS(TetFaultOf("this is a letter"), "not a whole VTU");
  EXPECT_SAYS(TetFaultOf(VtuText(kFivePoints, "0 1 2 3 1 2 3 5")), "names point 5");
  EXPECT_SAYS(TetFaultOf(VtuText(kFivePoints, "0 1 2 3 1 2 3 -1")), "names point -1");
  EXPECT_SAYS(TetFaultOf(VtuText(kFivePoints, "0 1 2 3 1 2 3", "10 10", "4 7")), "VTU");
  EXPECT_SAYS(TetFaultOf(VtuText(kFivePoints, "0 1 2 3 0 1 2", "10 5", "4 7")), "vtkTriangle");
  EXPECT_SAYS(TetFaultOf(VtuText("0 0 0,1 0 0,0 1 0,0 nan 1,1 1 1", "0 1 2 3 1 2 3 4")), "finite");
  EXPECT_SAYS(TetFaultOf(VtuText("0 0 0,1 0 0,0 1 0,1 1 0,1 1 1", "0 1 2 3 1 2 3 4")),
              "element 0 has no volume");
  EXPECT_SAYS(TetFaultOf(VtuText(kFivePoints, "0 1 2 2 1 2 3 4")), "element 0 has no volume");
  test::TempFolder folder;
  EXPECT_SAYS(SentenceOf([&] { ReadTetMesh(folder.path()); }), "folder");
  EXPECT_SAYS(SentenceOf([&] { ReadTetMesh(folder / "no.vtu"); }), "could not be opened");
  WriteAtomically(folder / "a.msh", "$MeshFormat");
  EXPECT_SAYS(SentenceOf([&] { ReadTetMesh(folder / "a.msh"); }), "tetrahedralize");
}

TEST(TetFiles, EveryCutIsRefused) {
  test::TempFolder folder;
  WriteTetMesh(folder / "a.vtu", TwoTets());
  const std::string whole = ReadWholeFile(folder / "a.vtu");
  const std::size_t end = whole.rfind("</VTKFile>");
  for (std::size_t size = 1; size < end; size += 7)
    EXPECT_FALSE(TetFaultOf(whole.substr(0, size)).empty()) << size << " bytes";
}

TEST(TetFiles, RandomDamageNeverCrashesAndVtkStaysSilent) {
  test::TempFolder folder;
  WriteTetMesh(folder / "a.vtu", TwoTets());
  const std::string whole = ReadWholeFile(folder / "a.vtu");
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525u + 1013904223u; };
  ::testing::internal::CaptureStderr();
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string bytes = whole;
    for (int hit = 0; hit < 3; ++hit)
      bytes[(next() >> 8) % bytes.size()] = static_cast<char>(32 + (next() >> 24) % 95);
    refused += !TetFaultOf(bytes).empty();
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "VTK's own words reach nobody";
  EXPECT_GT(refused, 100);
}

TEST(TetFiles, ElementsListedInsideOutAreTurned) {
  TetMesh mesh;
  EXPECT_SAYS(RepairsOf(VtuText(kFivePoints, "1 0 2 3 1 2 3 4"), &mesh), "1 elements were listed");
  EXPECT_EQ(mesh.elements, (std::vector<int>{0, 1, 2, 3, 1, 2, 3, 4}));
}

TEST(TetFiles, TurnedQuadraticElementKeepsItsMiddlesOnItsEdges) {
  test::TempFolder folder;
  TetMesh mesh = OneQuadraticTet();
  mesh.elements = {1, 0, 2, 3, 4, 6, 5, 8, 7, 9};
  WriteTetMesh(folder / "a.vtu", mesh);
  EXPECT_EQ(ReadTetMesh(folder / "a.vtu").elements, OneQuadraticTet().elements);
}

TEST(TetFiles, DuplicateNodesAndElementsAndLooseNodesAreRepairedWithAMessage) {
  TetMesh mesh;
  // Node 5 lies on node 3, node 6 is in no element, element 2 is element 0 in another order.
  const std::string said = RepairsOf(VtuText("0 0 0,1 0 0,0 1 0,0 0 1,1 1 1,0 0 1,9 9 9",
                                             "0 1 2 3 1 2 5 4 1 2 0 3", "10 10 10", "4 8 12"),
                                     &mesh);
  EXPECT_SAYS(said, "1 nodes lay exactly on another");
  EXPECT_SAYS(said, "1 elements were there twice");
  EXPECT_SAYS(said, "nodes belong to no element");
  EXPECT_EQ(mesh.rest_positions.size(), 5u);
  EXPECT_EQ(mesh.elements, (std::vector<int>{0, 1, 2, 3, 1, 2, 3, 4}));
}

TEST(TetFiles, SliversAreReadWithAWarning) {
  TetMesh mesh;
  EXPECT_SAYS(RepairsOf(VtuText("0 0 0,1 0 0,0 1 0,0.3 0.3 1e-10,1 1 1", "0 1 2 3 1 2 3 4"), &mesh),
              "nearly flat");
  EXPECT_EQ(mesh.ElementCount(), 2);
}

TEST(TetFiles, ArraysOfOtherValuesAreNotSets) {
  test::TempFolder folder;
  TetMesh mesh = TwoTets();
  mesh.sets["weight"] = {0, 1, 2, 0, 0};
  WriteTetMesh(folder / "a.vtu", mesh);
  EXPECT_FALSE(ReadTetMesh(folder / "a.vtu").sets.contains("weight"));
}

TEST(TetFiles, RefusalLeavesTheOldFile) {
  test::TempFolder folder;
  WriteTetMesh(folder / "a.vtu", TwoTets());
  EXPECT_THROW(WriteTetMesh(folder / "a.txt", TwoTets()), Error);
  EXPECT_THROW(WriteTetMesh(folder / "none" / "a.vtu", TwoTets()), Error);
  ExpectSame(ReadTetMesh(folder / "a.vtu"), TwoTets());
}

TEST(TetFiles, ReferenceCasesAreReadUnchangedWithTheirSets) {
  ARTHRO_REQUIRE_SHARED(reference, "reference/tissue");
  int linear = 0, quadratic = 0;
  for (const auto& entry : fs::directory_iterator(reference)) {
    if (entry.path().extension() != ".vtu") continue;
    TetReadReport report;
    const TetMesh mesh = ReadTetMesh(entry.path(), &report);
    EXPECT_TRUE(report.messages.empty()) << entry.path() << ": " << report.messages[0];
    EXPECT_FALSE(mesh.sets.empty()) << entry.path();
    ++(mesh.order == 2 ? quadratic : linear);
  }
  EXPECT_GT(linear, 5);
  EXPECT_GT(quadratic, 3);
}

}  // namespace
}  // namespace arthro
