// Rules for includes (CONTRIBUTING.md). Linking cannot catch a header that is merely included, so
// every #include of every source is read and held against the table below.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/build_paths.h"

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// Our folders that a folder may include beside itself.
const std::map<std::string, Names> kMayInclude = {
    {"simulation/core", {}},
    {"simulation/scene", {"simulation/core"}},
    {"simulation/scope", {"simulation/core", "simulation/scene"}},
    {"simulation/device", {"simulation/core"}},
    {"simulation/haptics", {"simulation/core", "simulation/scene", "simulation/scope"}},
    {"simulation/tissue", {"simulation/core", "simulation/scene", "simulation/scope"}},
    {"simulation/practice",
     {"simulation/core", "simulation/scene", "simulation/scope", "simulation/device",
      "simulation/haptics", "simulation/tissue"}},
    {"simulation/training",
     {"simulation/core", "simulation/scene", "simulation/scope", "simulation/device",
      "simulation/haptics", "simulation/tissue", "simulation/practice"}},
};
// simulation/scope is pure maths; authoring may use it. Authoring folders may use one another.
const Names kAuthoringMayInclude = {"simulation/core", "simulation/scene", "simulation/scope",
                                    "authoring"};

// The same inside app. bench, cli and what lies in app itself may include all of app.
const std::map<std::string, Names> kAppMayInclude = {
    {"app/about", {}},
    {"app/plot", {}},
    {"app/records", {}},
    {"app/report", {"app/plot", "app/records", "app/view"}},
    {"app/recording", {}},
    {"app/view", {}},
    {"app/platform", {"app/recording"}},
    {"app/help", {"app/platform"}},
    {"app/state", {"app/platform"}},
    {"app/panels", {"app/platform", "app/state"}},
    {"app/steps",
     {"app/panels", "app/platform", "app/plot", "app/records", "app/recording", "app/report",
      "app/state", "app/view"}},
    {"app/files", {"app/platform", "app/state", "app/steps"}},
    {"app/editor",
     {"app/about", "app/files", "app/help", "app/panels", "app/platform", "app/recording",
      "app/state", "app/steps", "app/view"}},
};

// Third-party headers, by how their path begins, that a whole side must not see. Files named
// *_io.cpp in simulation/scene read and write formats and may use OpenCV's and VTK's IO.
const std::vector<std::string> kNotInSimulation = {
    "vtk",  "opencv2", "OpenMesh", "tetgen", "imgui", "backends/imgui",
    "GLFW", "GL/",     "dlib",     "CLI"};
const std::vector<std::string> kNotInAuthoring = {"vtk",  "imgui", "backends/imgui",
                                                  "GLFW", "GL/",   "CLI"};

// References for the renderer share nothing with it: headers of ours that these files may include,
// beside one another.
const std::string kReferences[] = {"tests/support/view/reference_tracer.",
                                   "tests/support/view/grid_picture."};
const Names kReferencesMayInclude = {
    "simulation/scene/image.h", "simulation/scene/lens.h", "simulation/scene/scene.h",
    "simulation/scene/mesh/surface_mesh.h", "simulation/scope/arthroscope.h"};
const std::vector<std::string> kNotInReferences = {"vtk", "GL/", "GLFW", "EGL/", "opencv2"};

struct Include {
  std::string file, name;
};

std::vector<Include> IncludesOf(const fs::path& root, const std::string& top) {
  std::vector<Include> includes;
  const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cpp" && extension != ".inc") continue;
    std::ifstream stream(entry.path());
    std::string line;
    std::smatch match;
    while (std::getline(stream, line))
      if (std::regex_search(line, match, pattern))
        includes.push_back({fs::relative(entry.path(), root).string(), match[1]});
  }
  return includes;
}

// "simulation/scene" of "simulation/scene/scene.h"; "app" and "authoring" stand for all below them.
std::string RoomOf(const std::string& path) {
  if (!path.starts_with("simulation/")) return path.substr(0, path.find('/'));
  return path.substr(0, path.find('/', std::string("simulation/").size()));
}

bool IsOurs(const std::string& name) {
  return name.starts_with("app/") || name.starts_with("authoring/") ||
         name.starts_with("simulation/") || name.starts_with("tests/");
}

bool BeginsWithOneOf(const std::string& name, const auto& beginnings) {
  return std::any_of(std::begin(beginnings), std::end(beginnings),
                     [&](const std::string& beginning) { return name.starts_with(beginning); });
}

