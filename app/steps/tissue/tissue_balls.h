// Places of the chosen tissue as balls in its own frame: where it is held, and where it is probed,
// so that its mesh is finer there. The author puts them onto it, one named step each. A new mesh
// keeps them.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

const std::vector<Ball>& BallsOf(const Tissue& tissue, BallKind kind);

// A ball of state.steps.tissue->ball_radius about a place of the tissue's own frame; it becomes the
// chosen one.
void AddBall(EditorState& state, BallKind kind, int tissue, const glm::dvec3& x_in_tissue);
// The same where the tip of the author's instrument is.
void AddBallAtInstrument(EditorState& state, BallKind kind);
void SetBall(EditorState& state, BallKind kind, int tissue, int index, const Ball& ball,
             const std::string& what);
void RemoveChosenBall(EditorState& state, BallKind kind);
void RemoveAllBalls(EditorState& state, BallKind kind);

bool HasChosenBall(const EditorState& state, BallKind kind);
bool HasBalls(const EditorState& state, BallKind kind);

// The kind that a page of the Tissue panel is about, if any.
std::optional<BallKind> BallKindOf(TissuePage page);

}  // namespace arthro::app
