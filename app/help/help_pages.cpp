#include "app/help/help_pages.h"

#include <array>
#include <cstdint>
#include <regex>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include "app/platform/resource_folder.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIndex = "index";
constexpr std::uint64_t kMostPageBytes = std::uint64_t{1} << 20;

fs::path FileOf(const std::string& name) {
  return ResourceFolder() / "doc" / "manual" / (name + ".md");
}

std::string TitleOf(const fs::path& file) {
  const std::string first = ReadBeginning(file, 200);
  return first.starts_with("# ") ? first.substr(2, first.find('\n') - 2) : file.stem().string();
}

}  // namespace

std::vector<HelpPage> HelpPages() {
  std::error_code ignored;
  if (!fs::exists(FileOf(kIndex), ignored))
    throw Error(
        Code::kFile,
        "the manual is not here; install the program again, or read resources/doc/manual of "
        "its sources",
        FileOf(kIndex));
  const std::string index = ReadWholeFile(FileOf(kIndex), kMostPageBytes);
  std::vector<HelpPage> pages = {{kIndex, TitleOf(FileOf(kIndex))}};
  static const std::regex link(R"(\]\(([a-z-]+)\.md\))");
  for (std::sregex_iterator found(index.begin(), index.end(), link), none; found != none; ++found) {
    const std::string name = (*found)[1];
    bool is_known = !fs::exists(FileOf(name), ignored);
    for (const HelpPage& page : pages) is_known = is_known || page.name == name;
    if (!is_known) pages.push_back({name, TitleOf(FileOf(name))});
  }
  return pages;
}

std::string HelpText(const std::string& name) {
  const std::vector<HelpPage> pages = HelpPages();
  std::string names;
  for (const HelpPage& page : pages) {
    if (page.name == name) return ReadWholeFile(FileOf(name), kMostPageBytes);
    names += (names.empty() ? "" : ", ") + page.name;
  }
  throw Error(Code::kBadData, "the manual has no page \"" + name + "\"; its pages are " + names +
                                  ", and `arthroscene JOB --help` lists the options of a job");
}

std::optional<fs::path> HelpInHtml(const std::string& name) {
  const fs::path resources = ResourceFolder();
  std::error_code ignored;
  // Installed: share/doc/arthroscene. In a source tree: made by packaging/manual.
  for (const char* folder : {"doc/arthroscene/html/manual", "build/manual/html/manual"}) {
    const fs::path file = resources.parent_path() / folder / (name + ".html");
    if (fs::exists(file, ignored)) return file;
  }
  return std::nullopt;
}

std::string WhereTheManualIs() {
  if (const auto index = HelpInHtml(kIndex)) return "The manual lies in " + index->string();
  return "The manual with pictures is not on this machine: install the package arthroscene-doc, or "
         "run packaging/manual in the source tree.";
}

bool OpenOnDesktop(const fs::path& file) {
  // The shell ends at once, so that nothing is left to wait for.
  std::string shell = "sh", flag = "-c", place = file.string(),
              line = "command -v xdg-open > /dev/null && { xdg-open \"$0\" > /dev/null 2>&1 & }";
  const std::array<char*, 5> arguments = {shell.data(), flag.data(), line.data(), place.data(),
                                          nullptr};
  pid_t process = 0;
  if (::posix_spawnp(&process, "sh", nullptr, nullptr, arguments.data(), environ) != 0)
    return false;
  int status = 0;
  return ::waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace arthro::app
