#include "app/steps/panorama/board/lens_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/lens_io.h"

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
          fmt::format("{}, {} × {} px, {:.0f}° across", ToString(lens.model), lens.width,
                      lens.height, DegreesFromRadians(lens.field_of_view)),
          lens};
}

std::vector<LensChoice> LensChoices(const fs::path& folder) {
  std::vector<LensChoice> choices = {
      {"none",
       "The frames are taken as they are, as if the lens did not bend straight lines.",
       {}}};
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return choices;
  try {
    for (const authoring::LensPreset& preset : authoring::ReadLensPresets(folder))
      choices.push_back({preset.title, preset.known + " Assumed: " + preset.assumed, {}, preset});
  } catch (const Error&) {
    choices.resize(1);
  }
  return choices;
}

void FitPresets(std::vector<LensChoice>& choices, int width, int height, const LensCircle& circle) {
  for (LensChoice& choice : choices) {
    if (!choice.preset) continue;
    choice.lens.reset();
    choice.problem.clear();
    try {
      choice.lens = authoring::LensFromPreset(*choice.preset, width, height, circle);
    } catch (const Error& error) {
      choice.problem = error.sentence();
    }
  }
}

}  // namespace arthro::app
