#include "authoring/models/model_thumbnail.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/surface_simplify.h"

namespace arthro::authoring {

ModelThumbnail ThumbnailOf(const SurfaceMesh& surface, std::span<const Cut> cuts,
                           int most_triangles) {
  ModelThumbnail thumbnail;
  if (surface.triangles.empty()) return thumbnail;
  SurfaceMesh simple = surface;
  SimplifyEvenly(simple, most_triangles, [](const glm::dvec3&) { return 1.0; });
  // From the front and above, a little from the side.
  const glm::dvec3 to_eye = glm::normalize(glm::dvec3(0.25, -0.75, 0.85));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), to_eye));
  const glm::dvec3 up = glm::cross(to_eye, right);
  const glm::dvec3 to_lamp = glm::normalize(to_eye + 0.5 * up - 0.3 * right);
  const auto flat = [&](const glm::dvec3& x) {
    return glm::dvec2(glm::dot(x, right), -glm::dot(x, up));
  };
  glm::dvec2 low(1e9), high(-1e9);
  for (const glm::dvec3& x : simple.vertices) {
    low = glm::min(low, flat(x));
    high = glm::max(high, flat(x));
  }
  const double size = 1.06 * std::max(high.x - low.x, high.y - low.y);
  const glm::dvec2 corner = 0.5 * (low + high - size);
  const auto place = [&](const glm::dvec3& x) {
    return size > 0 ? glm::vec2((flat(x) - corner) / size) : glm::vec2(0.5f);
  };
  std::vector<std::pair<double, ModelThumbnail::Facet>> seen;
  for (const auto& [a, b, c] : simple.triangles) {
    const auto &x = simple.vertices[a], &y = simple.vertices[b], &z = simple.vertices[c];
    const glm::dvec3 across = glm::cross(y - x, z - x);
    if (!(glm::dot(across, to_eye) > 0)) continue;
    const double light = 0.25 + 0.75 * std::max(0.0, glm::dot(glm::normalize(across), to_lamp));
    seen.push_back(
        {glm::dot(x + y + z, to_eye), {{place(x), place(y), place(z)}, static_cast<float>(light)}});
  }
  std::ranges::stable_sort(seen, {}, &std::pair<double, ModelThumbnail::Facet>::first);
  for (auto& entry : seen) thumbnail.facets.push_back(entry.second);
  for (const Cut& cut : cuts)
    if (const auto* tear = std::get_if<TearCut>(&cut)) {
      auto& path = thumbnail.tears.emplace_back();
      for (const glm::dvec3& x : tear->path) path.push_back(place(x));
    }
  return thumbnail;
}

}  // namespace arthro::authoring
