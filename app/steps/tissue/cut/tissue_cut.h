// The author's cuts and regions of a tissue: clicked onto it in the overview, one named step of the
// history each. What is chosen by a size in the joint is kept in the tissue's own frame.
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {

// Puts away whichever brush is up; a tear that was begun is forgotten.
void LeaveBrush(EditorState& state);
// Takes it up, or, where it is up, puts it away. A tear begins anew.
void ToggleCutBrush(EditorState& state, CutBrush::Kind kind);
// Applies the active brush to a click on a tissue: a point of a tear (from its second on
// the tear is there), a bite, a region. `x_in_tissue`: on its surface, in its own frame.
void UseCutBrush(EditorState& state, int tissue, const glm::dvec3& x_in_tissue);

// One of both is chosen at most.
void ChooseCut(EditorState& state, int cut);
void ChooseRegion(EditorState& state, int region);
const Cut* ChosenCut(const EditorState& state);        // null: none
const Region* ChosenRegion(const EditorState& state);  // null: none

// Sizes in m of the joint; of the chosen cut or region, and of the next.
void SetTearDepth(EditorState& state, double depth);
void SetTearWidth(EditorState& state, double width);
void SetBiteRadius(EditorState& state, double radius);
void SetRegionRadius(EditorState& state, double radius);
// An empty name, one that another region has, or the word for the rest is not taken.
void RenameRegion(EditorState& state, const std::string& name);

void RemoveChosenCut(EditorState& state);
void RemoveAllCuts(EditorState& state);
void RemoveChosenRegion(EditorState& state);

// "Tear 2: 3 points, 8.1 mm long": what a cut is called, and what more is to be said of it.
std::string CutName(const Tissue& tissue, int cut);
std::string CutWords(const Tissue& tissue, int cut);

}  // namespace arthro::app
