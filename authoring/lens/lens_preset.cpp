#include "authoring/lens/lens_preset.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/json_object_reader.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::authoring {

LensPreset ReadLensPreset(const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(ReadWholeFile(file, kMostJsonBytes), Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "a lens preset must be a JSON object {…}; mend or remove it", file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  LensPreset preset;
  preset.name = file.stem().string();
  std::string schema, model;
  reader.Text("schema", schema, JsonObjectReader::kRequired);
  reader.Text("title", preset.title, JsonObjectReader::kRequired);
  reader.Text("known", preset.known, JsonObjectReader::kRequired);
  reader.Text("assumed", preset.assumed, JsonObjectReader::kRequired);
  reader.Text("model", model, JsonObjectReader::kRequired);
  reader.Angle("fov_deg", preset.field_of_view, {1, 300, "degrees"});
  reader.Number("aspect", preset.aspect, {0.2, 5});
  if (reader.Has("view_angle_deg"))
    reader.Angle("view_angle_deg", preset.view_angle.emplace(), {0, 120, "degrees"});
  ReadCamera(reader, preset.camera);
  reader.RefuseOtherKeys(true);
  if (schema != "arthroscene.lens_preset/1" && !schema.empty())
    reader.Fault("schema", "must be \"arthroscene.lens_preset/1\"");
  // Only models with one parameter follow from a field of view.
  if (model == "pinhole")
    preset.model = LensModel::kPinhole;
  else if (model == "equidistant")
    preset.model = LensModel::kKannalaBrandt;
  else if (model != "equisolid" && !model.empty())
    reader.Fault("model", "must be \"equisolid\", \"equidistant\" or \"pinhole\"");
  if (preset.field_of_view == 0 && faults.empty()) reader.Fault("fov_deg", "is missing");
  if (!faults.empty()) throw Error(Code::kBadData, faults.front().sentence, file);
  return preset;
}

std::vector<LensPreset> ReadLensPresets(const std::filesystem::path& folder) {
  std::vector<LensPreset> presets;
  std::error_code fault;
  for (const auto& entry : std::filesystem::directory_iterator(folder, fault))
    if (entry.path().extension() == ".json") presets.push_back(ReadLensPreset(entry.path()));
  if (fault) throw Error(Code::kFile, "this folder of lens presets cannot be read", folder);
  std::sort(presets.begin(), presets.end(),
            [](const LensPreset& a, const LensPreset& b) { return a.name < b.name; });
  return presets;
}

Lens LensFromPreset(const LensPreset& preset, int width, int height, const LensCircle& circle) {
  if (!(circle.r > 0))
    throw Error(Code::kBadArgument,
                fmt::format("the lens preset {} needs a round window in the pictures, and there is "
                            "none; calibrate the lens instead",
                            preset.name));
  Lens lens;
  lens.model = preset.model;
  lens.width = width;
  lens.height = height;
  lens.cx = circle.cx;
  lens.cy = circle.cy;
  lens.aspect = preset.aspect;
  lens.circle = circle;
  lens.field_of_view = preset.field_of_view;
  lens.camera = preset.camera;
  // Every model here is linear in f, so the radius at f = 1 determines f.
  lens.focal_px = 1;
  const auto radius = RadiusFromAngle(lens, preset.field_of_view / 2);
  if (!radius)
    throw Error(Code::kBadArgument,
                fmt::format("the lens preset {} has a wider field than its model", preset.name));
  lens.focal_px = circle.r / *radius;
  return lens;
}

}  // namespace arthro::authoring
