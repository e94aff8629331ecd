#include "authoring/alignment/landmark_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro::authoring {
namespace {

constexpr const char* kSchema = "arthroscene.pairs/1";

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
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "pairs of landmarks must be a JSON object {…}; mend the file",
                file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  std::string schema;
  reader.Text("schema", schema, JsonObjectReader::kRequired);
  if (schema != kSchema && !schema.empty())
    throw Error(Code::kBadData,
                fmt::format("its schema is \"{}\"; this program reads \"{}\"", schema, kSchema),
                file);
  PairsFile pairs;
  pairs.Visit(FieldReader(reader));
  reader.RefuseOtherKeys(true);
  for (std::size_t i = 0; i < pairs.pairs.size() && faults.empty(); ++i) {
    const PairInFile& pair = pairs.pairs[i];
    if (pair.panorama.has_value() + pair.scope.has_value() + pair.place.has_value() != 1) {
      const std::string key = fmt::format("pairs[{}]", i);
      faults.push_back({key, key + " must have one partner: panorama, scope or place"});
    }
  }
  if (!faults.empty()) throw Error(Code::kBadData, faults.front().sentence, file);
  return pairs;
}

PairsFile ReadPairs(const std::filesystem::path& file) {
  return ParsePairs(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string PairsSchemaText() {
  auto json = FileSchema(kSchema, "Arthroscene pairs of landmarks, version 1",
                         "Points of a tissue's model and their partners in a scene, for "
                         "`arthroscene align`. Lengths in metres, angles in degrees under keys "
                         "that end in _deg. This schema cannot express that a pair has exactly one "
                         "partner: panorama, scope or place.",
                         SchemaOfFields(PairsFile()));
  return PrettyJson(json);
}

std::vector<LandmarkPair> PairsInScene(const PairsFile& pairs, const LoadedScene& scene,
                                       const std::filesystem::path& file) {
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
    const std::optional<ScenePoint> point = PointOnRelief(scene, *sight);
    if (!point)
      refuse("nothing was imaged there, so its distance is not known; choose another place");
    now.scene = *point;
  }
  return found;
}

namespace {

using Json = nlohmann::ordered_json;

Json JsonOf(const Pose& pose) {
  const glm::dquat& q = pose.quaternion;
  return {{"position", {pose.position.x, pose.position.y, pose.position.z}},
          {"quaternion", {q.w, q.x, q.y, q.z}},
          {"scale", pose.scale}};
}

Json JsonOf(const ReliefFit& fit) {
  return {{"median", fit.median},
          {"within_1mm", fit.within},
          {"behind", fit.behind},
          {"deepest", fit.deepest}};
}

void PutLandmarks(std::span<const LandmarkPair> pairs, const LandmarkAlignment& alignment,
                  Json& json) {
  json["verdict"] = ToString(alignment.verdict);
  json["sentence"] = alignment.sentence;
  if (alignment.is_aligned()) {
    json["pose"] = JsonOf(alignment.portal_from_tissue);
    json["rms"] = alignment.rms;
    json["position_sigma"] = alignment.position_sigma;
    json["rotation_sigma_deg"] = DegreesFromRadians(alignment.rotation_sigma);
    json["worst_rotation_sigma_deg"] = DegreesFromRadians(alignment.worst_rotation_sigma);
    json["scale_sigma"] = alignment.scale_sigma;
  }
  json["candidates"] = alignment.candidates;
  json["iterations"] = alignment.iterations;
  Json& landmarks = json["landmarks"] = Json::array();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const LandmarkResidual& residual = alignment.residuals[i];
    Json one{{"name", pairs[i].name}, {"used", residual.is_used}, {"wrong", residual.is_wrong}};
    if (alignment.is_aligned()) {
      one["residual"] = residual.distance;
      one["residual_px"] = residual.px ? Json(*residual.px) : Json();
    }
    one["range_guessed"] = pairs[i].scene.is_guessed;
    landmarks.push_back(std::move(one));
  }
  json["warnings"] = alignment.warnings;
}

}  // namespace

std::string AlignmentReport(const std::string& tissue, std::span<const LandmarkPair> pairs,
                            const std::optional<LandmarkAlignment>& landmarks,
                            const std::optional<SurfaceAlignment>& surface) {
  Json json{{"schema", "arthroscene.align/1"}, {"tissue", tissue}};
  if (landmarks) PutLandmarks(pairs, *landmarks, json);
  if (surface) {
    Json& own = json["surface"] = {{"aligned", surface->is_aligned},
                                   {"sentence", surface->sentence},
                                   {"steps", surface->steps},
                                   {"points", surface->points}};
    if (surface->is_aligned) {
      own["pose"] = JsonOf(surface->portal_from_tissue);
      own["rms"] = surface->kept_rms;
      own["before"] = JsonOf(surface->before);
      own["after"] = JsonOf(surface->after);
    }
  }
  return json.dump(2) + "\n";
}

}  // namespace arthro::authoring
