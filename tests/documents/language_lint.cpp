// language_lint [--counts] [PATH...]: lists what breaks the rules of language, one line per fault,
// in the files whose names begin with one of the paths. --counts: a table of faults per folder
// instead.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "tests/documents/language_rules.h"
#include "tests/support/build_paths.h"

int main(int argc, char** argv) {
  std::vector<std::string> paths(argv + 1, argv + argc);
  const bool shows_counts = std::erase(paths, "--counts") > 0;
  std::map<std::string, int> counts;
  int total = 0;
  for (const auto& [file, faults] : arthro::test::RepositoryLanguageFaults(ARTHRO_SOURCE_DIR)) {
    const std::string name = file.string();
    if (!paths.empty() && std::ranges::none_of(paths, [&](const std::string& path) {
          return name.starts_with(path);
        }))
      continue;
    total += static_cast<int>(faults.size());
    counts[file.parent_path().string()] += static_cast<int>(faults.size());
    if (shows_counts) continue;
    for (const auto& fault : faults)
      std::printf("%s:%d: %s\n", name.c_str(), fault.line, fault.what.c_str());
  }
  if (shows_counts)
    for (const auto& [folder, count] : counts)
      std::printf("%5d  %s\n", count, folder.empty() ? "." : folder.c_str());
  std::printf("%d faults of language\n", total);
  return total == 0 ? 0 : 1;
}
