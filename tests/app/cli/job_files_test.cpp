// No job destroys what it reads, and none replaces what is not its own earlier result unless it is
// told to.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/device/log/log_format.h"
#include "simulation/scene/files/archive_io.h"
#include "tests/app/cli/job_inputs.h"
#include "tests/support/run_program.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;
using Tree = std::map<std::string, std::string>;  // bytes of each file

const char* const kForeign = "a letter to somebody";

// Everything that the jobs read, in one folder.
class JobFiles : public JobInputs {
 protected:
  void SetUp() override {
    JobInputs::SetUp();
    PackScene(At("S"), At("S.arthro"));
    fs::create_directory(At("F"));
    for (const char* name : {"0001.png", "0002.png", "0003.png"})
      WriteColourImage(At("F") + "/" + name, KneePicture(64, 48));
    WriteColourImage(At("g.png"), KneePicture(64, 48));
    WriteDepthMap(At("y.tiff"), DepthMap(64, 48, 0.01f));
    WriteAtomically(At("o.json"), "{}");
    WriteAtomically(At("pairs.json"), R"({"schema": "arthroscene.pairs/1", "pairs": []})");
    WriteAtomically(At("lens.json"), R"({"schema": "arthroscene.lens/1"})");
    WriteAtomically(At("t.csv"),
                    "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                    "0,scope,0,0,-0.18,1,0,0,0,0\n0.01,scope,0,0,-0.18,1,0,0,0,0\n");
    WriteSurface(At("s.stl"), Octahedron(0.006));
    WriteAtomically(At("rig.json"), R"({"schema": "arthroscene.rig/1", "title": "t"})");
  }

  Tree Files() const {
    Tree tree;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      tree[fs::relative(entry.path(), folder_.path()).string()] =
          entry.is_regular_file() ? ReadWholeFile(entry.path()) : "";
    return tree;
  }

  // Exit 1 and one sentence that holds `name` and `words`; no file was changed, made or removed.
  void ExpectRefused(const std::string& arguments, const std::string& name,
                     const std::string& words) const {
    const Tree before = Files();
    const ProgramResult run = RunProgram(Whole(arguments), "DISPLAY=");
    EXPECT_EQ(run.exit_code, 1) << arguments << "\n" << run.err;
    EXPECT_EQ(run.err.rfind("arthroscene: ", 0), 0u) << arguments << "\n" << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << arguments << "\n" << run.err;
    EXPECT_NE(run.err.find(name), std::string::npos) << arguments << "\n" << run.err;
    EXPECT_NE(run.err.find(words), std::string::npos) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_TRUE(Files() == before) << arguments << " changed a file";
  }
};

TEST_F(JobFiles, AnOutputThatIsAnInputIsRefusedAlsoWithOverwrite) {
  fs::create_symlink("S/scene.json", At("link.csv"));
  fs::create_hard_link(At("S/panorama.png"), At("hard.csv"));
  const std::pair<std::string, std::string> kCases[] = {
      {"centres @S -o @S/scene.json", "scene.json"},
      {"align @S --tissue octahedron --pairs @pairs.json -o @S", "scene.json"},
      {"align @S --tissue octahedron --pairs @pairs.json -o @A --report @pairs.json", "pairs.json"},
      {"centres @S -o @S/panorama.png", "panorama.png"},
      {"centres @S -o @S/depth.tiff", "depth.tiff"},
      {"centres @S/scene.json -o @S/octahedron.ply", "octahedron.ply"},
      {"centres @S.arthro -o @S.arthro", "S.arthro"},
      {"centres @S -o @S/../S/./scene.json", "scene.json"},
      {"centres @S -o @link.csv", "link.csv"},
      {"centres @S -o @hard.csv", "hard.csv"},
      {"centres @S -o @c.csv --picture @S/panorama.png", "panorama.png"},
      {"centres @S -o @c.csv --picture @S/depth.tiff", "depth.tiff"},
      {"view @S -o @S/panorama.png", "panorama.png"},
      {"view @S -o @S/depth.tiff", "depth.tiff"},
      {"view @S.arthro -o @S.arthro", "S.arthro"},
      {"panorama @F -o @F/0003.png", "0003.png"},
      {"panorama @F -o @p.png --report @F/0003.png", "0003.png"},
      {"panorama @F -o @p.png --thumbnail @F/0003.png", "0003.png"},
      {"panorama @F/%04d.png -o @F/0003.png", "0003.png"},
      {"panorama @F -o @p.png --lens @lens.json --report @lens.json", "lens.json"},
      {"panorama @F -o @p.png --options @o.json --report @o.json", "o.json"},
      {"depth @y.tiff -o @y.tiff", "y.tiff"},
      {"relief @F --lens @lens.json -o @d.tiff --poses @lens.json", "lens.json"},
      {"depth @g.png --options @o.json -o @o.json", "o.json"},
      {"lens @g.png --spacing-mm 1 -o @g.png", "g.png"},
      {"lens @g.png --spacing-mm 1 -o @l.json --report @g.png", "g.png"},
      {"pivot @po.csv -o @po.csv", "po.csv"},
      {"model loose-body --scene @S -o @S/octahedron.ply", "octahedron.ply"},
      {"tetrahedralize @s.stl --unit m -o @o.vtu --report @s.stl", "s.stl"},
      {"solve @case.json -o @case.json", "case.json"},
      {"solve @case.json -o @r.json --vtu @m.vtu", "m.vtu"},
      {"replay @S @t.csv -o @t.csv", "t.csv"},
      {"replay @S @t.csv -o @f.csv --report @S/scene.json", "scene.json"},
      {"replay @S @t.csv -o @f.csv --video @S/panorama.png", "panorama.png"},
      {"practise @S --hands plant --log @S/scene.json", "scene.json"},
      {"practise @S --hands @t.csv --log @t.csv", "t.csv"},
      {"practise @S --rig @rig.json --log @rig.json", "rig.json"},
      {"practise @S --record @S/depth.tiff", "depth.tiff"},
      {"edit @S --hands plant --log @S/panorama.png", "panorama.png"},
  };
  for (const auto& [arguments, name] : kCases)
    ExpectRefused(arguments + " --overwrite", name, "is read by the job");
  ExpectRefused(kCases[0].first, kCases[0].second, "is read by the job");
}

TEST_F(JobFiles, APanoramaIsNotWrittenAmongItsFrames) {
  ExpectRefused("panorama @F -o @F/new.png --overwrite", "new.png", "taken for a frame");
}

TEST_F(JobFiles, APieceOrPictureThatIsAnInputIsRefused) {
  fs::create_directory(At("N"));
  for (const char* name : {"p-1.png", "p-2.png", "p-3.png"})
    fs::copy_file(At("g.png"), At("N") + "/" + name);
  ExpectRefused("panorama @N/p-%d.png -o @N/p.png --overwrite", "p-", "is read by the job");
  std::string text = ReadWholeFile(At("S/scene.json"));
  fs::rename(At("S/panorama.png"), At("S/frame_00000.png"));
  WriteAtomically(At("S/scene.json"),
                  std::regex_replace(text, std::regex("panorama[.]png"), "frame_00000.png"));
  ExpectRefused("replay @S @t.csv -o @f.csv --pictures @S --overwrite", "frame_00000.png",
                "is read by the job");
}

// Flags that help shows as OUTPUT, with a command for each, in which a foreign file stands where
// the job would write. A job that is missing here fails the next test.
const std::map<std::string, std::string> kOutputs = {
    {"adjust --output", "adjust @S.arthro --mirror -o @S"},
    {"align --output", "align @S.arthro --tissue octahedron --pairs @pairs.json -o @S"},
    {"align --report", "align @S --tissue octahedron --pairs @pairs.json -o @new.demo --report @X"},
    {"bench all --output", "bench all -o @X.demo"},
    {"bench haptics --json", "bench haptics --json @X"},
    {"bench haptics --plot", "bench haptics --plot @X"},
    {"bench micro --json", "bench micro --json @X"},
    {"bench micro --plot", "bench micro --plot @X"},
    {"bench panorama --json", "bench panorama --json @X"},
    {"bench panorama --plot", "bench panorama --plot @X"},
    {"bench relief --json", "bench relief --json @X"},
    {"bench relief --plot", "bench relief --plot @X"},
    {"bench tissue --json", "bench tissue --json @X"},
    {"bench tissue --plot", "bench tissue --plot @X"},
    {"bench view --json", "bench view --json @X"},
    {"bench view --plot", "bench view --plot @X"},
    {"centres --output", "centres @S -o @X"},
    {"centres --picture", "centres @S -o @new.csv --picture @X"},
    {"check --report", "check @S --report @X"},
    {"demo --output", "demo -o @X.demo"},
    {"depth --output", "depth @g.png -o @X"},
    {"depth --noise", "depth @g.png -o @d.tiff --noise @X"},
    {"devices --json", "devices --json @X"},
    {"devices --log", "devices --self-test --log @X"},
    {"devices --record", "devices --first-hour --record @X"},
    {"edit --log", "edit @S --hands plant --log @X"},
    {"lens --output", "lens @g.png --spacing-mm 1 -o @X"},
    {"lens --report", "lens @g.png --spacing-mm 1 -o @new.json --report @X"},
    {"model --output", "model loose-body -o @X.ply"},
    {"model --report", "model loose-body -o @new.ply --report @X"},
    {"model --save-scene", "model loose-body --scene @S --save-scene @Z"},
    {"panorama --output", "panorama @F -o @X"},
    {"panorama --report", "panorama @F -o @new.png --report @X"},
    {"panorama --scene", "panorama @F -o @new.png --scene @S"},
    {"panorama --thumbnail", "panorama @F -o @new.png --thumbnail @X"},
    {"phantom --output", "phantom --seed 1 --size S -o @X.demo"},
    {"pivot --output", "pivot @po.csv -o @X"},
    {"practise --log", "practise @S --hands plant --log @X"},
    {"practise --record", "practise @S --record @X.mp4"},
    {"assess --csv", "assess @S @t.csv --csv @X"},
    {"assess --json", "assess @S @t.csv --json @X"},
    {"assess --output", "assess @S @t.csv -o @X"},
    {"assess --report", "assess @S @t.csv -o @new.csv --report @X"},
    {"reach --output", "reach @S -o @X"},
    {"reach --picture", "reach @S -o @new.csv --picture @X"},
    {"records backup --output", "records backup --records @r.sqlite -o @X"},
    {"records export --forms", "records export --records @r.sqlite --forms @X"},
    {"records export --json", "records export --records @r.sqlite --json @X"},
    {"records export --output", "records export --records @r.sqlite -o @X"},
    {"records export --xapi", "records export --records @r.sqlite --xapi @X"},
    {"records list --json", "records list --records @r.sqlite --json @X"},
    {"records show --csv", "records show none --records @r.sqlite --csv @X"},
    {"records show --json", "records show none --records @r.sqlite --json @X"},
    {"records show --report", "records show none --records @r.sqlite --report @X"},
    {"rectify --output", "rectify @F --lens @lens.json -o @X.demo"},
    {"relief --confidence", "relief @F --lens @lens.json -o @new.tiff --confidence @X"},
    {"relief --origin", "relief @F --lens @lens.json -o @new.tiff --origin @X"},
    {"relief --output", "relief @F --lens @lens.json -o @X"},
    {"relief --panorama", "relief @F --lens @lens.json -o @new.tiff --panorama @X"},
    {"relief --poses", "relief @F --lens @lens.json -o @new.tiff --poses @X"},
    {"relief --report", "relief @F --lens @lens.json -o @new.tiff --report @X"},
    {"relief --scene", "relief @F --lens @lens.json -o @new.tiff --scene @S"},
    {"relief --sigma", "relief @F --lens @lens.json -o @new.tiff --sigma @X"},
    {"replay --output", "replay @S @t.csv -o @X"},
    {"replay --pictures", "replay @S @t.csv -o @new.csv --pictures @X.demo"},
    {"replay --report", "replay @S @t.csv -o @new.csv --report @X"},
    {"replay --video", "replay @S @t.csv -o @new.csv --video @X.mp4"},
    {"robot --output", "robot @S --exercise hold -o @X"},
    {"solve --output", "solve @case.json -o @X"},
    {"solve --vtu", "solve @case.json -o @new.json --vtu @X.vtu"},
    {"tetrahedralize --output", "tetrahedralize @s.stl --unit m -o @X.vtu"},
    {"tetrahedralize --report", "tetrahedralize @s.stl --unit m -o @new.vtu --report @X"},
    {"view --output", "view @S -o @X"},
};

// Flags of text that name no file that is written.
const std::set<std::string> kNoOutput = {
    "check SCENE",      "bench micro --only", "bench tissue --only",
    "--options",        "--layout",           "--model",
    "--openhaptics",    "--disturb",          "reach --suggest",
    "devices --serial", "help PAGE"};

// "job" and "job sub" of the program's own help.
std::vector<std::string> AllJobs() {
  std::vector<std::string> jobs;
  const auto add = [&](const std::string& above) {
    std::istringstream help(RunProgram(above + " --help").out);
    std::string line;
    for (bool is_job = false; std::getline(help, line);) {
      std::smatch match;
      if (line == "Subcommands:")
        is_job = true;
      else if (is_job && std::regex_search(line, match, std::regex("^  ([a-z-]+)")))
        jobs.push_back(above.empty() ? match[1].str() : above + " " + match[1].str());
    }
  };
  add("");
  add("bench");
  add("records");
  return jobs;
}

TEST(EveryJob, DeclaresItsOutputsToTheOneCheck) {
  std::set<std::string> found;
  const std::vector<std::string> jobs = AllJobs();
  ASSERT_GT(jobs.size(), 15u);
  for (const std::string& job : jobs) {
    const std::string help = RunProgram(job + " --help").out;
    bool writes = false;
    std::istringstream lines(help);
    const std::regex option(
        "^  (?:-[a-z],)?(--[a-z-]+|[A-Z_]+) (TEXT|OUTPUT)(?=$|[ =]| \\.\\.\\.).*");
    for (std::string line; std::getline(lines, line);) {
      std::smatch match;
      if (!std::regex_match(line, match, option)) continue;
      const std::string flag = match[1], name = job + " " + flag;
      if (match[2] == "TEXT") {
        EXPECT_TRUE(kNoOutput.contains(flag) || kNoOutput.contains(name))
            << name << " may name a file: declare it as an input or output (app/cli/job_files.h)";
        continue;
      }
      writes = true;
      found.insert(name);
      EXPECT_TRUE(kOutputs.contains(name)) << name << " has no case in this test";
    }
    if (writes && job != "phantom") {
      EXPECT_NE(help.find("--overwrite"), std::string::npos) << job;
    }
  }
  for (const auto& [name, arguments] : kOutputs)
    EXPECT_TRUE(found.contains(name)) << name << " is not declared as an output";
}

TEST_F(JobFiles, AForeignFileWantsOverwriteInEveryJob) {
  for (const char* name : {"X", "X.mp4", "X.ply", "X.vtu"}) WriteAtomically(At(name), kForeign);
  fs::create_directory(At("X.demo"));
  fs::copy(At("S"), At("Z"), fs::copy_options::recursive);
  for (const char* name : {"report.json", "frame_00000.png", "000001.png"})
    WriteAtomically(At("X.demo") + "/" + name, kForeign);
  for (const auto& [name, arguments] : kOutputs)
    ExpectRefused(
        arguments,
        name.ends_with(" --save-scene") ? "Z/scene.json"
        : name.ends_with(" --scene") || name == "align --output" || name == "adjust --output"
            ? "S/scene.json"
            : "X",
        name == "phantom --output" ? "nothing is overwritten" : "--overwrite");
}

TEST_F(JobFiles, AFileOfAnotherJobIsForeign) {
  struct Case {
    std::string arguments, name;
  };
  WriteAtomically(At("replay.json"), R"({"schema": "arthroscene.replay/1"})");
  fs::copy_file(At("t.csv"), At("notes.csv"));
  for (const Case& c : {
           Case{"pivot @po.csv -o @replay.json", "replay.json"},
           Case{"pivot @po.csv -o @lens.json", "lens.json"},
           Case{"solve @case.json -o @o.json", "o.json"},
           Case{"centres @S -o @notes.csv", "notes.csv"},
           Case{"depth @y.tiff -o @g.png", "g.png"},
           Case{"panorama @F -o @m.vtu", "m.vtu"},
       })
    ExpectRefused(c.arguments, c.name, "--overwrite");
  // A photograph in TIFF is no depth map.
  WriteColourImage(At("photograph.tiff"), KneePicture(64, 48));
  ExpectRefused("depth @g.png -o @photograph.tiff", "photograph.tiff", "is not a depth map");
}

TEST_F(JobFiles, AnEarlierResultOfTheSameJobIsReplaced) {
  for (const std::string arguments :
       {"centres @S -o @c.csv --picture @c.png", "depth @g.png -o @d.tiff",
        "pivot @po.csv -o @pivot.json", "solve @case.json -o @r.json --vtu @r.vtu",
        "tetrahedralize @s.stl --unit m -o @s.vtu --report @s.json",
        "replay @S @t.csv -o @S/f.csv --report @S/r.json", "devices --json @devices.json"}) {
    const ProgramResult first = RunProgram(Whole(arguments));
    EXPECT_EQ(first.exit_code, 0) << arguments << "\n" << first.err;
    const ProgramResult second = RunProgram(Whole(arguments));
    EXPECT_EQ(second.exit_code, 0) << arguments << "\n" << second.err;
  }
}

TEST_F(JobFiles, OverwriteReplacesWhatIsForeign) {
  for (const std::string arguments : {"centres @S -o @X", "depth @g.png -o @X.tiff",
                                      "pivot @po.csv -o @X", "solve @case.json -o @X"}) {
    WriteAtomically(At("X"), kForeign);
    WriteAtomically(At("X.tiff"), kForeign);
    const ProgramResult run = RunProgram(Whole(arguments) + " --overwrite");
    EXPECT_EQ(run.exit_code, 0) << arguments << "\n" << run.err;
    EXPECT_NE(ReadWholeFile(At(arguments.ends_with("tiff") ? "X.tiff" : "X")), kForeign);
  }
}

// From mktemp, for example.
TEST_F(JobFiles, AnEmptyFileIsReplaced) {
  WriteAtomically(At("c.csv"), "");
  EXPECT_EQ(RunProgram(Whole("centres @S -o @c.csv")).exit_code, 0);
}

TEST_F(JobFiles, ARefusedPhantomCostsNoComputing) {
  const std::string long_name(300, 'a');
  ExpectRefused("phantom --seed 1 --size L -o ''", "name is empty", "-o");
  ExpectRefused("phantom --seed 1 --size L -o @" + long_name, "too long", "-o");
}

TEST_F(JobFiles, LeftoversOfADeadProcessBesideTheResultAreRemoved) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  const fs::path left = At(fmt::format(".c.{}.partial.csv", child));
  WriteAtomically(left, "half");
  fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::minutes(5));
  EXPECT_EQ(RunProgram(Whole("centres @S -o @c.csv")).exit_code, 0);
  EXPECT_FALSE(fs::exists(left));
}

}  // namespace
}  // namespace arthro::test
