// Text of one exercise outside its scene, and the hash by which records tell whether an exercise is
// the same as before.
#pragma once

#include <string>
#include <string_view>

#include "simulation/scene/exercise/exercise.h"

namespace arthro {

// JSON on one line with the keys in alphabetical order: the same for the same exercise, whatever
// the order of its keys in scene.json was. The recording of an expert is left out: it asks for
// nothing, and one is made of the exercise as it stands.
std::string CanonicalJson(Exercise exercise);

// The exercise of such a text. Throws Error(kBadData) with the first fault.
Exercise ExerciseFromJson(std::string_view text);

// SHA-256 of the canonical JSON.
std::string HashOf(const Exercise& exercise);

}  // namespace arthro
