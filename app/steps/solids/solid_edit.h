// The author's solids: tissues given by functions (simulation/scene/solids/solid.h). Every change
// of the chosen one is a named step of the history. It goes into a new file of the scratch folder,
// so that earlier steps go on to name the earlier files.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/state/command.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/solids/solid.h"

namespace arthro::app {

struct SolidEditing {
  int part = 0;       // chosen part
  std::string fault;  // why the last change was not made; empty: it was
  // The chosen solid as its file has it, read again when its surface is another one.
  Solid solid;
  std::weak_ptr<const SurfaceMesh> read_of;
  bool is_coarse = false;            // true while its surface is that of a slider that is held
  std::optional<SolidPart> dragged;  // chosen part when the drag of its handle began
  // Surface of the chosen part alone, and what it was made of.
  SharedSurface part_surface;
  std::optional<SolidPart> part_of;
};

// True where the chosen tissue is given by functions.
bool IsSolidChosen(const EditorState& state);
// The chosen solid; null where none is chosen or its file cannot be read, which `fault` says.
const Solid* ChosenSolid(EditorState& state);

// Adds a ball as a new tissue on the relief in the middle of the view.
void AddSolid(EditorState& state);
// Adds a part beside the chosen one, and chooses it.
void AddSolidPart(EditorState& state, SolidPart part);
void RemoveSolidPart(EditorState& state);
void MoveSolidPart(EditorState& state, int by);  // −1: one place up the list
// Puts `changed` in place of the chosen part. While a slider is held its surface is coarse; the
// call after it was let go makes the fine one. A change that leaves no fit solid is not made.
void SetSolidPart(EditorState& state, const SolidPart& changed, const std::string& what);

// Surface of the chosen part about its own centre, and its pose; null where it has none to show: no
// solid is chosen, or its page is not open.
struct PartInPortal {
  SharedSurface surface;
  Pose pose;
};
PartInPortal ChosenPart(EditorState& state);
// Puts the chosen part where its handle was dragged to; a scale changes its size.
void PlacePart(EditorState& state, const Pose& portal_from_part, bool is_finished);

std::span<const Command> SolidCommands();

}  // namespace arthro::app
