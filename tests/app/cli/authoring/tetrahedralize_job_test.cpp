#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace arthro {
namespace {

using test::RunProgram;

// A folder with sound and faulty surfaces in millimetres.
struct Surfaces {
  Surfaces() {
    Write("cube.obj", test::Box({0, 0, 0}, {10, 10, 10}));
    SurfaceMesh open = test::Box({0, 0, 0}, {10, 10, 10});
    open.triangles.pop_back();
    Write("open.stl", open);
    Write("crossing.ply",
          test::Together(test::Box({0, 0, 0}, {10, 10, 10}), test::Box({5, 5, 5}, {15, 15, 15})));
    WriteAtomically(folder / "empty.stl", "");
    WriteAtomically(folder / "nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  void Write(const std::string& name, const SurfaceMesh& surface) {
    WriteSurface(folder / name, surface);
  }
  std::string Path(const std::string& name) const { return (folder / name).string(); }
  test::ProgramResult Fill(const std::string& name, const std::string& more = "--unit mm") const {
    return RunProgram("tetrahedralize " + Path(name) + " " + more + " -o " + Path("out.vtu"));
  }

  test::TempFolder folder;
};

#define EXPECT_SAYS(sentence, part) \
  EXPECT_NE((sentence).find(part), std::string::npos) << "it said: " << (sentence)

TEST(TetrahedralizeJob, WritesMeshAndReport) {
  const Surfaces surfaces;
  const auto result = surfaces.Fill(
      "cube.obj", "--unit mm --order 2 --max-edge-mm 4 --report " + surfaces.Path("r.json"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_SAYS(result.out, "volume 1000 mm3");
  const TetMesh mesh = ReadTetMesh(surfaces.Path("out.vtu"));
  EXPECT_EQ(mesh.order, 2);
  EXPECT_TRUE(mesh.sets.contains("surface"));
  const auto report = nlohmann::json::parse(ReadWholeFile(surfaces.Path("r.json")));
  EXPECT_EQ(report["elements"], mesh.ElementCount());
  EXPECT_NEAR(report["volume"].get<double>(), 1e-6, 1e-15);
  EXPECT_LE(report["longest_edge"].get<double>(), 4e-3);
}

// Nodes within 2 mm of a corner of the cube, and within as much of the opposite one.
std::pair<int, int> NodesAtCorners(const TetMesh& mesh) {
  std::pair<int, int> nodes;
  for (const glm::dvec3& x : mesh.rest_positions) {
    nodes.first += glm::distance(x, glm::dvec3(0.0)) < 2e-3 ? 1 : 0;
    nodes.second += glm::distance(x, glm::dvec3(0.01)) < 2e-3 ? 1 : 0;
  }
  return nodes;
}

TEST(TetrahedralizeJob, AFinePlaceIsFinerThanTheRest) {
  const Surfaces surfaces;
  const auto result = surfaces.Fill("cube.obj",
                                    "--unit mm --order 2 --max-edge-mm 6 --fine-at 0,0,0,2 "
                                    "--fine-edge-mm 0.8 --report " +
                                        surfaces.Path("r.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto [fine, coarse] = NodesAtCorners(ReadTetMesh(surfaces.Path("out.vtu")));
  EXPECT_GT(fine, 20 * coarse);
  const auto report = nlohmann::json::parse(ReadWholeFile(surfaces.Path("r.json")));
  EXPECT_LE(report["longest_fine_edge"].get<double>(), 0.8e-3);
  EXPECT_GT(report["longest_fine_edge"].get<double>(), 0.2e-3);
  EXPECT_EQ(report["fine_at"][0]["radius"], 0.002);
}

TEST(TetrahedralizeJob, ABudgetIsKeptAndSpentWhereItIsProbed) {
  Surfaces surfaces;
  surfaces.Write("ball.ply", test::Sphere({0, 0, 0}, 10, 4));
  for (const auto& [flags, wanted] :
       {std::pair{"--budget coarse", 150}, {"--elements 400 --fine-at 10,0,0,2", 400}}) {
    const auto result = surfaces.Fill("ball.ply", std::string("--unit mm ") + flags);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const TetMesh mesh = ReadTetMesh(surfaces.Path("out.vtu"));
    EXPECT_EQ(mesh.order, 2);
    EXPECT_NEAR(mesh.ElementCount(), wanted, 0.2 * wanted) << flags;
  }
  const TetMesh mesh = ReadTetMesh(surfaces.Path("out.vtu"));
  int probed = 0, opposite = 0;
  for (const glm::dvec3& x : mesh.rest_positions) {
    probed += glm::distance(x, glm::dvec3(0.01, 0, 0)) < 3e-3 ? 1 : 0;
    opposite += glm::distance(x, glm::dvec3(-0.01, 0, 0)) < 3e-3 ? 1 : 0;
  }
  EXPECT_GT(probed, 3 * opposite);
}

TEST(TetrahedralizeJob, PlacesThatCannotBeAreRefusedInOneSentence) {
  const Surfaces surfaces;
  const auto refused = [&](const std::string& more, int code) {
    const auto result = surfaces.Fill("cube.obj", "--unit mm " + more);
    EXPECT_EQ(result.exit_code, code) << more << "\n" << result.err;
    return result.err;
  };
  EXPECT_SAYS(refused("--fine-at 50,0,0,2 --fine-edge-mm 1", 1), "does not touch the surface");
  EXPECT_SAYS(refused("--fine-at 0,0,0,2", 1), "give both");
  EXPECT_SAYS(refused("--fine-edge-mm 1", 1), "give both");
  EXPECT_SAYS(refused("--fine-at 0,0,0,20 --fine-edge-mm 0.01", 1), "--fine-edge-mm 0.27");
  EXPECT_SAYS(refused("--elements 100 --fine-at 50,0,0,2", 1), "does not touch the surface");
  for (const char* ball : {"0,0,0,-1", "0,0,0,0", "0,0,0", "0,0,0,1,2", "0,nan,0,1", "a,b,c,d",
                           "0,0,0,inf", "1e999,0,0,1", "\"\""})
    EXPECT_SAYS(refused(std::string("--fine-edge-mm 1 --fine-at ") + ball, 2), "--fine-at");
  EXPECT_SAYS(refused("--budget huge", 2), "--budget");
  EXPECT_SAYS(refused("--elements 3", 2), "--elements");
  EXPECT_SAYS(refused("--elements 100 --budget fine", 2), "--budget");
  EXPECT_SAYS(refused("--budget fine --max-edge-mm 1", 2), "--max-edge-mm");
  EXPECT_SAYS(refused("--budget fine --fine-at 0,0,0,2 --fine-edge-mm 1", 2), "--fine-edge-mm");
}

TEST(TetrahedralizeJob, SameSurfaceGivesTheSameBytes) {
  const Surfaces surfaces;
  ASSERT_EQ(surfaces.Fill("cube.obj", "--unit mm --max-edge-mm 2").exit_code, 0);
  const std::string first = ReadWholeFile(surfaces.Path("out.vtu"));
  ASSERT_EQ(surfaces.Fill("cube.obj", "--unit mm --max-edge-mm 2").exit_code, 0);
  EXPECT_EQ(ReadWholeFile(surfaces.Path("out.vtu")), first);
}

TEST(TetrahedralizeJob, StandardOutputHoldsTheMeshAlone) {
  const Surfaces surfaces;
  ASSERT_EQ(surfaces.Fill("cube.obj").exit_code, 0);
  const auto piped = RunProgram("tetrahedralize " + surfaces.Path("cube.obj") + " --unit mm -o -");
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(piped.out, ReadWholeFile(surfaces.Path("out.vtu")));
}

TEST(TetrahedralizeJob, FaultySurfacesAreRefusedInOneSentenceAndLeaveTheOldMesh) {
  const Surfaces surfaces;
  WriteAtomically(surfaces.Path("out.vtu"), "the old mesh");
  const auto refused = [&](const std::string& name, const std::string& more = "--unit mm") {
    const auto result = surfaces.Fill(name, more + " --overwrite");
    EXPECT_EQ(result.exit_code, 1) << name;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_SAYS(result.err, name);
    EXPECT_EQ(ReadWholeFile(surfaces.Path("out.vtu")), "the old mesh");
    return result.err;
  };
  EXPECT_SAYS(refused("open.stl"), "open: 3 triangle sides");
  EXPECT_SAYS(refused("crossing.ply"), "runs through itself");
  EXPECT_SAYS(refused("empty.stl"), "empty (0 bytes)");
  EXPECT_SAYS(refused("nan.obj"), "vertex 1 has a coordinate");
  EXPECT_SAYS(refused("none.stl"), "could not be opened");
  EXPECT_SAYS(refused("cube.obj", "--unit m"), "try --unit mm (17.3 mm)");
  EXPECT_SAYS(refused("cube.obj", "--unit um"), "try --unit mm (17.3 mm)");
  EXPECT_SAYS(refused("cube.obj", "--unit mm --max-edge-mm 0.28 --time-limit 0.1"),
              "did not finish in time");
  EXPECT_SAYS(refused("cube.obj", "--unit mm --max-edge-mm 0.28 --memory-limit 10"),
              "ran out of memory");
  EXPECT_SAYS(refused("cube.obj", "--unit mm --max-edge-mm 0.01"), "million elements");
}

TEST(TetrahedralizeJob, WrongUseIsExitTwo) {
  const Surfaces surfaces;
  EXPECT_EQ(surfaces.Fill("cube.obj", "").exit_code, 2) << "the unit is not guessed";
  EXPECT_EQ(surfaces.Fill("cube.obj", "--unit mile").exit_code, 2);
  EXPECT_EQ(surfaces.Fill("cube.obj", "--unit mm --order 3").exit_code, 2);
  EXPECT_EQ(surfaces.Fill("cube.obj", "--unit mm --max-edge-mm -1").exit_code, 2);
  EXPECT_EQ(surfaces.Fill("cube.obj", "--unit mm --max-edge-mm nan").exit_code, 2);
}

TEST(TetrahedralizeJob, OutputThatCannotBeIsRefusedBeforeTheWork) {
  const Surfaces surfaces;
  const std::string cube = "tetrahedralize " + surfaces.Path("cube.obj") + " --unit mm -o ";
  EXPECT_SAYS(RunProgram(cube + surfaces.Path("out.vtk")).err, "name it .vtu");
  EXPECT_SAYS(RunProgram(cube + surfaces.Path("none/out.vtu")).err, "does not exist");
  EXPECT_SAYS(RunProgram(cube + "- --report -").err, "cannot both");
}

TEST(TetrahedralizeJob, HelpNamesTheFlagsAndHidesTheWorker) {
  const auto help = RunProgram("tetrahedralize --help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* flag : {"--unit", "--order", "--max-edge-mm", "--report", "--time-limit",
                           "--budget", "--elements", "--fine-at", "--fine-edge-mm", "--held-at"})
    EXPECT_SAYS(help.out, flag);
  const std::string all = RunProgram("--help").out;
  EXPECT_SAYS(all, "tetrahedralize");
  EXPECT_EQ(all.find("tetgen-worker"), std::string::npos);
}

}  // namespace
}  // namespace arthro
