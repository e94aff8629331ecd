// Import of an existing panorama: a picture, and the report with its projection.
#include <algorithm>
#include <memory>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/state/edits.h"
#include "app/steps/panorama/panorama_step.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

double NumberOf(const nlohmann::json& json, const char* key, const fs::path& file) {
  const auto entry = json.find(key);
  if (entry == json.end() || !entry->is_number())
    throw Error(Code::kBadData,
                std::string("the report's \"panorama\" has no number \"") + key +
                    "\"; choose the report that `arthroscene panorama --report` wrote",
                file);
  return entry->get<double>();
}

}  // namespace

void ImportPanorama(EditorState& state, const fs::path& picture) {
  state.jobs.Start("Import " + picture.filename().string(), [picture](const Progress&) {
    auto panorama = std::make_shared<const ColourImage>(ReadColourImage(picture));
    return [picture, panorama](EditorState& now) {
      SetPanorama(now, "Import " + picture.filename().string(), panorama);
      now.step = Step::kPanorama;
      now.steps.panorama->shows_footage = false;
    };
  });
}

void ReadPanoramaReport(EditorState& state, const fs::path& report) {
  const nlohmann::json json =
      ParseJson(ReadWholeFile(report, kMostJsonBytes), Code::kBadData, report);
  const nlohmann::json part = json.is_object() ? json.value("panorama", nlohmann::json()) : json;
  if (!part.is_object())
    throw Error(Code::kBadData, "there is no \"panorama\" in it; choose the report of a panorama",
                report);
  Backdrop backdrop = state.document().scene.backdrop;
  if (const auto over = part.find("projection"); over != part.end() && over->is_object()) {
    // A panorama over a measured relief.
    const auto centre = over->value("centre_px", std::vector<double>());
    if (centre.size() != 2)
      throw Error(Code::kBadData, "the report's \"projection\" has no \"centre_px\"", report);
    backdrop.projection.type = ProjectionType::kEquirectangular;
    backdrop.projection.px_per_deg = NumberOf(*over, "px_per_deg", report);
    backdrop.projection.centre_px = {centre[0], centre[1]};
  } else {
    backdrop.projection.type = ProjectionType::kGnomonic;
    backdrop.projection.focal_px = NumberOf(part, "focal_px", report);
    backdrop.projection.centre_px = {NumberOf(part, "cx", report), NumberOf(part, "cy", report)};
  }
  const auto& panorama = state.document().panorama;
  if (panorama && (NumberOf(part, "width", report) != panorama->width ||
                   NumberOf(part, "height", report) != panorama->height))
    throw Error(Code::kBadData,
                "the report is of a panorama of another size; choose the one that was written with "
                "this panorama",
                report);
  SetBackdrop(state, backdrop, "the projection");
}

}  // namespace arthro::app
