// Version, commit and libraries: nothing that the program is built from is left out.
#include "app/about/about.h"

#include <array>
#include <cstdio>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/input_file.h"
#include "tests/support/build_paths.h"

namespace arthro::app {
namespace {

std::string OutputOf(const std::string& line) {
  std::string text;
  FILE* pipe = ::popen((line + " 2>&1 </dev/null").c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part;
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), read);
  ::pclose(pipe);
  return text;
}

// The Debian package's list of what the build needs is checked by every build in a clean chroot.
TEST(About, NamesEveryLibraryThatTheDebianPackageIsBuiltWith) {
  std::set<std::string> named;
  for (const BuiltWith& own : Libraries()) named.insert(own.package);
  named.insert("libjpeg-dev");  // a name for libjpeg62-turbo-dev
  const std::string control = ReadWholeFile(ARTHRO_SOURCE_DIR "/packaging/debian/control", 1 << 20);
  const std::regex library(R"(\n ((lib|zlib|nlohmann)[a-z0-9.+-]*-dev),)");
  int count = 0;
  for (std::sregex_iterator found(control.begin(), control.end(), library), end; found != end;
       ++found, ++count)
    EXPECT_TRUE(named.contains((*found)[1])) << (*found)[1];
  EXPECT_GT(count, 20);
}

TEST(About, StatesLicenceOfEachLibrary) {
  for (const BuiltWith& own : Libraries()) {
    EXPECT_STRNE(own.licence, "") << own.name;
    EXPECT_TRUE(*own.version != '\0' || std::string(own.name) == "stb") << own.name;
  }
}

TEST(About, LongVersionNamesAFileThatHoldsEveryLicence) {
  const std::string text = OutputOf(ARTHRO_PROGRAM " --version --long");
  const std::size_t place = text.rfind(" in /");
  ASSERT_NE(place, std::string::npos) << text;
  const std::string file = text.substr(place + 4, text.find('\n', place) - place - 4);
  const std::string licences = ReadWholeFile(file, 8 << 20);
  for (const BuiltWith& own : Libraries())
    EXPECT_NE(licences.find("======== " + std::string(own.package)), std::string::npos) << own.name;
}

TEST(About, LongVersionHoldsCommitAndLibraries) {
  const std::string text = OutputOf(ARTHRO_PROGRAM " --version --long");
  EXPECT_NE(text.find("commit " + ShortCommit()), std::string::npos) << text;
  for (const BuiltWith& own : Libraries())
    EXPECT_NE(text.find(own.name), std::string::npos) << own.name;
  EXPECT_EQ(OutputOf(ARTHRO_PROGRAM " --version"), std::string("arthroscene ") + Version() + "\n");
}

}  // namespace
}  // namespace arthro::app
