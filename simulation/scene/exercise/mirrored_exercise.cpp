#include "simulation/scene/exercise/mirrored_exercise.h"

namespace arthro {
namespace {

// 0 - 0 is 0, where -0 would change the file.
double Negated(double value) { return 0.0 - value; }

}  // namespace

Exercise Mirrored(Exercise exercise) {
  for (ExerciseTarget& target : exercise.targets) {
    if (target.bearing) target.bearing->y = Negated(target.bearing->y);
    if (target.point) target.point->x = Negated(target.point->x);
    if (target.ball) target.ball->x = Negated(target.ball->x);
  }
  StartPose& scope = exercise.setup.scope;
  scope.longitude = Negated(scope.longitude);
  scope.roll = Negated(scope.roll);
  if (auto& spacing = exercise.setup.incision_spacing) spacing = Negated(*spacing);
  exercise.ghost.clear();
  return exercise;
}

}  // namespace arthro
