// Scene of an attempt: a fingerprint of all that its frames depend on, and the check that frames
// are read in the scene and at the exercise in which they were observed.
#pragma once

#include <string>

#include "simulation/scene/files/loaded_scene.h"
#include "simulation/training/attempt_head.h"

namespace arthro::simulation {

// Fingerprint (core/fingerprint.h) of the geometry that scope and instrument meet: backdrop, depth
// map, scope, lens, portals and tissues. Title, rights, pictures, mounts and exercises are no part.
std::string FingerprintOfScene(const LoadedScene& loaded);

// Whether the frames of an attempt were observed in this scene. Heads of older programs have no
// fingerprint: then title and surfaces decide.
bool IsOfScene(const AttemptHead& head, const LoadedScene& loaded);

// One sentence about why the frames of an attempt are not those of this exercise in this scene, and
// what to do; empty: they are.
std::string WhyAnotherScene(const AttemptHead& head, const LoadedScene& loaded,
                            const Exercise& exercise);

}  // namespace arthro::simulation