std::vector<std::string> FaultsOf(const std::vector<Include>& includes) {
  std::vector<std::string> faults;
  for (const auto& [file, name] : includes) {
    const std::string room = RoomOf(file);
    const std::string fault = file + " includes " + name;
    if (BeginsWithOneOf(file, kReferences) &&
        (IsOurs(name) ? !BeginsWithOneOf(name, kReferences) && !kReferencesMayInclude.contains(name)
                      : BeginsWithOneOf(name, kNotInReferences))) {
      faults.push_back(fault);
      continue;
    }
    if (IsOurs(name)) {
      const std::string other = RoomOf(name);
      // The benchmarks are a program of their own, which alone uses fixtures of the tests.
      const bool is_bench = file.starts_with("app/bench/");
      if (room == "app" ? (other == "tests" && !(is_bench && name.starts_with("tests/support/"))) ||
                              (name.starts_with("app/bench/") && !is_bench)
          : room == "tests" ? false
          : room == other   ? false
          : room == "authoring"
              ? !kAuthoringMayInclude.contains(other)
              : !kMayInclude.contains(room) || !kMayInclude.at(room).contains(other))
        faults.push_back(fault);
      continue;
    }
    // One file knows hidapi.
    if (name.starts_with("hidapi") && file != "simulation/device/hid/hidapi_link.cpp")
      faults.push_back(fault);
    // One file knows SOCI.
    if (name.starts_with("soci/") && file != "app/records/store/database.cpp")
      faults.push_back(fault);
    // And one OpenHaptics.
    if (name.starts_with("HD/") && file != "simulation/device/openhaptics/openhaptics_devices.cpp")
      faults.push_back(fault);
    const bool is_scene_io = room == "simulation/scene" && file.ends_with("_io.cpp");
    if (is_scene_io || room == "app" || room == "tests") continue;
    if (BeginsWithOneOf(name, room == "authoring" ? kNotInAuthoring : kNotInSimulation))
      faults.push_back(fault);
  }
  return faults;
}

// "app/steps" of "app/steps/depth/depth_step.h"; "app" of a file that lies in app itself.
std::string AppRoomOf(const std::string& path) {
  const auto slash = path.find('/', std::string("app/").size());
  return slash == std::string::npos ? "app" : path.substr(0, slash);
}

std::vector<std::string> AppFaultsOf(const std::vector<Include>& includes) {
  std::vector<std::string> faults;
  for (const auto& [file, name] : includes) {
    if (!file.starts_with("app/") || !name.starts_with("app/")) continue;
    const std::string room = AppRoomOf(file), other = AppRoomOf(name);
    if (room == other || room == "app" || room == "app/bench" || room == "app/cli") continue;
    if (!kAppMayInclude.contains(room) || !kAppMayInclude.at(room).contains(other))
      faults.push_back(file + " includes " + name);
  }
  return faults;
}

// Folders that reach each other through their files' includes, one sentence per circle. A folder
// and one inside it are two folders.
std::vector<std::string> CirclesOf(const std::vector<Include>& includes) {
  std::map<std::string, std::map<std::string, std::string>> edges;  // with an include as witness
  for (const auto& [file, name] : includes) {
    const std::string from = fs::path(file).parent_path(), to = fs::path(name).parent_path();
    if (IsOurs(name) && from != to) edges[from].emplace(to, file + " includes " + name);
  }
  std::vector<std::string> circles;
  Names done;
  std::vector<std::string> path;
  const std::function<void(const std::string&)> visit = [&](const std::string& folder) {
    if (const auto begin = std::find(path.begin(), path.end(), folder); begin != path.end()) {
      std::string circle = "these folders include each other:";
      for (auto at = begin; at != path.end(); ++at)
        circle += "\n  " + edges.at(*at).at(at + 1 == path.end() ? folder : *(at + 1));
      circles.push_back(circle);
      return;
    }
    if (done.contains(folder)) return;
    path.push_back(folder);
    if (edges.contains(folder))
      for (const auto& [next, witness] : edges.at(folder)) visit(next);
    path.pop_back();
    done.insert(folder);
  };
  for (const auto& [folder, ignored] : edges) visit(folder);
  return circles;
}

TEST(Layering, EveryIncludeInsideAppFollowsItsTable) {
  const std::vector<Include> includes = IncludesOf(ARTHRO_SOURCE_DIR, "app");
  ASSERT_GT(includes.size(), 20u) << "the scan found too little to mean anything";
  for (const auto& fault : AppFaultsOf(includes)) ADD_FAILURE() << fault;
}

TEST(Layering, NoTwoFoldersIncludeEachOther) {
  std::vector<Include> includes;
  for (const char* top : {"app", "authoring", "simulation", "tests"})
    for (auto& include : IncludesOf(ARTHRO_SOURCE_DIR, top)) includes.push_back(include);
  for (const auto& circle : CirclesOf(includes)) ADD_FAILURE() << circle;
}

