#include "authoring/alignment/align_report.h"

#include <numbers>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro::authoring {
namespace {

constexpr const char* kReportSchema = "arthroscene.align/1";
constexpr Range kDistance{0, 10}, kPart{0, 1}, kTurn{0, 2 * std::numbers::pi},
    kCount{0, 1'000'000'000};
const char* const kVerdicts[] = {"aligned", "too_few", "collinear", "inconsistent"};
const char* const kSides[] = {"front", "back"};

struct Warning {
  std::string sentence;
  template <class V>
  void Visit(V&& v) {
    v("sentence", sentence, Required{Any{}}, "", "What to look at, one sentence.");
  }
};

struct Residual {
  std::string name;
  bool is_used = false, is_wrong = false, is_range_guessed = false;
  std::optional<double> distance, px;
  template <class V>
  void Visit(V&& v) {
    v("name", name, Always{Any{}}, "", "Name of the landmark.");
    v("used", is_used, Required{Any{}}, "", "Whether the pair took part in the result.");
    v("wrong", is_wrong, Required{Any{}}, "", "Whether the pair was found to be wrong.");
    v("range_guessed", is_range_guessed, Required{Any{}}, "",
      "Whether the range of its partner was not measured.");
    v("residual", distance, kDistance, "m", "Distance of the partners after the alignment.");
    v("residual_px", px, Range{0, 1e6}, "px",
      "The same in the picture in which the partner was clicked.");
  }
};

struct Landmarks {
  std::string verdict, sentence;
  std::optional<double> rms, position_sigma, scale_sigma, rotation_sigma, worst_rotation_sigma;
  int candidates = 0, iterations = 0;
  std::vector<Residual> pairs;
  std::vector<Warning> warnings;
  template <class V>
  void Visit(V&& v) {
    v("verdict", verdict, Required{Words{kVerdicts}}, "", "Whether there is a result.");
    v("sentence", sentence, Required{Any{}}, "", "Result, or why there is none.");
    v("rms", rms, kDistance, "m", "Root mean square of the residuals in use.");
    v("position_sigma", position_sigma, kDistance, "m",
      "Standard error of the middle of the model.");
    v("rotation_sigma", rotation_sigma, kTurn, "rad", "Standard error of the rotation.");
    v("worst_rotation_sigma", worst_rotation_sigma, kTurn, "rad",
      "Standard error of the rotation about its least certain axis.");
    v("scale_sigma", scale_sigma, Range{0, 1e6}, "", "Standard error of the scale, as a ratio.");
    v("candidates", candidates, Required{kCount}, "", "Triples of pairs that were tried.");
    v("iterations", iterations, Required{kCount}, "", "Iterations of the robust fit.");
    v("pairs", pairs, Any{}, "", "Pairs in the order of the file.");
    v("warnings", warnings, Any{}, "", "Reasons to distrust the result.");
  }
};

struct FitInFile {
  double median = 0, within = 0, behind = 0, deepest = 0;
  template <class V>
  void Visit(V&& v) {
    v("median", median, Required{kDistance}, "m",
      "Median distance of the side that faces the portal from the relief.");
    v("within_1mm", within, Required{kPart}, "", "Share of that side within 1 mm.");
    v("behind", behind, Required{kPart}, "", "Share of that side behind the relief.");
    v("deepest", deepest, Required{kDistance}, "m", "Largest depth behind the relief.");
  }
};

struct Surface {
  bool is_aligned = false;
  std::string sentence, side;
  int steps = 0, points = 0;
  std::optional<double> rms;
  std::optional<FitInFile> before, after;
  template <class V>
  void Visit(V&& v) {
    v("aligned", is_aligned, Required{Any{}}, "", "Whether there is a result.");
    v("sentence", sentence, Required{Any{}}, "", "Result, or why there is none.");
    v("side", side, Required{Words{kSides}}, "",
      "Side that was laid onto the relief: the one that faces the portal, or the other one.");
    v("steps", steps, Required{kCount}, "", "Steps of the search.");
    v("points", points, Required{kCount}, "", "Points of the surface that took part.");
    v("rms", rms, kDistance, "m", "Root mean square of the distances that took part.");
    v("before", before, Any{}, "", "Distances before the search.");
    v("after", after, Any{}, "", "Distances after it.");
  }
};

// Describes the file; the parts that there are, are written one by one.
struct Report {
  std::string tissue;
  std::optional<Pose> pose;
  std::optional<Landmarks> landmarks;
  std::optional<Surface> surface;
  template <class V>
  void Visit(V&& v) {
    v("tissue", tissue, Required{Any{}}, "", "Name of the tissue.");
    v("pose", pose, Any{}, "", "Portal from tissue, after all that was aligned.");
    v("landmarks", landmarks, Any{}, "", "Alignment by pairs of landmarks.");
    v("surface", surface, Any{}, "", "Alignment of the surface, after that by pairs.");
  }
};

using Json = nlohmann::ordered_json;

// Writes optional structs too, which a FieldWriter does not.
struct PartWriter {
  Json& json;

  template <class T, class Rule>
  void operator()(const char* name, T& field, const Rule& rule, const char* unit,
                  const char* help) const {
    if constexpr (std::is_same_v<T, std::optional<FitInFile>>) {
      if (!field) return;
      Json& own = json[name] = Json::object();
      field->Visit(FieldWriter(own));
    } else {
      FieldWriter writer(json);
      writer(name, field, rule, unit, help);
    }
  }
};

template <class Part>
Json JsonOf(Part part) {
  Json json = Json::object();
  part.Visit(PartWriter{json});
  return json;
}

Landmarks PartOf(std::span<const LandmarkPair> pairs, const LandmarkAlignment& found) {
  Landmarks part;
  part.verdict = ToString(found.verdict);
  part.sentence = found.sentence;
  part.candidates = found.candidates;
  part.iterations = found.iterations;
  if (found.is_aligned()) {
    part.rms = found.rms;
    part.position_sigma = found.position_sigma;
    part.rotation_sigma = found.rotation_sigma;
    part.worst_rotation_sigma = found.worst_rotation_sigma;
    part.scale_sigma = found.scale_sigma;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const LandmarkResidual& residual = found.residuals[i];
    Residual& one = part.pairs.emplace_back();
    one.name = pairs[i].name;
    one.is_used = residual.is_used;
    one.is_wrong = residual.is_wrong;
    one.is_range_guessed = pairs[i].scene.is_guessed;
    if (!found.is_aligned()) continue;
    one.distance = residual.distance;
    one.px = residual.px;
  }
  for (const std::string& warning : found.warnings) part.warnings.push_back({warning});
  return part;
}

FitInFile PartOf(const ReliefFit& fit) { return {fit.median, fit.within, fit.behind, fit.deepest}; }

Surface PartOf(const SurfaceAlignment& found) {
  Surface part;
  part.is_aligned = found.is_aligned;
  part.sentence = found.sentence;
  part.side = ToString(found.side);
  part.steps = found.steps;
  part.points = found.points;
  if (!found.is_aligned) return part;
  part.rms = found.kept_rms;
  part.before = PartOf(found.before);
  part.after = PartOf(found.after);
  return part;
}

}  // namespace

std::string AlignReportText(const std::string& tissue, std::span<const LandmarkPair> pairs,
                            const std::optional<LandmarkAlignment>& landmarks,
                            const std::optional<SurfaceAlignment>& surface) {
  Json json{{"schema", kReportSchema}, {"tissue", tissue}};
  if (surface && surface->is_aligned)
    json["pose"] = JsonOf(surface->portal_from_tissue);
  else if (landmarks && landmarks->is_aligned())
    json["pose"] = JsonOf(landmarks->portal_from_tissue);
  if (landmarks) json["landmarks"] = JsonOf(PartOf(pairs, *landmarks));
  if (surface) json["surface"] = JsonOf(PartOf(*surface));
  return json.dump(2) + "\n";
}

std::string AlignReportSchemaText() {
  Json json = FileSchema(kReportSchema, "Arthroscene alignment report, version 1",
                         "What `arthroscene align --report` writes. Lengths in metres, angles in "
                         "degrees under keys that end in _deg.",
                         SchemaOfFields(Report()));
  json["definitions"]["quaternion"] = FieldDefinitions()["quaternion"];
  return PrettyJson(json);
}

}  // namespace arthro::authoring
