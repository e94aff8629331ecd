#include "simulation/training/observe/taken_tissue.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/practice/living_tissues.h"

namespace arthro::simulation {
namespace {

// Triangles of a skin that lie near the balls that hold it.
SurfaceMesh WallOf(SurfaceMesh skin, std::span<const Ball> fixed) {
  const auto is_wall = [&](int vertex) {
    const glm::dvec3& x = skin.vertices[static_cast<std::size_t>(vertex)];
    return std::ranges::any_of(fixed, [&](const Ball& ball) {
      return glm::distance(x, ball.centre) <= ball.radius + kWallReach;
    });
  };
  std::erase_if(skin.triangles,
                [&](const auto& triangle) { return !std::ranges::all_of(triangle, is_wall); });
  return skin;
}

double At(std::span<const double> volumes, std::size_t index) {
  return index < volumes.size() ? volumes[index] : 0.0;
}

}  // namespace

TakenTissue::TakenTissue(const LoadedScene& loaded, std::span<const TargetPlace> targets) {
  for (const TargetPlace& target : targets) {
    targets_.push_back({target.region_tissue, target.regions});
    if (target.region_tissue < 0) continue;
    const auto tissue = static_cast<std::size_t>(target.region_tissue);
    const BodyPlaces places =
        PlacesOf(loaded.scene.tissues.at(tissue), OrEmpty(loaded.surfaces.at(tissue)));
    auto known = std::find_if(trimmed_.begin(), trimmed_.end(), [&](const Trimmed& each) {
      return each.tissue == target.region_tissue;
    });
    if (known == trimmed_.end()) {
      known = trimmed_.insert(trimmed_.end(), Trimmed());
      known->tissue = target.region_tissue;
      const SurfaceMesh wall = WallOf(places.surface, places.fixed);
      if (!wall.triangles.empty()) known->wall = std::make_unique<SurfaceFinder>(wall);
    }
    for (const int region : target.regions)
      known->regions.push_back(places.regions.at(static_cast<std::size_t>(region)).ball);
  }
}

void TakenTissue::MeasureFaces(const std::shared_ptr<const BodySkin>& skin, Trimmed& trimmed) {
  trimmed.skin = skin;
  trimmed.rim = -1;
  trimmed.squares = 0;
  trimmed.vertices = 0;
  for (std::size_t v = 0; v < skin->is_fresh.size(); ++v) {
    if (skin->is_fresh[v] == 0) continue;
    const glm::dvec3& x = skin->surface.vertices[v];
    double off = std::numeric_limits<double>::infinity();
    for (const Ball& ball : trimmed.regions)
      off = std::min(off, std::abs(glm::distance(x, ball.centre) - ball.radius));
    trimmed.squares += off * off;
    ++trimmed.vertices;
    if (trimmed.wall == nullptr) continue;
    // Only a point that is nearer than the nearest so far is of interest.
    const double reach = trimmed.rim < 0 ? std::numeric_limits<double>::infinity() : trimmed.rim;
    if (const SurfacePoint on = trimmed.wall->Find(x, reach); on.triangle >= 0)
      trimmed.rim = glm::distance(on.place, x);
  }
}

void TakenTissue::Measure(const WorldPicture* world, AttemptFrame& frame) {
  if (world == nullptr) return;
  double removed = 0, inside = 0;
  for (const BodyPicture& body : world->bodies) {
    removed += body.cut.removed;
    for (Trimmed& trimmed : trimmed_)
      if (trimmed.tissue == body.tissue && body.skin != nullptr && body.cut.cuts > 0 &&
          trimmed.skin != body.skin)
        MeasureFaces(body.skin, trimmed);
    std::vector<std::size_t> counted;  // a region of two targets counts once
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const Target& target = targets_[i];
      if (target.tissue != body.tissue) continue;
      double taken = 0, volume = 0;
      for (const int number : target.regions) {
        const auto region = static_cast<std::size_t>(number);
        taken += At(body.cut.by_region, region);
        volume += At(body.cut.volume_by_region, region);
        if (std::ranges::find(counted, region) != counted.end()) continue;
        counted.push_back(region);
        inside += At(body.cut.by_region, region);
      }
      if (volume > 0) frame.sight.target[i].taken_share = static_cast<float>(taken / volume);
    }
  }
  frame.taken = static_cast<float>(std::max(0.0, removed - removed_));
  frame.taken_outside = static_cast<float>(std::max(0.0, removed - inside - outside_));
  removed_ = removed;
  outside_ = removed - inside;
  double squares = 0;
  std::size_t vertices = 0;
  for (const Trimmed& trimmed : trimmed_) {
    squares += trimmed.squares;
    vertices += trimmed.vertices;
    if (trimmed.rim >= 0 && (frame.rim < 0 || trimmed.rim < static_cast<double>(frame.rim)))
      frame.rim = static_cast<float>(trimmed.rim);
  }
  if (vertices > 0)
    frame.contour = static_cast<float>(std::sqrt(squares / static_cast<double>(vertices)));
}

}  // namespace arthro::simulation
