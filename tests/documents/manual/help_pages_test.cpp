// The manual as `arthroscene help` and the window find it: every page, and where its links lead.
#include "app/help/help_pages.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/documents/manual/manual_text.h"
#include "tests/support/build_paths.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

const fs::path kDocuments = fs::path(ARTHRO_SOURCE_DIR) / "resources/doc";

TEST(HelpPages, AreEveryPageOfTheManualAndEveryReferencePage) {
  std::set<std::string> names;
  for (const app::HelpPage& page : app::HelpPages()) names.insert(page.name);
  std::size_t count = 0;
  for (const fs::path& folder : {kDocuments, kDocuments / "manual"})
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".md") continue;
      EXPECT_TRUE(names.contains(entry.path().stem())) << entry.path();
      ++count;
    }
  EXPECT_EQ(names.size(), count);
  for (const char* name : {"jobs", "safety", "devices", "records", "method", "glossary"})
    EXPECT_GT(app::HelpText(name).size(), 1000u) << name;
}

// A page leads to another page, to one of its headings, to a file beside the pages or to an
// address.
TEST(HelpPages, EveryLinkLeadsOn) {
  std::size_t count = 0;
  for (const app::HelpPage& page : app::HelpPages())
    for (const std::string& target : test::LinksOf(app::HelpText(page.name))) {
      if (target.starts_with("pictures/")) continue;
      const app::HelpLink link = app::LinkFrom(page.name, target);
      ++count;
      if (link.page.empty()) {
        EXPECT_TRUE(fs::exists(link.target)) << page.name << " links " << target;
        continue;
      }
      if (link.anchor.empty()) continue;
      const auto anchors = test::AnchorsOf(app::HelpText(link.page));
      EXPECT_NE(std::ranges::find(anchors, link.anchor), anchors.end())
          << page.name << " links " << target;
    }
  EXPECT_GT(count, 100u);
}

TEST(HelpPages, LinksAreFollowedFromTheFolderOfTheirPage) {
  EXPECT_EQ(app::LinkFrom("index", "depth.md").page, "depth");
  EXPECT_EQ(app::LinkFrom("index", "../jobs.md").page, "jobs");
  EXPECT_EQ(app::LinkFrom("safety", "devices.md").page, "devices");
  EXPECT_EQ(app::LinkFrom("numbers", "../method.md#metrics").anchor, "metrics");
  EXPECT_EQ(app::LinkFrom("method", "#metrics").page, "method");
  EXPECT_EQ(app::LinkFrom("method", "https://doi.org/10").target, "https://doi.org/10");
  EXPECT_EQ(app::LinkFrom("formats", "../../schemas/rig-1.schema.json").page, "");
  EXPECT_EQ(app::PagesLinkedFrom("index", "[a](depth.md) [b](depth.md#c) [d](../jobs.md)"),
            (std::vector<std::string>{"depth", "jobs"}));
}

TEST(HelpPages, AnchorsAreThoseOfTheHtml) {
  for (const app::HelpPage& page : app::HelpPages())
    EXPECT_EQ(app::AnchorOfHeading(page.title), test::AnchorOf(page.title)) << page.title;
}

}  // namespace
}  // namespace arthro
