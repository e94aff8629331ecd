// Volumes, cases and archives that once crashed the program, hung it or took all memory: each is
// refused (refusal.h). All of them are made in code.
#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <zip.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/scene/files/archive_io.h"
#include "tests/hostile/child_run.h"
#include "tests/hostile/refusal.h"
#include "tests/hostile/tet_block.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

template <class Values, class Text>
std::string Joined(const Values& values, Text&& text) {
  std::string joined;
  for (const auto& value : values) joined += std::string(text(value)) + " ";
  return joined;
}

// A block of tetrahedra in VTK's XML format, as text.
std::string VtuText(const TetMesh& mesh) {
  const auto number = [](auto value) { return fmt::format("{}", value); };
  const std::size_t count = mesh.elements.size() / 4;
  std::vector<std::size_t> offsets(count);
  for (std::size_t e = 0; e < count; ++e) offsets[e] = 4 * (e + 1);
  std::string sets;
  for (const auto& [name, values] : mesh.sets)
    sets += fmt::format(R"(<DataArray type="UInt8" Name="{}" format="ascii">{}</DataArray>)", name,
                        Joined(values, [](auto is_in) { return is_in ? "1" : "0"; }));
  return fmt::format(
      R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="{}" NumberOfCells="{}"><PointData>{}</PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{}</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)",
      mesh.rest_positions.size(), count, sets,
      Joined(mesh.rest_positions,
             [](const glm::dvec3& x) { return fmt::format("{} {} {}", x.x, x.y, x.z); }),
      Joined(mesh.elements, number), Joined(offsets, number),
      Joined(offsets, [](auto) { return std::string("10"); }));
}

std::string Replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

std::string Repeated(std::string_view text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// A block that hangs from its fixed end. `force` is its body force, N/m³.
void WriteCase(const fs::path& folder, const std::string& vtu, const char* law = "corotated",
               double poisson_ratio = 0.3, const char* force = "[0, 0, -9810]") {
  fs::create_directories(folder);
  std::ofstream(folder / "block.vtu") << vtu;
  std::ofstream(folder / "case.json") << fmt::format(
      R"({{"mesh": "block.vtu", "order": 1, "material": {{"model": "{}", "young_modulus": 1e6,
      "poisson_ratio": {}, "density": 1000}}, "fixed": [{{"set": "fixed", "axes": "xyz"}}],
      "loads": [{{"set": "end", "total_force": [0, 0, -0.05]}}], "body_force": {},
      "mode": "static", "tolerance": 1e-8}})",
      law, poisson_ratio, force);
}

