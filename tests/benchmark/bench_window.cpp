// The window: from the program's start to the first picture, and how long frames take while an
// author swings the scope, drags a depth slider and practises. Drawn on an X server of its own, in
// software where there is no graphics card. Frame times are of the whole loop: input, panels,
// pictures, drawing, handing over. Beside the times stands what the same script shows twice: 0
// differing bytes.
#include <cstdlib>
#include <fstream>
#include <regex>

#include "simulation/scene/image_io.h"
#include "tests/benchmark/bench_report.h"
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
  const int runs = report.quick() ? 2 : 12;
  for (int run = 0; run < runs; ++run) {
    const auto result = arthro::test::RunWindow(edit, "quit");
    const double ms = NumberAfter(result.err, "first picture after");
    if (result.exit_code != 0 || ms < 0) {
      std::fputs(result.err.c_str(), stderr);
      return 1;
    }
    if (run > 0) starts.push_back(ms / 1e3);
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
    for (int twice = 0; twice < 2; ++twice) {
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
      differing += pictures[0].rgb[i] != pictures[1].rgb[i];
    report.Row(one.name, {NumberAfter(log, "median") / 1e3, NumberAfter(log, "p99") / 1e3},
               std::to_string(differing) + " bytes differ between two runs");
  }
  return 0;
}
