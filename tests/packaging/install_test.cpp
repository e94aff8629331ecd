// `cmake --install`: everything that a user needs, in the places of a Unix system.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

struct Output {
  int exit_code = -1;
  std::string text;  // both streams
};

Output RunLine(const std::string& line) {
  Output output;
  FILE* pipe = ::popen((line + " 2>&1 </dev/null").c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> part;
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe))
    output.text.append(part.data(), read);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) output.exit_code = WEXITSTATUS(status);
  return output;
}

class Install : public ::testing::Test {
 protected:
  void SetUp() override {
    const Output output = RunLine("DESTDIR=" + root_.path().string() +
                                  " " ARTHRO_CMAKE " --install " ARTHRO_BUILD_DIR " --prefix /usr");
    ASSERT_EQ(output.exit_code, 0) << output.text;
  }

  TempFolder root_;
  const fs::path usr_ = root_ / "usr";
};

TEST_F(Install, HoldsProgramResourcesDocumentsLicenceAndDeviceRule) {
  for (const char* file : {"bin/arthroscene",
                           "share/man/man1/arthroscene.1",
                           "share/man/man1/arthroscene-panorama.1",
                           "share/bash-completion/completions/arthroscene",
                           "share/applications/arthroscene.desktop",
                           "share/mime/packages/arthroscene.xml",
                           "share/icons/hicolor/scalable/apps/arthroscene.svg",
                           "lib/udev/rules.d/70-arthroscene.rules",
                           "share/arthroscene/batch/Snakefile",
                           "share/arthroscene/batch/sweep.smk",
                           "share/arthroscene/batch/slurm/config.yaml",
                           "share/arthroscene/lab-records",
                           "share/arthroscene/demo/scene.json",
                           "share/arthroscene/presets/lenses",
                           "share/arthroscene/presets/rigs",
                           "share/arthroscene/presets/tissues",
                           "share/arthroscene/schemas/scene-2.schema.json",
                           "share/doc/arthroscene/LICENSE",
                           "share/doc/arthroscene/README.md",
                           "share/doc/arthroscene/CHANGELOG.md",
                           "share/doc/arthroscene/CONTRIBUTING.md",
                           "share/doc/arthroscene/SECURITY.md",
                           "share/doc/arthroscene/resources/doc/method.md",
                           "share/doc/arthroscene/resources/pictures/practice.jpg"})
    EXPECT_TRUE(fs::exists(usr_ / file)) << file;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(ARTHRO_SOURCE_DIR) / "resources/doc"))
    EXPECT_TRUE(fs::exists(usr_ / "share/doc/arthroscene" /
                           entry.path().lexically_relative(ARTHRO_SOURCE_DIR)))
        << entry.path();
}

// Places below /usr that the documents name, with or without a mark behind them.
TEST_F(Install, HoldsEveryPlaceThatTheDocumentsName) {
  static const std::regex place(R"(/usr/share/arthroscene[A-Za-z0-9_./-]*[A-Za-z0-9_-])");
  std::size_t count = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(ARTHRO_SOURCE_DIR) / "resources/doc")) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = TextOf(entry.path());
    for (std::sregex_iterator found(text.begin(), text.end(), place), none; found != none;
         ++found, ++count)
      EXPECT_TRUE(fs::exists(root_ / found->str().substr(1)))
          << entry.path().filename() << ": " << found->str();
  }
  EXPECT_GE(count, 3u);
}

TEST_F(Install, ScriptsAreExecutable) {
  for (const char* file : {"lab-records", "batch/slurm/state", "batch/step"})
    EXPECT_EQ(::access((usr_ / "share/arthroscene" / file).c_str(), X_OK), 0) << file;
}

// `cpack -G TGZ`: one archive for systems without Debian packages.
TEST(InstallArchive, UnpacksToAProgramThatFindsItsFiles) {
  const TempFolder folder;
  const std::string out = folder.path().string();
  const Output packed = RunLine(
      "cd " ARTHRO_BUILD_DIR " && " ARTHRO_CPACK " -G TGZ -D CPACK_STRIP_FILES=OFF -B " + out);
  ASSERT_EQ(packed.exit_code, 0) << packed.text;
  ASSERT_EQ(RunLine("cd " + out + " && tar -xzf arthroscene-*.tar.gz && mv arthroscene-*/ prefix")
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(folder / "prefix/lib/udev/rules.d/70-arthroscene.rules"));
  EXPECT_EQ(RunLine(out + "/prefix/bin/arthroscene check " + out + "/prefix/share/arthroscene/demo")
                .exit_code,
            0);
}

TEST_F(Install, ProgramReadsTheInstalledResources) {
  const std::string program = (usr_ / "bin/arthroscene").string();
  EXPECT_EQ(RunLine(program + " check " + (usr_ / "share/arthroscene/demo").string()).exit_code, 0);
  // Damages the installed demo scene: the sources' own must not be read instead.
  std::ofstream(usr_ / "share/arthroscene/demo/scene.json") << "{";
  const Output output = RunLine(program + " demo -o " + (root_ / "out").string());
  EXPECT_EQ(output.exit_code, 1) << output.text;
  EXPECT_NE(output.text.find((usr_ / "share/arthroscene/demo").string()), std::string::npos)
      << output.text;
}

}  // namespace
}  // namespace arthro::test
