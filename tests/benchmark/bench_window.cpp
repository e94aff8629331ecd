// The window: from the program's start to the first picture, and how long frames take while an
// author swings the scope, drags a depth slider and practises, and what a recording and the view
// from outside add to a practice's frame, taken in turns in one run. Drawn on an X server of its
// own, in software where there is no graphics card. Frame times are of the whole loop: input,
// panels, pictures, drawing, handing over. Beside the times stands what the same script shows
// twice: 0 differing bytes.
#include <cstdlib>
#include <fstream>
#include <regex>

#include "simulation/scene/image_io.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/build_paths.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace {

using arthro::test::BenchReport;
using arthro::test::Timing;

double NumberAfter(const std::string& text, const std::string& words) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(words + " ([0-9.]+)")) ? std::stod(match[1])
                                                                          : -1;
}

// Both hands move in turn with each of four ways to show a practice, `rounds` times over, in one
// run, so that whatever else the machine does falls on all of them alike.
std::string InTurns(const std::filesystem::path& folder, const std::string& frames, int rounds) {
  std::string script = "wait job\nwait frames 10\n";
  for (int round = 0; round < rounds; ++round) {
    const std::string key = round % 2 == 0 ? "left" : "right";
    const auto measure = [&](const std::string& name) {
      script += "mark \"" + name + "\"\nhold " + key + " " + frames + "\nmark \"\"\n";
    };
    const auto record = [&](const std::string& name, const std::string& file) {
      script += "key f2\nset \"File name\" \"" + file + "\"\nwait frames 5\n";
      measure(name);
      script += "key f2\nwait frames 40\n";
    };
    const std::string number = std::to_string(round);
    measure("practice alone");
    record("recorded as a film", (folder / ("film" + number + ".mp4")).string());
    std::filesystem::create_directory(folder / number);
    record("recorded as pictures", (folder / number / "frame-%04d.png").string());
    script += "key o\nwait frames 5\n";
    measure("with the view from outside");
    record("from outside and recorded", (folder / ("outside" + number + ".mp4")).string());
    script += "key o\nwait frames 5\n";
  }
  return script;
}

}  // namespace

int main(int argc, char** argv) {
  BenchReport report("window", argc, argv);
  if (std::system("command -v xvfb-run > /dev/null 2>&1") != 0) {
    std::puts("xvfb-run is not on this machine; nothing was measured");
    return 0;
  }
  arthro::test::TempFolder temp;
  const std::filesystem::path demo =
      std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources" / "demo";
  const auto scene = std::filesystem::exists(demo / "scene.json")
                         ? demo
                         : arthro::test::WriteSmallScene(temp / "knee");
  const std::string edit = "edit " + scene.string() + " --timing";

  // Start, warm: the first run fills the file cache.
  std::vector<double> starts;
  const int runs = report.quick() ? 1 : 12;
  for (int run = 0; run < runs; ++run) {
    const auto result = arthro::test::RunWindow(edit, "quit");
    const double ms = NumberAfter(result.err, "first picture after");
    if (result.exit_code != 0 || ms < 0) {
      std::fputs(result.err.c_str(), stderr);
      return 1;
    }
    if (run > 0 || report.quick()) starts.push_back(ms / 1e3);
  }
  std::sort(starts.begin(), starts.end());
  report.Row("process start to first picture, 1280x800", {starts[starts.size() / 2], starts.back()},
             "limit 2 s");

  const std::string again = report.quick() ? "10" : "120";
  const struct {
    const char* name;
    std::string script;
  } cases[] = {{"a frame: editor at rest, redrawn", "wait frames " + again},
               {"a frame: swinging the scope, 590 px", "click Picture\nhold right " + again},
               {"a frame: practice, both hands, 800 px", "key p\nwait job\nhold r " + again}};
  for (const auto& one : cases) {
    const auto shot = temp / "shot.png";
    std::vector<arthro::ColourImage> pictures;
    std::string log;
    for (int run = 0; run < (report.quick() ? 1 : 2); ++run) {
      const auto result =
          arthro::test::RunWindow(edit, one.script + "\nshot " + shot.string() + "\n");
      if (result.exit_code != 0) {
        std::fputs(result.err.c_str(), stderr);
        return 1;
      }
      pictures.push_back(arthro::ReadColourImage(shot));
      log = result.err;
    }
    std::size_t differing = 0;
    for (std::size_t i = 0; i < pictures[0].rgb.size(); ++i)
      differing += pictures[0].rgb[i] != pictures.back().rgb[i];
    report.Row(
        one.name, {NumberAfter(log, "median") / 1e3, NumberAfter(log, "p99") / 1e3},
        report.quick() ? "one run" : std::to_string(differing) + " bytes differ between two runs");
  }

  const auto result = arthro::test::RunWindow(
      "practise " + scene.string() + " --timing",
      InTurns(temp.path(), report.quick() ? "6" : "30", report.quick() ? 1 : 8));
  if (result.exit_code != 0) {
    std::fputs(result.err.c_str(), stderr);
    return 1;
  }
  for (const char* name : {"practice alone", "recorded as a film", "recorded as pictures",
                           "with the view from outside", "from outside and recorded"}) {
    const std::string line = std::string(name) + ": [0-9]+ frames, median";
    report.Row(name,
               {NumberAfter(result.err, line) / 1e3,
                NumberAfter(result.err, line + " [0-9.]+ ms, p99") / 1e3},
               "in turns, in one run");
  }
  return 0;
}
