// Head of an attempt's log: the exercise and the scene that its frames belong to, so that a log
// without records can be judged, and one of another exercise is refused. It names no trainee.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro::simulation {

struct AttemptHead {
  std::string attempt, exercise, exercise_hash, scene, scene_fingerprint, mode, rig, started,
      program;
  std::vector<std::string> surfaces;
  template <class V>
  void Visit(V&& v) {
    v("attempt", attempt, Any{}, "", "UUID of the attempt.");
    v("exercise", exercise, Any{}, "", "Id of the exercise in its scene.");
    v("exercise_hash", exercise_hash, Any{}, "", "SHA-256 of the exercise in canonical JSON.");
    v("scene", scene, Any{}, "", "Title of the scene.");
    v("scene_fingerprint", scene_fingerprint, Any{}, "",
      "Fingerprint of the geometry of the scene (scene_of_attempt.h).");
    v("mode", mode, Any{}, "", "practice, test or robot.");
    v("rig", rig, Any{}, "", "Devices that held the hands.");
    v("started", started, Any{}, "", "Time in UTC.");
    v("program", program, Any{}, "", "Version of the program.");
    v("surfaces", surfaces, TextList{}, "",
      "Names of the backdrop and of each tissue, in the order of the contacts.");
  }
};

std::string AttemptHeadText(AttemptHead head);
// Throws Error(kBadData) for a text that is no head.
AttemptHead AttemptHeadOf(std::string_view text, const std::filesystem::path& file = {});

}  // namespace arthro::simulation
