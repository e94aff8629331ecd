// Parameters of a job as flags, --options FILE and --dump-options (app/cli/flags/options_cli.h).
#include "app/cli/flags/options_cli.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

struct Contact {
  double stiffness = 500, depth = 0.002;
  template <class V>
  void Visit(V&& v) {
    v("stiffness", stiffness, Range{0, 3000, true}, "N/m", "Stiffness.");
    v("depth", depth, Range{0, 0.1}, "m", "Depth.");
  }
};

struct Limits {
  int ticks = 3;
  bool is_on = true;
  template <class V>
  void Visit(V&& v) {
    v("ticks", ticks, Range{1, 9}, "", "Ticks.");
    v("is_on", is_on, Any{}, "", "Whether it is on.");
  }
};

struct Job {
  Contact contact;
  Limits limits;
  // The exit code of a parse with these words, and the fault.
  int Parse(std::vector<std::string> words, std::string* fault = nullptr) {
    CLI::App app;
    std::string required;
    app.add_option("SCENE", required)->required();
    AddOptions(app, contact, limits);
    std::reverse(words.begin(), words.end());
    try {
      app.parse(words);
    } catch (const CLI::ParseError& error) {
      if (fault != nullptr) *fault = error.what();
      return error.get_exit_code();
    }
    return 0;
  }
};

TEST(OptionsCli, FlagsWinOverTheFileWhereverTheyStand) {
  const test::TempFolder folder;
  const std::string file = (folder / "o.json").string();
  WriteAtomically(file, R"({"stiffness": 700, "depth": 0.003, "ticks": 5})");
  Job job;
  EXPECT_EQ(job.Parse({"s", "--depth-mm", "4", "--options", file, "--is-on=false"}), 0);
  EXPECT_EQ(job.contact.stiffness, 700);
  EXPECT_EQ(job.contact.depth, 0.004);
  EXPECT_EQ(job.limits.ticks, 5);
  EXPECT_FALSE(job.limits.is_on);
}

TEST(OptionsCli, TheFileMayNameNoOtherKey) {
  const test::TempFolder folder;
  const std::string file = (folder / "o.json").string();
  WriteAtomically(file, R"({"stifness": 700})");
  Job job;
  EXPECT_THROW(job.Parse({"s", "--options", file}), Error);
}

TEST(OptionsCli, TheDumpHoldsEveryParameterAndIsReadBack) {
  Job job;
  testing::internal::CaptureStdout();
  // Nothing else is required, as with --help.
  EXPECT_EQ(job.Parse({"--dump-options", "--stiffness", "900", "--ticks=7"}), 0);
  std::fflush(stdout);
  const std::string dumped = testing::internal::GetCapturedStdout();
  const test::TempFolder folder;
  WriteAtomically(folder / "o.json", dumped);
  Job again;
  EXPECT_EQ(again.Parse({"s", "--options", (folder / "o.json").string()}), 0) << dumped;
  EXPECT_EQ(again.contact.stiffness, 900);
  EXPECT_EQ(again.contact.depth, 0.002);
  EXPECT_EQ(again.limits.ticks, 7);
  EXPECT_TRUE(again.limits.is_on);
}

TEST(OptionsCli, AnExcludedLowerEndIsRefusedWithItsRange) {
  Job job;
  std::string fault;
  EXPECT_NE(job.Parse({"s", "--stiffness", "0"}, &fault), 0);
  EXPECT_NE(fault.find("above 0 to 3000 N/m"), std::string::npos) << fault;
}

TEST(OptionsCli, AFieldOfTheSceneHasItsRangeInTheUnitsOfPeople) {
  const Range field = ShownRange<ScopeSpec>("field_of_view");
  EXPECT_EQ(field.min, 0);
  EXPECT_EQ(field.max, 180);
  EXPECT_TRUE(field.above_min);
  EXPECT_THROW(ShownRange<ScopeSpec>("field_of_veiw"), std::out_of_range);
}

}  // namespace
}  // namespace arthro::app
