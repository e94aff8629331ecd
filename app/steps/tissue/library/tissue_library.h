// Library of models and kinds of tears in the editor: each added by one named step of the history.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/scene_point.h"
#include "authoring/models/meniscus_tear.h"
#include "authoring/models/model_library.h"
#include "authoring/models/model_thumbnail.h"

namespace arthro::app {

// State of the library beside the document.
struct ModelShelf {
  bool is_open = false;
  authoring::KneeSize size = authoring::KneeSize::kAverage;
  std::array<std::optional<authoring::ModelThumbnail>, 10> thumbnails;  // one per kind
  // Model that is dragged out of the list, and the pointer as it was on the middle of its picture,
  // window coordinates.
  std::optional<authoring::ModelKind> dragged;
  glm::dvec2 dragged_from{0.0};
  authoring::TearOptions tear;
  // Picture of the tear before it is made, and the tissue's surface that it was made for.
  std::optional<authoring::ModelThumbnail> preview;
  std::string preview_fault;  // reason why the tear cannot be made
  std::weak_ptr<const SurfaceMesh> previewed;
};

// Makes the model beside the window and lays it onto the relief in the middle of the scope's view,
// its base along the normal. A meniscus or ligament is filled with tetrahedra at once.
void AddLibraryModel(EditorState& state, authoring::ModelKind kind);
// The same where a line of sight meets the relief; words where it meets nothing.
void DropLibraryModel(EditorState& state, authoring::ModelKind kind,
                      const std::optional<authoring::Sight>& sight);

// Chooses a kind with its usual extents.
void ChooseTear(EditorState& state, authoring::TearKind kind);
// Cuts the chosen tear into the chosen tissue.
void MakeChosenTear(EditorState& state);
// Draws the preview again where the tear or the tissue has changed.
void UpdateTearPreview(EditorState& state);

}  // namespace arthro::app
