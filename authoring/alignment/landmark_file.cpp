#include "authoring/alignment/landmark_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/file_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro::authoring {
namespace {

constexpr const char* kPairsSchema = "arthroscene.pairs/1";

std::optional<Sight> SightOf(const PairInFile& pair, const LoadedScene& scene) {
  if (pair.panorama) return SightOfPanorama(scene.scene.backdrop, pair.panorama->pixel);
  const ScopeClick& click = *pair.scope;
  const simulation::ScopeView view = simulation::ViewFromPose(
      {click.latitude, click.longitude, click.roll, click.insertion}, scene.scene.scope.view_angle);
  return SightOfScope(simulation::OpticsOf(scene.scene.scope, scene.lens), view, click.size,
                      click.pixel);
}

bool IsInPanorama(const glm::dvec2& pixel, const LoadedScene& scene) {
  const ColourImage& panorama = OrEmpty(scene.panorama);
  return pixel.x <= panorama.width - 0.5 && pixel.y <= panorama.height - 0.5;
}

}  // namespace

PairsFile ParsePairs(const std::string& text, const std::filesystem::path& file) {
  const auto check = [](JsonObjectReader& reader, const PairsFile& pairs) {
    for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
      const PairInFile& pair = pairs.pairs[i];
      if (pair.panorama.has_value() + pair.scope.has_value() + pair.place.has_value() != 1)
        return reader.Fault(fmt::format("pairs[{}]", i),
                            "must have one partner: panorama, scope or place");
    }
  };
  return FromJsonFile<PairsFile>(text, kPairsSchema, "pairs of landmarks", file, check);
}

PairsFile ReadPairs(const std::filesystem::path& file) {
  return ParsePairs(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string PairsSchemaText() {
  auto json = FileSchema(kPairsSchema, "Arthroscene pairs of landmarks, version 1",
                         "Points of a tissue's model and their partners in a scene, for "
                         "`arthroscene align`. Lengths in metres, angles in degrees under keys "
                         "that end in _deg. This schema cannot express that a pair has exactly one "
                         "partner: panorama, scope or place.",
                         SchemaOfFields(PairsFile()));
  return PrettyJson(json);
}

std::vector<LandmarkPair> PairsInScene(const PairsFile& pairs, const LoadedScene& scene,
                                       ReliefOrigin unstated, const std::filesystem::path& file) {
  std::vector<LandmarkPair> found;
  for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
    const PairInFile& pair = pairs.pairs[i];
    const auto refuse = [&](const std::string& sentence) {
      throw Error(Code::kBadData, fmt::format("pairs[{}]: {}", i, sentence), file);
    };
    LandmarkPair& now = found.emplace_back();
    now.name = pair.name;
    now.x_in_tissue = pair.model;
    if (pair.place) {
      now.scene.x_in_portal = pair.place->position;
      now.scene.lateral_sigma = now.scene.range_sigma = pair.place->sigma;
      continue;
    }
    if (pair.panorama && !IsInPanorama(pair.panorama->pixel, scene))
      refuse("the pixel is outside of the panorama; mend it");
    const std::optional<Sight> sight = SightOf(pair, scene);
    if (!sight) refuse("the pixel is outside of the scope's round picture; mend it");
    const std::optional<ScenePoint> point = PointOnRelief(scene, *sight, unstated);
    if (!point)
      refuse("nothing was imaged there, so its distance is not known; choose another place");
    now.scene = *point;
  }
  return found;
}

}  // namespace arthro::authoring
