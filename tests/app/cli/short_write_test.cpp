// A write that falls short ends the job with exit 1 and one sentence, never with a cut file.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/app/cli/job_inputs.h"
#include "tests/authoring/panorama/tiny_clip.h"
#include "tests/support/build_paths.h"
#include "tests/support/round_lens.h"
#include "tests/support/run_program.h"
#include "tests/support/shapes.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

class ShortWrite : public JobInputs {
 protected:
  void SetUp() override {
    JobInputs::SetUp();
    WriteColourImage(At("g.png"), KneePicture(400, 300));
    TinyClip().WriteAll(At("F"), TinyClip::Arc(3));
    Lens lens = test::RoundLens(96, 64, 60, 47.5, 31.5, 30);
    lens.field_of_view = *FieldOfViewOf(lens);
    WriteLens(At("lens.json"), lens);
    fs::create_directory(At("R"));
    for (const char* name : {"1.png", "2.png"})
      WriteColourImage(At("R") + "/" + name, KneePicture(96, 64));
    std::string trace = "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n";
    for (int i = 0; i < 100; ++i)
      trace += std::to_string(0.01 * i) + ",scope,0,0,-0.18,1,0,0,0,0\n";
    WriteAtomically(At("t.csv"), trace);
    WriteSurface(At("s.obj"), Box({0, 0, 0}, {10, 10, 10}));
    fs::create_directory(At("out"));
  }

  // `line` with PROGRAM for the program, by a shell.
  ProgramResult Shell(const std::string& line) const {
    const std::string program =
        std::regex_replace(line, std::regex("PROGRAM"), std::string(ARTHRO_PROGRAM));
    // Reads the sentence through a pipe, since the limit holds for files of sentences as well.
    const std::string whole = Whole("{ ( " + program +
                                    " ) >/dev/null; echo $? >@code; } 2>&1 </dev/null | cat >@err;"
                                    " exit $(cat @code)");
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), "",
            ReadWholeFile(At("err"))};
  }
  static void ExpectOneSentence(const ProgramResult& run, const std::string& line) {
    EXPECT_EQ(run.exit_code, 1) << line << "\n" << run.err;
    std::string sentences;
    std::istringstream lines(run.err);
    for (std::string text; std::getline(lines, text);)
      if (!text.starts_with("warning: ") && !text.starts_with("note: ")) sentences += text + "\n";
    EXPECT_TRUE(sentences.starts_with("arthroscene: ")) << line << "\n" << run.err;
    EXPECT_EQ(std::count(sentences.begin(), sentences.end(), '\n'), 1) << line << "\n" << run.err;
  }
};

// A block of `ulimit -f` is 512 bytes in this shell; each result is larger. The signal of a limit
// that is passed is left as it was. A job that hangs is killed, so that the message names it.
TEST_F(ShortWrite, AFileSizeLimitEndsEachJobWithOneSentenceAndNoFile) {
  for (const std::string job : {
           "4 PROGRAM centres @S --roll-steps 500 -o @out/c.csv",
           "4 PROGRAM centres @S -o @out/c.csv --picture @out/c.png",
           "4 PROGRAM depth @g.png -o @out/d.tiff",
           "1 PROGRAM lens @g.png --spacing-mm 1 -o @out/l.json --report @out/r.json",
           "4 PROGRAM panorama @F -o @out/p.png --overwrite",
           "4 PROGRAM phantom --seed 1 --size S --footage-frames 0 -o @out/knee",
           "0 PROGRAM pivot @po.csv -o @out/pivot.json",
           "4 PROGRAM rectify @R --lens @lens.json -o @out/frames",
           "4 PROGRAM replay @S @t.csv -o @out/f.csv",
           "2 PROGRAM replay @S @t.csv -o @out/f.csv --pictures @out/frames --size 64",
           "0 PROGRAM solve @case.json -o @out/r.json",
           "1 PROGRAM solve @case.json -o - --vtu @out/r.vtu >/dev/null",
           "1 PROGRAM tetrahedralize @s.obj --unit mm -o @out/t.vtu",
           "4 PROGRAM view @S --size 64 -o @out/v.png",
           "1 PROGRAM devices --json @out/devices.json",
       }) {
    ExpectOneSentence(Shell("ulimit -f " + std::regex_replace(job, std::regex(" PROGRAM"),
                                                              "; timeout -s KILL 300 PROGRAM")),
                      job);
    for (const auto& entry : fs::recursive_directory_iterator(At("out")))
      ADD_FAILURE() << job << " left " << entry.path();
  }
}

