// Listings of the manual that are marked "sh runnable" are run, page by page, in a scratch folder.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/documents/manual/manual_text.h"
#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

constexpr const char* kRunnable = "sh runnable";

std::string RunnableLines(const std::string& page) {
  std::string lines;
  for (const Listing& listing : ListingsOf(page))
    if (listing.info == kRunnable) lines += listing.body;
  return lines;
}

std::vector<ManualText> PagesWithExamples() {
  std::vector<ManualText> pages = ManualTexts(ARTHRO_SOURCE_DIR);
  std::erase_if(pages, [](const ManualText& page) { return RunnableLines(page.text).empty(); });
  return pages;
}

class ManualExamples : public ::testing::TestWithParam<ManualText> {};

TEST_P(ManualExamples, Run) {
  const TempFolder temp;
  std::ofstream(temp / "page.sh") << "set -eux\n" << RunnableLines(GetParam().text);
  const std::string folder = temp.path().string();
  const std::string programs = std::filesystem::path(ARTHRO_PROGRAM).parent_path().string();
  const std::string line = "cd " + folder + " && HOME=" + folder + " DISPLAY= PATH=" + programs +
                           ":\"$PATH\" bash page.sh > said 2>&1 < /dev/null";
  EXPECT_EQ(std::system(line.c_str()), 0) << TextOf(temp / "said");
}

INSTANTIATE_TEST_SUITE_P(Pages, ManualExamples, ::testing::ValuesIn(PagesWithExamples()),
                         [](const auto& page) { return page.param.name; });

TEST(ManualExamples, AreOnTheResearchersPage) {
  const auto pages = PagesWithExamples();
  EXPECT_TRUE(
      std::ranges::any_of(pages, [](const ManualText& page) { return page.name == "researcher"; }));
}

}  // namespace
}  // namespace arthro::test
