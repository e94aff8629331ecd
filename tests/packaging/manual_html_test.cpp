// packaging/manual: the manual as HTML, and as one page, of which the PDF is made. No link is dead.
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

std::set<std::string> MatchesOf(const std::string& text, const char* form) {
  const std::regex regex(form);
  std::set<std::string> all;
  for (std::sregex_iterator found(text.begin(), text.end(), regex), none; found != none; ++found)
    all.insert((*found)[1]);
  return all;
}

class ManualHtml : public ::testing::Test {
 protected:
  void Make(const std::string& what) {
    if (std::system("command -v pandoc > /dev/null") != 0)
      GTEST_SKIP() << "pandoc is not installed";
    const std::string line = std::string(ARTHRO_SOURCE_DIR) + "/packaging/manual " + what + " " +
                             out_.path().string() + " > " + (out_ / "said").string() + " 2>&1";
    ASSERT_EQ(std::system(line.c_str()), 0) << TextOf(out_ / "said");
  }
  TempFolder out_;
};

TEST_F(ManualHtml, EveryLinkOfEveryPageLeadsOn) {
  ASSERT_NO_FATAL_FAILURE(Make("html"));
  if (IsSkipped()) return;
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out_ / "html")) {
    if (entry.path().extension() != ".html") continue;
    const std::string page = TextOf(entry.path());
    for (const std::string& link : MatchesOf(page, R"re((?:href|src)="([^"]+)")re")) {
      if (link.find("://") != std::string::npos) continue;
      ++count;
      const std::size_t mark = link.find('#');
      const fs::path file =
          mark == 0 ? entry.path() : entry.path().parent_path() / link.substr(0, mark);
      ASSERT_TRUE(fs::exists(file)) << entry.path().filename() << " links " << link;
      if (mark != std::string::npos) {
        EXPECT_TRUE(MatchesOf(TextOf(file), R"re( id="([^"]+)")re").contains(link.substr(mark + 1)))
            << entry.path().filename() << " links " << link;
      }
    }
  }
  EXPECT_GT(count, 200u);
}

TEST_F(ManualHtml, OnePageHoldsEveryPageAndTheTargetOfEachLink) {
  ASSERT_NO_FATAL_FAILURE(Make("single"));
  if (IsSkipped()) return;
  const std::string text = TextOf(out_ / "single/manual.html");
  const std::set<std::string> ids = MatchesOf(text, R"re( id="([^"]+)")re");
  for (const char* folder : {"resources/doc", "resources/doc/manual"})
    for (const auto& entry : fs::directory_iterator(fs::path(ARTHRO_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".md") {
        EXPECT_TRUE(ids.contains(entry.path().stem())) << entry.path();
      }
  std::size_t count = 0;
  for (const std::string& link : MatchesOf(text, R"re( href="([^"]+)")re")) {
    if (link.find("://") != std::string::npos || link == "manual.css") continue;
    ++count;
    EXPECT_TRUE(link.starts_with('#') && ids.contains(link.substr(1))) << link;
  }
  EXPECT_GT(count, 30u) << "different places that are linked";
}

}  // namespace
}  // namespace arthro::test