TEST(Layering, ScanCatchesCirclesOfFolders) {
  const std::vector<Include> chain = {{"app/view/a.h", "app/view/exposure/b.h"},
                                      {"app/view/exposure/b.h", "simulation/scene/c.h"}};
  EXPECT_TRUE(CirclesOf(chain).empty());
  for (const char* back : {"app/view/a.h", "app/view/exposure/other.h"}) {
    std::vector<Include> circle = chain;
    circle.push_back({"simulation/scene/kernel.inc", back});
    EXPECT_EQ(CirclesOf(circle).size(), 1u) << back;
  }
  EXPECT_EQ(AppFaultsOf({{"app/state/a.h", "app/steps/depth/b.h"},
                         {"app/steps/depth/b.cpp", "app/editor/panels/c.h"},
                         {"app/new_folder/a.cpp", "app/state/b.h"}})
                .size(),
            3u);
  EXPECT_TRUE(AppFaultsOf({{"app/editor/a.cpp", "app/steps/depth/b.h"},
                           {"app/cli/a.cpp", "app/editor/b.h"}})
                  .empty());
}

TEST(Layering, EveryIncludeFollowsTheTable) {
  const fs::path root = ARTHRO_SOURCE_DIR;
  std::vector<Include> includes;
  for (const char* top : {"app", "authoring", "simulation", "tests/support/view"})
    for (auto& include : IncludesOf(root, top)) includes.push_back(include);
  ASSERT_GT(includes.size(), 20u) << "the scan found too little to mean anything";
  for (const auto& fault : FaultsOf(includes)) ADD_FAILURE() << fault;
}

// ParseJson limits the depth, so that no file overflows the stack; no other reader is allowed.
TEST(Layering, JsonIsParsedInOnePlaceOnly) {
  const fs::path root = ARTHRO_SOURCE_DIR;
  int found = 0;
  for (const char* top : {"app", "authoring", "simulation"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream stream(entry.path());
      const std::string text((std::istreambuf_iterator<char>(stream)), {});
      const bool parses =
          text.find("json::parse(") != text.npos || text.find("json::sax_parse(") != text.npos;
      const std::string file = fs::relative(entry.path(), root).string();
      if (file == "simulation/core/json_text.cpp")
        found += parses;
      else
        EXPECT_FALSE(parses) << file << " parses JSON by itself; use ParseJson";
    }
  EXPECT_EQ(found, 1);
}

TEST(Layering, ScanCatchesForbiddenIncludes) {
  const std::vector<Include> forbidden = {
      {"simulation/scope/a.h", "simulation/haptics/b.h"},
      {"simulation/scene/scene.h", "vtkPolyData.h"},
      {"authoring/depth/a.cpp", "simulation/haptics/b.h"},
      {"authoring/depth/a.cpp", "imgui.h"},
      {"simulation/practice/a.cpp", "app/cli/jobs.h"},
      {"simulation/device/a.cpp", "simulation/scene/scene.h"},
      {"simulation/device/hid/a.cpp", "hidapi.h"},
      {"simulation/device/live/a.cpp", "HD/hd.h"},
      {"authoring/depth/a.cpp", "hidapi/hidapi.h"},
      {"app/view/a.cpp", "hidapi.h"},
      {"app/records/attempts/a.cpp", "soci/soci.h"},
      {"app/view/a.cpp", "tests/support/shapes.h"},
      {"app/cli/a.cpp", "app/bench/jobs/bench_jobs.h"},
      {"app/bench/a.cpp", "tests/app/view/lit_scene.h"},
      {"simulation/haptics/a.cpp", "tests/support/haptics/paper_kernel.h"},
      {"tests/support/view/reference_tracer.cpp", "app/view/arthroscopic_view.h"},
      {"tests/support/view/reference_tracer.cpp", "simulation/scope/window_lens.h"},
      {"tests/support/view/grid_picture.h", "vtk_glew.h"},
      {"simulation/haptics/a.cpp", "opencv2/core.hpp"}};
  EXPECT_EQ(FaultsOf(forbidden).size(), forbidden.size());
  EXPECT_TRUE(
      FaultsOf({{"simulation/scene/image_io.cpp", "opencv2/core.hpp"},
                {"authoring/depth/a.cpp", "opencv2/core.hpp"},
                {"tests/support/view/grid_picture.cpp", "tests/support/view/reference_tracer.h"},
                {"app/bench/view/view_bench.cpp", "app/view/arthroscopic_view.h"},
                {"app/bench/view/view_bench.cpp", "tests/support/view/view_cases.h"},
                {"app/view/a.cpp", "vtkActor.h"}})
          .empty());
}

}  // namespace
