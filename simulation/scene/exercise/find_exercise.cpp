#include "simulation/scene/exercise/find_exercise.h"

#include <algorithm>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro {

const Exercise& ExerciseWithId(const std::vector<Exercise>& exercises, const std::string& id) {
  const auto found = std::ranges::find(exercises, id, &Exercise::id);
  if (found != exercises.end()) return *found;
  std::string ids;
  for (const Exercise& exercise : exercises) ids += (ids.empty() ? "" : ", ") + exercise.id;
  throw Error(
      Code::kBadArgument,
      exercises.empty()
          ? fmt::format("the scene has no exercises, so none is called {}; add one in the editor",
                        id)
          : fmt::format("the scene has no exercise {}; it has {}", id, ids));
}

}  // namespace arthro
