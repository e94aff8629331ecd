// Pictures of an attempt's report, drawn without a window.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/report/attempt_report.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/tissue_look.h"
#include "simulation/training/track/track_piece.h"

namespace arthro::app {

// Sets the pictures of a report whose frames were observed in this scene. Returns why it has none,
// a sentence without a period; empty: it has them, or no moment to show.
std::string SetPictures(AttemptReport& report, const LoadedScene& loaded,
                        std::span<const simulation::TissueLook> looks);

// Draws the moments from the lens of the scope, with tissue as it was where `track` has it.
// `targets`: of the exercise; the loose ones are bodies. `looks`: one per tissue, or none. Throws
// Error(kDisplay) when nothing can draw, and Error for a scene that cannot be drawn.
std::vector<ReportPicture> DrawMoments(const LoadedScene& loaded,
                                       std::span<const simulation::TissueLook> looks,
                                       std::span<const simulation::AttemptFrame> frames,
                                       std::span<const ExerciseTarget> targets,
                                       std::vector<simulation::TrackPiece> track,
                                       std::span<const ReportMoment> moments);

}  // namespace arthro::app