TEST(FaultInputs, AnUndamagedCaseOfTheseTestsIsSolved) {
  const TempFolder folder;
  WriteCase(folder / "c", VtuText(TetBlock(4)));
  ChildCommand command;
  command.arguments = {ARTHRO_PROGRAM, "solve", folder / "c/case.json", "-o", folder / "r.json"};
  command.folder = command.scratch = folder.path();
  const ChildRun run = RunChild(command);
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST(FaultInputs, CasesThatTurnElementsInsideOutAreRefused) {
  const TempFolder folder;
  // A million times the weight, onto the fixed end.
  const char* const crush = "[-1e10, 3e9, 2e9]";
  WriteCase(folder / "a", VtuText(TetBlock(4)), "corotated", 0.0, crush);
  WriteCase(folder / "b", VtuText(TetBlock(4)), "stable_neo_hookean", 0.4, crush);
  for (const char* name : {"a", "b"})
    RefusalOf({"solve", folder / name / "case.json", "-o", "OUT/r.json"}, {.writes_result = true});
}

TEST(FaultInputs, VolumesWithFalseCountsOrDeepNestingAreRefusedByName) {
  const std::string sound = VtuText(TetBlock(4));
  const std::string cells = R"(NumberOfCells="24")", parts = R"(NumberOfComponents="3")",
                    set = R"(Name="fixed")", types = R"(type="UInt8" Name="types")";
  std::vector<std::string> volumes = {sound.substr(0, sound.find('\n') + 1) +
                                          Repeated("<DataArray>", 300'000) +
                                          Repeated("</DataArray>", 300'000),
                                      Replaced(sound, types, R"(type="Bit" Name="types")")};
  for (const char* count : {"-1", "10000000000", "-1e308"})
    volumes.push_back(Replaced(sound, cells, fmt::format("NumberOfCells=\"{}\"", count)));
  for (const char* count : {"-1", "-2147483648"}) {
    const std::string components = fmt::format("NumberOfComponents=\"{}\"", count);
    volumes.push_back(Replaced(sound, parts, components));
    volumes.push_back(Replaced(sound, set, set + " " + components));
  }
  const TempFolder folder;
  for (const std::string& volume : volumes) {
    WriteCase(folder / "c", volume);
    const std::string said = RefusalOf({"solve", folder / "c/case.json", "-o", "OUT/r.json"});
    EXPECT_NE(said.find("block.vtu"), said.npos) << said;
  }
}

TEST(FaultInputs, ASceneWithABrokenVolumeIsRefusedByEveryJob) {
  const TempFolder folder;
  const fs::path scene = WriteSmallScene(folder / "s");
  std::ofstream(scene / "m.vtu") << Replaced(VtuText(TetBlock(4)), R"(NumberOfCells="24")",
                                             R"(NumberOfCells="-1")");
  Scene value = ReadScene(scene / "scene.json");
  value.tissues[0].mesh = "m.vtu";
  WriteScene(scene / "scene.json", value);
  std::ofstream(folder / "trace.csv") << "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                                         "0,scope,0,0,-0.18,1,0,0,0,0\n";
  for (const std::vector<std::string>& job :
       {std::vector<std::string>{"check", scene},
        {"replay", scene, folder / "trace.csv", "-o", "OUT/c.csv"}}) {
    const std::string said = RefusalOf(job);
    EXPECT_NE(said.find("NumberOfCells is \"-1\""), said.npos) << said;
  }
}

std::string VtpText(const SurfaceMesh& surface) {
  std::string offsets;
  for (std::size_t i = 1; i <= surface.triangles.size(); ++i) offsets += fmt::format("{} ", 3 * i);
  return fmt::format(
      R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{}</DataArray></Polys>
</Piece></PolyData></VTKFile>
)",
      surface.vertices.size(), surface.triangles.size(),
      Joined(surface.vertices,
             [](const glm::dvec3& x) { return fmt::format("{} {} {}", x.x, x.y, x.z); }),
      Joined(surface.triangles,
             [](const auto& t) { return fmt::format("{} {} {}", t[0], t[1], t[2]); }),
      offsets);
}

TEST(FaultInputs, SurfacesWithFalseCountsAreRefused) {
  const TempFolder folder;
  const std::string sound = VtpText(Octahedron(0.01));
  for (const char* count : {"2147483647", "-1", "1e308"}) {
    std::ofstream(folder / "s.vtp")
        << Replaced(sound, "NumberOfPoints=\"6\"", fmt::format("NumberOfPoints=\"{}\"", count));
    RefusalOf({"tetrahedralize", folder / "s.vtp", "--unit", "m", "-o", "OUT/t.vtu"});
  }
}

// Puts one more file into an archive; a name that stands there already is replaced.
void AddToArchive(const fs::path& archive, const std::string& name, const std::string& bytes) {
  int fault = 0;
  zip_t* zip = zip_open(archive.c_str(), 0, &fault);
  ASSERT_NE(zip, nullptr) << fault;
  zip_source_t* source = zip_source_buffer(zip, bytes.data(), bytes.size(), 0);
  EXPECT_GE(zip_file_add(zip, name.c_str(), source, ZIP_FL_OVERWRITE), 0) << name.substr(0, 40);
  EXPECT_EQ(zip_close(zip), 0) << zip_strerror(zip);
}

TEST(FaultInputs, ArchivesWithDeepJsonOrFalseNamesAreRefusedByTheirOwnName) {
  const TempFolder folder;
  const fs::path sound = folder / "sound.arthro";
  PackScene(WriteSmallScene(folder / "s"), sound);
  const std::string deep = R"({"schema": "arthroscene.scene/1", "x-a": )" + Repeated("[", 200'000) +
                           Repeated("]", 200'000) + "}";
  const std::pair<std::string, std::string> kAdded[] = {{"scene.json", deep},
                                                        {std::string(256, 'a'), ""},
                                                        {std::string(60'000, 'a'), ""},
                                                        {"a\x1b[31mb", ""},
                                                        {"a\nb", ""},
                                                        {Repeated("abcdefghi/", 500) + "x", ""}};
  for (const auto& [name, bytes] : kAdded) {
    const fs::path archive = folder / "damaged.arthro";
    fs::copy_file(sound, archive, fs::copy_options::overwrite_existing);
    AddToArchive(archive, name, bytes);
    for (const std::vector<std::string>& job : {std::vector<std::string>{"check", archive},
                                                {"centres", archive, "--view-angle-deg", "30",
                                                 "--insertion-mm", "5", "-o", "OUT/c.csv"}}) {
      const std::string said = RefusalOf(job);
      EXPECT_NE(said.find(archive.string()), said.npos) << said;
    }
  }
  EXPECT_NE(RefusalOf({"check", sound}, {.has_temporary_folder = false}).find("TMPDIR"),
            std::string::npos)
      << "a sound archive, but nowhere to unpack it";
}

}  // namespace
}  // namespace arthro::test
