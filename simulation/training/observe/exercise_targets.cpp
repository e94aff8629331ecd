#include "simulation/training/observe/exercise_targets.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::simulation {
namespace {

int TissueOf(const Scene& scene, const std::string& name) {
  const auto& tissues = scene.tissues;
  const auto found = std::find_if(tissues.begin(), tissues.end(),
                                  [&](const Tissue& tissue) { return tissue.name == name; });
  return found == tissues.end() ? -1 : static_cast<int>(found - tissues.begin());
}

std::optional<TargetPlace> PlaceOfRegion(const LoadedScene& loaded, int tissue,
                                         const ExerciseTarget& target) {
  if (tissue < 0) return std::nullopt;
  const Tissue& owner = loaded.scene.tissues[static_cast<std::size_t>(tissue)];
  for (const Region& region : owner.regions)
    if (region.name == target.regions.front())
      return TargetInBall(owner.pose * region.ball.centre, region.ball.radius);
  return std::nullopt;
}

std::optional<TargetPlace> PlaceOf(const LoadedScene& loaded, const ExerciseTarget& target) {
  const int tissue = TissueOf(loaded.scene, target.on);
  switch (KindOf(target)) {
    case TargetKind::kBearing:
      return TargetOnBearing(loaded, target.bearing->x, target.bearing->y, target.radius);
    case TargetKind::kPoint:
      if (tissue < 0) return std::nullopt;
      return TargetOnTissue(loaded, tissue, *target.point, target.radius);
    case TargetKind::kBall:
      return TargetInBall(*target.ball, target.radius);
    case TargetKind::kRegions:
      return target.regions.empty() ? std::nullopt : PlaceOfRegion(loaded, tissue, target);
  }
  return std::nullopt;
}

}  // namespace

std::vector<TargetPlace> PlacesOfTargets(const LoadedScene& loaded, const Exercise& exercise) {
  std::vector<TargetPlace> places;
  for (const ExerciseTarget& target : exercise.targets) {
    const auto place = PlaceOf(loaded, target);
    if (!place)
      throw Error(Code::kBadScene,
                  fmt::format("target \"{}\" of exercise \"{}\" lies on no surface of this scene; "
                              "place it again",
                              target.id, exercise.id));
    places.push_back(*place);
  }
  return places;
}

}  // namespace arthro::simulation
