// Every edit of the document, as one named step of its history; the panels and the script lines
// call nothing else. An edit that changes nothing makes no step. While a slider is dragged, edits
// of the same kind are one step.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/state/editor_state.h"
#include "authoring/project/sharing.h"

namespace arthro::app {

// The general form: `change` gets a copy of the document. `merge_key`: steps in a row with the same
// key are one (History::Push); empty: a step of its own.
void Edit(EditorState& state, const std::string& name, const std::string& merge_key,
          const std::function<void(authoring::Document&)>& change);

void SetTitle(EditorState& state, const std::string& title);
void SetAuthor(EditorState& state, const std::string& author);
void SetSide(EditorState& state, BodySide side);
void SetRights(EditorState& state, const authoring::Asset& asset, const AssetRights& rights,
               const std::string& what);
void SetBackdrop(EditorState& state, const Backdrop& backdrop, const std::string& what);
// Another picture as the backdrop, its depth to be made anew. No projection: the one there is stays
// when the size is the same, else it is guessed; an imported depth map of that size stays, too.
void SetPanorama(EditorState& state, const std::string& name,
                 const std::shared_ptr<const ColourImage>& panorama,
                 const std::optional<Projection>& projection = std::nullopt);
// The same with what a clip was put together to, seen through the lens that it was filmed with.
void SetPanorama(EditorState& state, const std::string& name,
                 const std::shared_ptr<const ColourImage>& panorama, const Projection& projection,
                 const Lens& lens, bool is_lens_guessed);
inline constexpr double kMostIncisionSpacing = 0.08;  // m, to either side: end of the sliders
void SetIncisionSpacing(EditorState& state, double spacing);  // m
// rad; of the lens too. Does nothing beyond the end of the lens.
void SetFieldOfView(EditorState& state, double field_of_view);
void SetMedium(EditorState& state, Medium medium);
void SetRelight(EditorState& state, double share);  // Backdrop::relight
void SetRodLength(EditorState& state, double rod_length);

void AddTissue(EditorState& state, Tissue tissue, std::shared_ptr<const SurfaceMesh> surface);
void RemoveTissue(EditorState& state, int tissue);
void DuplicateTissue(EditorState& state, int tissue);
void SetTissue(EditorState& state, int tissue, const Tissue& changed, const std::string& what);

// The slider, field or gizmo was let go: the next edit is a new step.
void EndDrag(EditorState& state);

}  // namespace arthro::app
