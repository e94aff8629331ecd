#include "app/about/about.h"

#include <fmt/format.h>

namespace arthro::app {
namespace {

constexpr BuiltWith kLibraries[] = {
#include "libraries.inc"
};

constexpr const char* kCommit =
#include "commit.inc"
    ;

}  // namespace

std::span<const BuiltWith> Libraries() { return kLibraries; }

const char* Version() { return ARTHRO_VERSION; }

std::string ShortCommit() { return std::string(kCommit).substr(0, 12); }

std::string LongVersion(const std::filesystem::path& licence_texts) {
  const std::string commit = ShortCommit();
  std::string text =
      fmt::format("arthroscene {}\ncommit {}\nlicence AGPL-3.0-or-later\n\nbuilt with\n", Version(),
                  commit.empty() ? "unknown" : commit);
  for (const BuiltWith& own : Libraries())
    text += fmt::format("  {:<20} {:<12} {}\n", own.name, own.version, own.licence);
  text += licence_texts.empty()
              ? "\nThe texts of these licences are missing; install the program again."
              : "\nThe texts of these licences are in " + licence_texts.string();
  return text;
}

}  // namespace arthro::app
