#include "simulation/scene/tissue_parts_json.h"

#include <set>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/scene/scene_limits.h"

namespace arthro {
namespace {

using nlohmann::ordered_json;
using Reader = JsonObjectReader;

constexpr JsonLimits kLead{0, 2, "metres"};
// A tear is clicked point by point; a path of more is no tear but a mistake.
constexpr int kMostPoints = 1000;

void ReadCapsule(Reader& reader, CapsuleCut& cut) {
  reader.Point("a", cut.a, kCoordinate, Reader::kRequired);
  reader.Point("b", cut.b, kCoordinate, Reader::kRequired);
  reader.Number("radius", cut.radius, kLength, Reader::kRequired);
}

void ReadBox(Reader& reader, BoxCut& cut) {
  reader.Point("centre", cut.rest_from_box.translation, kCoordinate, Reader::kRequired);
  reader.Quaternion("quaternion", cut.rest_from_box.rotation);
  reader.Point("half", cut.half, kLength, Reader::kRequired);
}

void ReadTear(Reader& reader, TearCut& cut) {
  reader.Points("path", cut.path, 2, kMostPoints, kCoordinate);
  reader.Point("into", cut.into, kCoordinate, Reader::kRequired);
  if (!(glm::length(cut.into) > 0.0))
    reader.Fault("into", "is [0, 0, 0]; a direction cannot be all zeros");
  reader.Number("depth", cut.depth, kLength, Reader::kRequired);
  reader.Number("width", cut.width, kLength);
  reader.Number("lead", cut.lead, kLead);
}

}  // namespace

void ReadCuts(Reader& tissue, std::vector<Cut>& cuts) {
  tissue.Array("cuts", [&](Reader& reader, int) {
    std::string type;
    reader.Text("type", type, Reader::kRequired);
    if (type == "capsule")
      ReadCapsule(reader, std::get<CapsuleCut>(cuts.emplace_back(CapsuleCut{})));
    else if (type == "box")
      ReadBox(reader, std::get<BoxCut>(cuts.emplace_back(BoxCut{})));
    else if (type == "tear")
      ReadTear(reader, std::get<TearCut>(cuts.emplace_back(TearCut{})));
    else {
      if (!type.empty())
        reader.Fault("type", fmt::format("is {}; it must be one of: capsule, box, tear",
                                         nlohmann::json(type).dump()));
      // The words of all of them are known here, so that one fault is not told as several.
      for (const char* name : {"a", "b", "radius", "centre", "quaternion", "half", "path", "into",
                               "depth", "width", "lead"})
        reader.Know(name);
    }
  });
}

void ReadRegions(Reader& tissue, std::vector<Region>& regions) {
  std::set<std::string> names;
  tissue.Array("regions", [&](Reader& reader, int) {
    Region& region = regions.emplace_back();
    reader.Text("name", region.name, Reader::kRequired);
    reader.Point("centre", region.ball.centre, kCoordinate, Reader::kRequired);
    reader.Number("radius", region.ball.radius, kLength, Reader::kRequired);
    if (region.name == kElsewhere)
      reader.Fault("name", "is the word for what lies in no region; choose another");
    if (!region.name.empty() && !names.insert(region.name).second)
      reader.Fault("name", fmt::format("{} is used twice; give each its own",
                                       nlohmann::json(region.name).dump()));
  });
}

ordered_json JsonFromCut(const Cut& cut) {
  if (const auto* capsule = std::get_if<CapsuleCut>(&cut))
    return {{"type", "capsule"},
            {"a", JsonFromPoint(capsule->a)},
            {"b", JsonFromPoint(capsule->b)},
            {"radius", capsule->radius}};
  if (const auto* box = std::get_if<BoxCut>(&cut))
    return {{"type", "box"},
            {"centre", JsonFromPoint(box->rest_from_box.translation)},
            {"quaternion", JsonFromQuaternion(box->rest_from_box.rotation)},
            {"half", JsonFromPoint(box->half)}};
  const auto& tear = std::get<TearCut>(cut);
  ordered_json json{{"type", "tear"}, {"path", ordered_json::array()}};
  for (const glm::dvec3& x : tear.path) json["path"].push_back(JsonFromPoint(x));
  json["into"] = JsonFromPoint(tear.into);
  json["depth"] = tear.depth;
  json["width"] = tear.width;
  json["lead"] = tear.lead;
  return json;
}

ordered_json JsonFromRegion(const Region& region) {
  return {{"name", region.name},
          {"centre", JsonFromPoint(region.ball.centre)},
          {"radius", region.ball.radius}};
}

}  // namespace arthro
