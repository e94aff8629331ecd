#include "simulation/scene/scene_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulation/core/json_text.h"
#include "simulation/core/units.h"
#include "simulation/scene/scene_limits.h"
#include "simulation/scene/scene_migration.h"
#include "simulation/scene/tissue_parts_json.h"

namespace arthro {
namespace {

using nlohmann::ordered_json;
using Reader = JsonObjectReader;

constexpr JsonLimits kViewAngle{0, 120, "degrees"};
constexpr JsonLimits kFieldOfView{0, 180, "degrees", true};
constexpr JsonLimits kScale{0, 1e6, "", true};
constexpr JsonLimits kShare{0, 1};
// 16384 is the widest picture (image_io.cpp); a projection's centre may lie well outside of it.
constexpr JsonLimits kPixel{-1e6, 1e6, "pixels"};
constexpr JsonLimits kFocal{0, 1e6, "pixels", true};
// Outside of these nothing can be computed with (simulation/tissue/fem/material.h).
constexpr JsonLimits kYoungModulus{1, 1e12, "pascals"};
constexpr JsonLimits kPoissonRatio{-0.9, 0.49999};
constexpr JsonLimits kDensity{1e-3, 1e6, "kg/m³"};
constexpr JsonLimits kFibreStiffness{0, 1e12, "pascals"};
constexpr const char* kFibreAxes[] = {"none", "circumferential_z"};
constexpr const char* kInstrumentKinds[] = {"probe", "punch", "shaver", "grasper"};
constexpr JsonLimits kPixelsPerDegree{0, 1e5, "pixels per degree", true};

void ReadRights(Reader& owner, AssetRights& rights) {
  owner.Object("rights", Reader::kOptional, [&](Reader& reader) {
    reader.Text("source", rights.source);
    reader.Text("licence", rights.licence);
    reader.Text("consent", rights.consent);
  });
}

void ReadProjection(Reader& reader, Projection& projection) {
  std::string type;
  reader.Text("type", type, Reader::kRequired);
  reader.Point("centre_px", projection.centre_px, kPixel, Reader::kRequired);
  if (type == "gnomonic") {
    projection.type = ProjectionType::kGnomonic;
    reader.Number("focal_px", projection.focal_px, kFocal, Reader::kRequired);
  } else if (type == "equirectangular") {
    projection.type = ProjectionType::kEquirectangular;
    reader.Number("px_per_deg", projection.px_per_deg, kPixelsPerDegree, Reader::kRequired);
  } else {
    if (!type.empty())
      reader.Fault("type", fmt::format("is {}; it must be \"gnomonic\" or \"equirectangular\"",
                                       nlohmann::json(type).dump()));
    // Both scales are known words here, so that one fault is not told as two.
    reader.Number("focal_px", projection.focal_px, kFocal);
    reader.Number("px_per_deg", projection.px_per_deg, kPixelsPerDegree);
  }
}

void ReadBackdrop(Reader& reader, Backdrop& backdrop) {
  reader.Path("panorama", backdrop.panorama, Reader::kRequired);
  reader.Path("depth", backdrop.depth);
  reader.Number("radius", backdrop.radius, kLength);
  reader.Number("relight", backdrop.relight, kShare);
  reader.Object("projection", Reader::kRequired,
                [&](Reader& inner) { ReadProjection(inner, backdrop.projection); });
  ReadRights(reader, backdrop.rights);
}

void ReadScope(Reader& reader, ScopeSpec& scope) {
  reader.Angle("view_angle_deg", scope.view_angle, kViewAngle);
  reader.Angle("field_of_view_deg", scope.field_of_view, kFieldOfView);
  reader.Number("rod_length", scope.rod_length, kLength);
  reader.Path("lens", scope.lens);
}

void ReadDeviceRig(Reader& reader, DeviceRig& rig) {
  reader.Point("pivot", rig.pivot, kCoordinate);
  reader.Quaternion("portal_from_device", rig.portal_from_device);
  reader.Number("rod_length", rig.rod_length, kLength);
}

// The scope's rod is told once, at scope.rod_length; a rig that repeats it must agree.
void ReadRig(Reader& reader, Rig& rig, double scope_rod_length) {
  rig.scope.rod_length = scope_rod_length;
  reader.Object("scope", Reader::kOptional, [&](Reader& scope) {
    ReadDeviceRig(scope, rig.scope);
    if (rig.scope.rod_length != scope_rod_length)
      scope.Fault("rod_length", fmt::format("is {} but scope.rod_length is {}; keep one of them",
                                            rig.scope.rod_length, scope_rod_length));
  });
  reader.Object("instrument", Reader::kOptional,
                [&](Reader& instrument) { ReadDeviceRig(instrument, rig.instrument); });
}

// A text that is one of a few words.
void ReadWord(Reader& reader, const char* name, std::string& field,
              std::span<const char* const> words) {
  std::string word = field;
  reader.Text(name, word);
  if (std::find(words.begin(), words.end(), word) != words.end())
    return void(field = std::move(word));
  reader.Fault(name, fmt::format("is {}; it must be one of: {}", nlohmann::json(word).dump(),
                                 fmt::join(words, ", ")));
}

void ReadElasticity(Reader& reader, Elasticity& elasticity) {
  const auto number = [&](const char* name, std::optional<double>& field,
                          const JsonLimits& limits) {
    double value = std::numeric_limits<double>::quiet_NaN();
    reader.Number(name, value, limits);
    if (!std::isnan(value)) field = value;
  };
  number("young_modulus", elasticity.young_modulus, kYoungModulus);
  number("poisson_ratio", elasticity.poisson_ratio, kPoissonRatio);
  number("density", elasticity.density, kDensity);
  number("fibre_stiffness", elasticity.fibre_stiffness, kFibreStiffness);
  std::string axis = kFibreAxes[0];
  ReadWord(reader, "fibre_axis", axis, kFibreAxes);
  if (reader.Has("fibre_axis")) elasticity.fibre_axis = axis;
  number("layer_thickness", elasticity.layer_thickness, kLength);
}

void ReadBalls(Reader& reader, const char* name, std::vector<Ball>& balls) {
  reader.Array(name, [&](Reader& inner, int) {
    Ball& ball = balls.emplace_back();
    inner.Point("centre", ball.centre, kCoordinate, Reader::kRequired);
    inner.Number("radius", ball.radius, kLength, Reader::kRequired);
  });
}

void ReadTissue(Reader& reader, Tissue& tissue) {
  reader.Text("name", tissue.name, Reader::kRequired);
  reader.Path("surface", tissue.surface, Reader::kRequired);
  reader.Path("mesh", tissue.mesh);
  reader.Object("pose", Reader::kOptional, [&](Reader& pose) {
    pose.Point("position", tissue.pose.position, kCoordinate);
    pose.Quaternion("quaternion", tissue.pose.quaternion);
    pose.Number("scale", tissue.pose.scale, kScale);
  });
  reader.Text("material", tissue.material);
  reader.Object("elasticity", Reader::kOptional,
                [&](Reader& inner) { ReadElasticity(inner, tissue.elasticity); });
  ReadBalls(reader, "fixed", tissue.fixed);
  ReadBalls(reader, "probed", tissue.probed);
  ReadCuts(reader, tissue.cuts);
  ReadRegions(reader, tissue.regions);
  reader.Flag("cuttable", tissue.is_cuttable);
  reader.Flag("implicit", tissue.is_implicit);
  if (tissue.is_implicit && !tissue.mesh.empty())
    reader.Fault("implicit", "is true of a tissue that has a mesh; leave out one of the two");
  reader.Point("colour", tissue.colour, kShare);
  ReadRights(reader, tissue.rights);
  // forces.csv tells contacts by these two words [method.md, File formats], one to a cell.
  if (tissue.name == "none" || tissue.name == "backdrop")
    reader.Fault("name", "is a word that force records use for something else; choose another");
  if (tissue.name.find_first_of(",\"\n\r") != std::string::npos)
    reader.Fault("name", "holds a comma, a quote or a line break, which tables cannot; remove it");
}

// A name that comes twice, where names tell elements apart.
void RequireUnique(Reader& reader, const char* name, const std::string& value,
                   std::set<std::string>& seen) {
  if (!value.empty() && !seen.insert(value).second)
    reader.Fault(name,
                 fmt::format("{} is used twice; give each its own", nlohmann::json(value).dump()));
}

// The shortest degrees that are read back as exactly these radians: 30, not 29.999999999999996.
double FileDegrees(double radians) {
  const double degrees = DegreesFromRadians(radians);
  if (!std::isfinite(degrees)) return degrees;
  for (int digits = 1; digits <= 16; ++digits) {
    const double candidate = std::stod(fmt::format("{:.{}g}", degrees, digits));
    if (RadiansFromDegrees(candidate) == radians) return candidate;
  }
  return degrees;
}

void PutText(ordered_json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

void PutRights(ordered_json& json, const AssetRights& rights) {
  ordered_json own = ordered_json::object();
  PutText(own, "source", rights.source);
  PutText(own, "licence", rights.licence);
  PutText(own, "consent", rights.consent);
  if (!own.empty()) json["rights"] = own;
}

ordered_json JsonFromBackdrop(const Backdrop& backdrop) {
  ordered_json json;
  json["panorama"] = backdrop.panorama.generic_string();
  PutText(json, "depth", backdrop.depth.generic_string());
  json["radius"] = backdrop.radius;
  if (backdrop.relight != 0) json["relight"] = backdrop.relight;
  const bool is_gnomonic = backdrop.projection.type == ProjectionType::kGnomonic;
  ordered_json& projection = json["projection"];
  projection["type"] = is_gnomonic ? "gnomonic" : "equirectangular";
  projection["centre_px"] = JsonFromPoint(backdrop.projection.centre_px);
  if (is_gnomonic)
    projection["focal_px"] = backdrop.projection.focal_px;
  else
    projection["px_per_deg"] = backdrop.projection.px_per_deg;
  PutRights(json, backdrop.rights);
  return json;
}

ordered_json JsonFromElasticity(const Elasticity& elasticity) {
  ordered_json json = ordered_json::object();
  const auto put = [&](const char* key, const auto& field) {
    if (field) json[key] = *field;
  };
  put("young_modulus", elasticity.young_modulus);
  put("poisson_ratio", elasticity.poisson_ratio);
  put("density", elasticity.density);
  put("fibre_stiffness", elasticity.fibre_stiffness);
  PutText(json, "fibre_axis", elasticity.fibre_axis);
  put("layer_thickness", elasticity.layer_thickness);
  return json;
}

ordered_json JsonFromTissue(const Tissue& tissue) {
  ordered_json json;
  json["name"] = tissue.name;
  json["surface"] = tissue.surface.generic_string();
  PutText(json, "mesh", tissue.mesh.generic_string());
  json["pose"]["position"] = JsonFromPoint(tissue.pose.position);
  json["pose"]["quaternion"] = JsonFromQuaternion(tissue.pose.quaternion);
  json["pose"]["scale"] = tissue.pose.scale;
  json["material"] = tissue.material;
  if (const ordered_json elasticity = JsonFromElasticity(tissue.elasticity); !elasticity.empty())
    json["elasticity"] = elasticity;
  const auto put_balls = [&](const char* key, const std::vector<Ball>& balls) {
    for (const Ball& ball : balls)
      json[key].push_back({{"centre", JsonFromPoint(ball.centre)}, {"radius", ball.radius}});
  };
  put_balls("fixed", tissue.fixed);
  put_balls("probed", tissue.probed);
  for (const Cut& cut : tissue.cuts) json["cuts"].push_back(JsonFromCut(cut));
  for (const Region& region : tissue.regions) json["regions"].push_back(JsonFromRegion(region));
  if (!tissue.is_cuttable) json["cuttable"] = false;
  if (tissue.is_implicit) json["implicit"] = true;
  json["colour"] = JsonFromPoint(tissue.colour);
  PutRights(json, tissue.rights);
  return json;
}

void Print(const ordered_json& json, std::size_t indent, std::string& text) {
  const bool is_short_list =
      json.is_array() && std::none_of(json.begin(), json.end(),
                                      [](const auto& element) { return element.is_structured(); });
  if (json.empty() || !json.is_structured()) {
    text += json.dump();
    return;
  }
  text += json.is_array() ? '[' : '{';
  bool is_first = true;
  for (const auto& [key, value] : json.items()) {
    if (!is_first) text += is_short_list ? ", " : ",";
    is_first = false;
    if (!is_short_list) text += '\n' + std::string(indent + 2, ' ');
    if (json.is_object()) text += ordered_json(key).dump() + ": ";
    Print(value, indent + 2, text);
  }
  if (!is_short_list) text += '\n' + std::string(indent, ' ');
  text += json.is_array() ? ']' : '}';
}

}  // namespace

Scene SceneFromJson(const nlohmann::json& json, std::vector<JsonFault>& faults) {
  Scene scene;
  Reader reader(json, "", faults);
  std::string schema;
  reader.Text("schema", schema);
  reader.Text("title", scene.title);
  reader.Text("author", scene.author);
  reader.Object("backdrop", Reader::kRequired,
                [&](Reader& inner) { ReadBackdrop(inner, scene.backdrop); });
  reader.Object("scope", Reader::kOptional, [&](Reader& inner) { ReadScope(inner, scene.scope); });
  reader.Object("portals", Reader::kOptional, [&](Reader& inner) {
    inner.Number("incision_spacing", scene.portals.incision_spacing, kCoordinate);
  });
  scene.rig.scope.rod_length = scene.scope.rod_length;
  reader.Object("rig", Reader::kOptional,
                [&](Reader& inner) { ReadRig(inner, scene.rig, scene.scope.rod_length); });
  std::set<std::string> tissue_names, task_ids;
  reader.Array("tissues", [&](Reader& inner, int) {
    ReadTissue(inner, scene.tissues.emplace_back());
    RequireUnique(inner, "name", scene.tissues.back().name, tissue_names);
  });
  reader.Array("instruments", [&](Reader& inner, int) {
    Instrument& instrument = scene.instruments.emplace_back();
    inner.Text("name", instrument.name, Reader::kRequired);
    ReadWord(inner, "kind", instrument.kind, kInstrumentKinds);
  });
  reader.Array("tasks", [&](Reader& inner, int) {
    Task& task = scene.tasks.emplace_back();
    inner.Text("id", task.id, Reader::kRequired);
    inner.Text("title", task.title);
    inner.Text("text", task.text);
    RequireUnique(inner, "id", task.id, task_ids);
  });
  reader.RefuseOtherKeys(true);
  for (const auto& [key, value] : json.items())
    if (key.starts_with("x-")) scene.extensions[key] = value.dump();
  return scene;
}

ordered_json JsonFromScene(const Scene& scene) {
  ordered_json json;
  json["schema"] = SceneSchemaName(kSceneVersion);
  PutText(json, "title", scene.title);
  PutText(json, "author", scene.author);
  json["backdrop"] = JsonFromBackdrop(scene.backdrop);
  json["scope"]["view_angle_deg"] = FileDegrees(scene.scope.view_angle);
  json["scope"]["field_of_view_deg"] = FileDegrees(scene.scope.field_of_view);
  json["scope"]["rod_length"] = scene.scope.rod_length;
  PutText(json["scope"], "lens", scene.scope.lens.generic_string());
  json["portals"]["incision_spacing"] = scene.portals.incision_spacing;
  for (const auto& [name, rig] :
       {std::pair{"scope", &scene.rig.scope}, std::pair{"instrument", &scene.rig.instrument}}) {
    ordered_json& own = json["rig"][name];
    own["pivot"] = JsonFromPoint(rig->pivot);
    own["portal_from_device"] = JsonFromQuaternion(rig->portal_from_device);
    if (rig == &scene.rig.instrument) own["rod_length"] = rig->rod_length;
  }
  for (const Tissue& tissue : scene.tissues) json["tissues"].push_back(JsonFromTissue(tissue));
  for (const Instrument& instrument : scene.instruments)
    json["instruments"].push_back({{"name", instrument.name}, {"kind", instrument.kind}});
  for (const Task& task : scene.tasks) {
    ordered_json own{{"id", task.id}};
    PutText(own, "title", task.title);
    PutText(own, "text", task.text);
    json["tasks"].push_back(own);
  }
  for (const auto& [key, text] : scene.extensions)
    json[key] = ParseOrderedJson(text, Code::kBadScene);
  return json;
}

std::string PrettyJson(const ordered_json& json) {
  std::string text;
  Print(json, 0, text);
  return text + "\n";
}

}  // namespace arthro
