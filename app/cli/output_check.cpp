#include "app/cli/output_check.h"

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Compares existing files and names that are still free; follows links.
bool IsSameFile(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path whole = fs::weakly_canonical(fs::absolute(a), ignored);
  return !whole.empty() && whole == fs::weakly_canonical(fs::absolute(b), ignored);
}

}  // namespace

void CheckOutputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const fs::path& output = outputs[i];
    if (output.empty() || output == "-") continue;
    std::error_code ignored;
    if (fs::is_directory(output, ignored))
      throw Error(Code::kFile, "this is a folder; give the name of a file", output);
    if (fs::exists(output, ignored) && !fs::is_regular_file(output, ignored))
      continue;  // a device or a pipe is written as it is
    for (const fs::path& input : inputs)
      if (!input.empty() && IsSameFile(output, input))
        throw Error(Code::kBadArgument,
                    "this is read by the job, which would overwrite it; name another file", output);
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[j].empty() && IsSameFile(output, outputs[j]))
        throw Error(Code::kBadArgument,
                    "two results would be written to this one file; give one another name", output);
    const fs::path folder = output.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored))
      throw Error(Code::kFile,
                  fmt::format("the folder {} does not exist; create it first", folder.string()),
                  output);
  }
}

void CheckOutputFolder(const fs::path& folder, const std::vector<fs::path>& files) {
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
    throw Error(Code::kFile, "this is a file; give the name of a folder", folder);
  for (const fs::path& file : files)
    if (!file.empty() && file != "-" && IsSameFile(file, folder))
      throw Error(Code::kBadArgument,
                  "this is named both as a file and as a folder; give one another name", folder);
}

}  // namespace arthro::app
