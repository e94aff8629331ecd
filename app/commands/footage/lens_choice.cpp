#include "app/commands/footage/lens_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/lens_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// "linvatec_hd4300_4mm.json" as a person reads it.
std::string WordsOfFile(const fs::path& file) {
  std::string words = file.stem().string();
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

LensChoice LensFromFile(const fs::path& file) {
  const Lens lens = ReadLens(file);
  return {WordsOfFile(file),
          fmt::format("{}, {} × {} px, {:.0f}° across", WordOf(lens.model), lens.width, lens.height,
                      DegreesFromRadians(lens.field_of_view)),
          lens};
}

std::vector<LensChoice> LensChoices(const fs::path& folder) {
  std::vector<LensChoice> choices = {
      {"none",
       "The frames are taken as they are, as if the lens did not bend straight lines.",
       {}}};
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".json") files.push_back(it->path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    try {
      choices.push_back(LensFromFile(file));
    } catch (const Error&) {
      // A broken preset must not keep the others away.
    }
  }
  return choices;
}

}  // namespace arthro::app
