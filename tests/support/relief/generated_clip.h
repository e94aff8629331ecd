// Cavity clips of the reference generator beside a developer's checkout, which has its own
// renderer.
#pragma once

#include <filesystem>
#include <string>

namespace arthro::test {

// Whether Debian's python3-numpy and python3-opencv are installed, which the generator needs.
bool CanGenerateClips();

// Writes a clip into a folder; false where the generator fails.
bool GenerateClip(const std::filesystem::path& generator, const std::filesystem::path& folder,
                  const std::string& flags);

}  // namespace arthro::test

// Skips a test where there is no generator, and says so.
#define ARTHRO_REQUIRE_GENERATOR(variable)                                                      \
  ARTHRO_REQUIRE_SHARED(variable, "reference/cavity/gen_cavity.py");                            \
  if (!arthro::test::CanGenerateClips())                                                        \
  GTEST_SKIP() << "SKIPPED: python3-numpy and python3-opencv are not installed, so this claim " \
                  "about a clip of another program is not tested here"
