// Statements of the packages about themselves: kinds of file, menu entry, licences.
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ARTHRO_SOURCE_DIR;

std::set<std::string> CapturesOf(const std::string& text, const std::string& form) {
  const std::regex regex(form);
  std::set<std::string> all;
  for (std::sregex_iterator found(text.begin(), text.end(), regex), none; found != none; ++found)
    all.insert((*found)[1]);
  return all;
}

TEST(DesktopEntry, OpensTheKindsOfFileThatTheProgramDefinesAndNoOther) {
  const std::string entry = TextOf(kRoot / "packaging/desktop/arthroscene.desktop");
  const std::string types = *CapturesOf(entry, "MimeType=([^\n]*)").begin();
  EXPECT_EQ(CapturesOf(types, "([^;]+);"),
            CapturesOf(TextOf(kRoot / "packaging/desktop/arthroscene-mime.xml"),
                       "<mime-type type=\"([^\"]+)\""));
}

// A scene that is a folder is known by the first bytes of its scene.json.
TEST(DesktopEntry, KnowsTheDemoSceneByItsContent) {
  const std::string types = TextOf(kRoot / "packaging/desktop/arthroscene-mime.xml");
  EXPECT_NE(types.find("&quot;arthroscene.scene/"), std::string::npos);
  EXPECT_LT(TextOf(kRoot / "resources/demo/scene.json").find("\"arthroscene.scene/"), 64u);
}

TEST(Copyright, OfTheDemoSceneIsWhatTheSceneDeclares) {
  const std::set<std::string> declared =
      CapturesOf(TextOf(kRoot / "resources/demo/scene.json"), "\"licence\": \"([^\"]*)\"");
  const std::string copyright = TextOf(kRoot / "packaging/debian/copyright");
  EXPECT_EQ(
      declared,
      CapturesOf(copyright, "Files: resources/demo/\\*\nCopyright: [^\n]*\nLicense: ([^\n]*)"));
}

}  // namespace
}  // namespace arthro::test
