// Faults of the chosen tissue's surface, found beside the window and kept those of the surface, and
// the two repairs of the Mesh page. m.
#pragma once

#include <functional>
#include <memory>

#include "app/state/editor_state.h"
#include "authoring/tissue/surface_faults.h"

namespace arthro::app {

struct Ui;

struct FaultBoard {
  explicit FaultBoard(std::function<void()> wake) : jobs(std::move(wake)) {}
  Jobs jobs;
  std::shared_ptr<const SurfaceMesh> of;  // surface that `found` is about
  std::shared_ptr<const authoring::SurfaceFaults> found;
  double thickness = 2e-3;  // m, of the layer that an open sheet becomes
};

// Starts the search that is wanted, if any, and takes over what ended. Once a frame; returns at
// once. True when something changed.
bool KeepFaultsFresh(EditorState& state);

// Faults of the chosen tissue's surface; null where they are not known yet.
std::shared_ptr<const authoring::SurfaceFaults> FaultsOfChosen(const EditorState& state);
// Those that the overview draws: of the chosen tissue while its Mesh page is open.
std::shared_ptr<const authoring::SurfaceFaults> ShownFaults(const EditorState& state);

bool CanMendTissue(const EditorState& state);
bool CanMakeLayer(const EditorState& state);
// One step of the history each; the tetrahedra are to be made anew.
void MendTissue(EditorState& state);
void MakeTissueLayer(EditorState& state);

// sRGB in which a kind of fault is drawn.
glm::dvec3 ColourOf(authoring::FaultKind kind);

void FaultFields(Ui& ui, EditorState& state);

}  // namespace arthro::app
