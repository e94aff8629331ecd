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

std::optional<TargetPlace> PlaceOfRegions(const LoadedScene& loaded, int tissue,
                                          const ExerciseTarget& target) {
  if (tissue < 0) return std::nullopt;
  const Tissue& owner = loaded.scene.tissues[static_cast<std::size_t>(tissue)];
  std::optional<TargetPlace> place;
  for (const std::string& name : target.regions) {
    const auto region = std::find_if(owner.regions.begin(), owner.regions.end(),
                                     [&](const Region& each) { return each.name == name; });
    if (region == owner.regions.end()) return std::nullopt;
    if (!place) place = TargetInBall(owner.pose * region->ball.centre, region->ball.radius);
    place->regions.push_back(static_cast<int>(region - owner.regions.begin()));
  }
  if (place) place->region_tissue = tissue;
  return place;
}

std::optional<TargetPlace> PlaceOf(const LoadedScene& loaded, const DepthField& relief,
                                   const ExerciseTarget& target) {
  const int tissue = TissueOf(loaded.scene, target.on);
  switch (KindOf(target)) {
    case TargetKind::kBearing:
      return TargetOnBearing(loaded, relief, target.bearing->x, target.bearing->y, target.radius);
    case TargetKind::kPoint:
      if (tissue < 0) return std::nullopt;
      return TargetOnTissue(loaded, tissue, *target.point, target.radius);
    case TargetKind::kBall:
      return TargetInBall(*target.ball, target.radius);
    case TargetKind::kRegions:
      return PlaceOfRegions(loaded, tissue, target);
  }
  return std::nullopt;
}

}  // namespace

std::vector<TargetPlace> PlacesOfTargets(const LoadedScene& loaded, const Exercise& exercise) {
  return PlacesOfTargets(loaded, exercise, ReliefOf(loaded));
}

std::vector<TargetPlace> PlacesOfTargets(const LoadedScene& loaded, const Exercise& exercise,
                                         const DepthField& relief) {
  std::vector<TargetPlace> places;
  for (const ExerciseTarget& target : exercise.targets) {
    const auto place = PlaceOf(loaded, relief, target);
    if (!place)
      throw Error(Code::kBadScene,
                  fmt::format("target \"{}\" of exercise \"{}\" lies on no surface of this scene; "
                              "place it again",
                              target.id, exercise.id));
    places.push_back(*place);
    places.back().is_loose = target.is_loose;
  }
  for (const ExerciseStep& step : exercise.steps)
    if (const auto* transfer = std::get_if<TransferStep>(&step))
      for (std::size_t i = 0; i < places.size(); ++i)
        if (exercise.targets[i].id == transfer->to) places[i].keeps_bodies = true;
  return places;
}

}  // namespace arthro::simulation
