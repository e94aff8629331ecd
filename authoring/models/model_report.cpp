#include "authoring/models/model_report.h"

#include <glm/geometric.hpp>

#include "authoring/tissue/surface/surface_check.h"
#include "simulation/core/json_text.h"
#include "simulation/core/options_json.h"

namespace arthro::authoring {
namespace {

// Area of each part; a triangle counts for the part of its first corner.
nlohmann::json AreasOf(const LibraryModel& model, const ModelParts& parts) {
  nlohmann::json areas = nlohmann::json::object();
  if (parts.of_vertex.empty()) return areas;
  std::vector<double> area(parts.names.size(), 0.0);
  const auto& x = model.surface.vertices;
  for (const auto& [a, b, c] : model.surface.triangles)
    area[parts.of_vertex[static_cast<std::size_t>(a)]] +=
        0.5 * glm::length(glm::cross(x[b] - x[a], x[c] - x[a]));
  for (std::size_t i = 0; i < area.size(); ++i) areas[parts.names[i]] = area[i];
  return areas;
}

}  // namespace

std::string ModelReportText(const LibraryModel& model, const ModelOptions& options, KneeSide side,
                            const std::vector<Cut>& cuts, double removed) {
  const SurfaceCheck check = CheckSurface(model.surface);
  nlohmann::json sizes = nlohmann::json::array();
  for (const MeasuredSize& size : model.sizes) {
    const PublishedSize& published = *size.published;
    nlohmann::json source = {{"author", published.source->author},
                             {"title", published.source->title},
                             {"where", published.source->where}};
    if (published.source->year != 0) source["year"] = published.source->year;
    sizes.push_back({{"quantity", published.quantity},
                     {"measured", size.value},
                     {"published", published.mean},
                     {"range", {published.least, published.most}},
                     {"is_in_range", size.IsInRange()},
                     {"source", source}});
  }
  nlohmann::json regions = nlohmann::json::array();
  for (const Region& region : model.regions) {
    const glm::dvec3& centre = region.ball.centre;
    regions.push_back({{"name", region.name},
                       {"centre", {centre.x, centre.y, centre.z}},
                       {"radius", region.ball.radius}});
  }
  const nlohmann::json json = {
      {"schema", "arthroscene.model/1"},
      {"model", model.name},
      {"side", side == KneeSide::kLeft ? "left" : "right"},
      {"options", std::visit([](auto chosen) { return JsonFromOptions(chosen); }, options)},
      {"material", model.material},
      {"is_solid", model.is_solid},
      {"vertices", check.vertices},
      {"triangles", check.triangles},
      {"volume", check.volume},
      {"area", check.area},
      {"is_closed", check.IsClosedManifold()},
      {"self_intersections", check.self_intersections.count},
      {"sizes", sizes},
      {"area_of_thirds", AreasOf(model, model.thirds)},
      {"area_of_zones", AreasOf(model, model.zones)},
      {"regions", regions},
      {"holds", model.fixed.size()},
      {"cuts", cuts.size()},
      {"volume_of_cuts", removed},
  };
  return json.dump(2) + "\n";
}

}  // namespace arthro::authoring
