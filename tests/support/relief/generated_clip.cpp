#include "tests/support/relief/generated_clip.h"

#include <cstdlib>

#include <fmt/format.h>

namespace arthro::test {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, which has the packages

bool Runs(const std::string& line) {
  return std::system((line + " >/dev/null 2>&1 </dev/null").c_str()) == 0;
}

}  // namespace

bool CanGenerateClips() { return Runs(fmt::format("{} -c 'import numpy, cv2'", kPython)); }

bool GenerateClip(const std::filesystem::path& generator, const std::filesystem::path& folder,
                  const std::string& flags) {
  // -B: the folder of the generator stays as it is.
  return Runs(
      fmt::format("{} -B '{}' '{}' {}", kPython, generator.string(), folder.string(), flags));
}

}  // namespace arthro::test