TEST_F(ShortWrite, AFileSizeLimitLeavesTheEarlierResult) {
  ASSERT_EQ(RunProgram(Whole("depth @g.png -o @out/d.tiff")).exit_code, 0);
  const std::string before = ReadWholeFile(At("out/d.tiff"));
  ExpectOneSentence(Shell("ulimit -f 4; PROGRAM depth @g.png --gamma 1.5 -o @out/d.tiff"), "depth");
  EXPECT_TRUE(ReadWholeFile(At("out/d.tiff")) == before);
}

// Also of what is printed for a person.
TEST_F(ShortWrite, AFullStandardOutputIsToldByExitOne) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "SKIPPED: no /dev/full here";
  for (const std::string job : {
           "centres @S -o -",
           "depth @g.png -o -",
           "devices --json -",
           "panorama @F -o -",
           "pivot @po.csv -o -",
           "replay @S @t.csv -o -",
           "solve @case.json -o -",
           "tetrahedralize @s.obj --unit mm -o -",
           "view @S --size 64 -o -",
           "depth @g.png -o @out/d.tiff",
           "devices",
           "check @S",
           "replay --help",
           "--help-all",
           "--version",
       })
    ExpectOneSentence(Shell("PROGRAM " + job + " >/dev/full"), job);
}

TEST_F(ShortWrite, AClosedPipeIsToldByExitOne) {
  for (const std::string job : {"centres @S --roll-steps 10000 -o -", "depth @g.png -o -"}) {
    const ProgramResult run =
        Shell("{ PROGRAM " + job + "; echo $? >@closed; } | true; read code <@closed; exit $code");
    ExpectOneSentence(run, job);
  }
}

// A closed terminal sends this signal.
TEST_F(ShortWrite, AHangUpEndsAJobWithNothingLeft) {
  std::signal(SIGHUP, SIG_DFL);  // a test under nohup has it ignored, and so would the program
  for (const std::string signal : {"HUP", "INT", "TERM"}) {
    const ProgramResult run = Shell(
        "PROGRAM demo -o @out/demo >/dev/null & job=$!; i=0;"
        "until ls -A @out | grep -q partial || [ $i -ge 600 ]; do sleep 0.1; i=$((i+1)); done;"
        "kill -" +
        signal + " $job; wait $job");
    ExpectOneSentence(run, signal);
    EXPECT_NE(run.err.find("stopped; nothing was written"), std::string::npos) << run.err;
    for (const auto& entry : fs::recursive_directory_iterator(At("out")))
      ADD_FAILURE() << signal << " left " << entry.path();
  }
}

TEST_F(ShortWrite, AReplayThatIsStoppedLeavesNoPicture) {
  std::string trace = "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n";
  for (int i = 0; i < 1000; ++i) trace += std::to_string(i) + ",scope,0,0,-0.18,1,0,0,0,0\n";
  WriteAtomically(At("long.csv"), trace);
  const ProgramResult run = Shell(
      "PROGRAM replay @S @long.csv -o @out/f.csv --pictures @out/frames --size 64 & job=$!; i=0;"
      "until ls -A @out/.frames*/frame_00001.png || [ $i -ge 600 ]; do sleep 0.1; i=$((i+1)); done"
      " >/dev/null 2>&1; kill -TERM $job; wait $job");
  ExpectOneSentence(run, "replay");
  EXPECT_NE(run.err.find("stopped; nothing was written"), std::string::npos) << run.err;
  for (const auto& entry : fs::recursive_directory_iterator(At("out")))
    ADD_FAILURE() << "left " << entry.path();
}

}  // namespace
}  // namespace arthro::test
