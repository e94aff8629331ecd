#include "app/help/help_pages.h"

#include <algorithm>
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

// The manual's own pages lie in a folder, the reference pages above it.
fs::path FileOf(const std::string& name) {
  const fs::path documents = ResourceFolder() / "doc", own = documents / "manual" / (name + ".md");
  std::error_code ignored;
  return fs::exists(own, ignored) || name == kIndex ? own : documents / (name + ".md");
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
  static const std::regex link(R"(\]\((?:\.\./)?([a-z-]+)\.md\))");
  for (std::sregex_iterator found(index.begin(), index.end(), link), none; found != none; ++found) {
    const std::string name = (*found)[1];
    bool is_known = !fs::exists(FileOf(name), ignored);
    for (const HelpPage& page : pages) is_known = is_known || page.name == name;
    if (!is_known) pages.push_back({name, TitleOf(FileOf(name))});
  }
  return pages;
}

HelpLink LinkFrom(const std::string& page, const std::string& target) {
  if (target.find("://") != std::string::npos) return {"", "", target};
  const std::size_t mark = target.find('#');
  const std::string anchor = mark == std::string::npos ? "" : target.substr(mark + 1);
  if (mark == 0) return {page, anchor, ""};
  const fs::path file = (FileOf(page).parent_path() / target.substr(0, mark)).lexically_normal();
  for (const HelpPage& each : HelpPages())
    if (FileOf(each.name).lexically_normal() == file) return {each.name, anchor, file.string()};
  return {"", anchor, file.string()};
}

std::string AnchorOfHeading(std::string_view heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == ' ')
      anchor += '-';
    else if (letter >= 'A' && letter <= 'Z')
      anchor += static_cast<char>(letter - 'A' + 'a');
    else if ((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') ||
             letter == '-' || letter == '_' || byte >= 0x80)
      anchor += letter;
  }
  return anchor;
}

std::vector<std::string> PagesLinkedFrom(const std::string& page, const std::string& text) {
  static const std::regex link(R"(\]\(([^)\s]+\.md)(#[^)\s]*)?\))");
  std::vector<std::string> names;
  for (std::sregex_iterator found(text.begin(), text.end(), link), none; found != none; ++found) {
    const std::string name = LinkFrom(page, (*found)[1]).page;
    if (!name.empty() && name != page && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
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
  for (const char* folder : {"doc/arthroscene/html", "build/manual/html"})
    for (const char* part : {"manual", ""}) {
      const fs::path file = resources.parent_path() / folder / part / (name + ".html");
      if (fs::exists(file, ignored)) return file;
    }
  return std::nullopt;
}

std::string WhereTheManualIs() {
  if (const auto index = HelpInHtml(kIndex)) return "The manual lies in " + index->string();
  return "The manual with pictures is not on this machine: install the package arthroscene-doc, or "
         "run packaging/manual in the source tree.";
}

fs::path LicenceTexts() {
  std::error_code ignored;
  const fs::path build = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
  for (const fs::path& file :
       {ResourceFolder() / "built-with.txt", build / "app/about/built-with.txt"})
    if (fs::exists(file, ignored)) return fs::canonical(file, ignored);
  return {};
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
