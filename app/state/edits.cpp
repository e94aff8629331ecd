#include "app/state/edits.h"

#include <algorithm>
#include <cmath>

#include "app/state/footage/footage_optics.h"
#include "app/state/footage/footage_source.h"
#include "authoring/alignment/placing_notes.h"
#include "authoring/project/document_io.h"
#include "authoring/project/free_tissue_name.h"

namespace arthro::app {
namespace {

std::string Key(const std::string& area, const std::string& what) { return area + "." + what; }

// A name that no tissue has yet: "meniscus", "meniscus 2", …
bool HasTissue(const EditorState& state, int tissue) {
  return tissue >= 0 && tissue < static_cast<int>(state.document().scene.tissues.size());
}

}  // namespace

void Edit(EditorState& state, const std::string& name, const std::string& merge_key,
          const std::function<void(authoring::Document&)>& change) {
  authoring::Document next = state.document();
  change(next);
  state.history.Push(std::move(next), name, merge_key);
  state.message = name;
}

void SetTitle(EditorState& state, const std::string& title) {
  if (title == state.document().scene.title) return;
  Edit(state, "Change the title", "title", [&](auto& next) { next.scene.title = title; });
}

void SetAuthor(EditorState& state, const std::string& author) {
  if (author == state.document().scene.author) return;
  Edit(state, "Change the author", "author", [&](auto& next) { next.scene.author = author; });
}

void SetSide(EditorState& state, BodySide side) {
  if (side == state.document().scene.side) return;
  Edit(state, "Change the side", "", [&](auto& next) { next.scene.side = side; });
}

void SetRights(EditorState& state, const authoring::Asset& asset, const AssetRights& rights,
               const std::string& what) {
  if (rights == RightsOf(state.document(), asset)) return;
  Edit(state, "Change the " + what, "", [&](auto& next) { PutRights(next, asset, rights); });
}

void SetBackdrop(EditorState& state, const Backdrop& backdrop, const std::string& what) {
  if (backdrop == state.document().scene.backdrop) return;
  Edit(state, "Change " + what, Key("backdrop", what),
       [&](auto& next) { next.scene.backdrop = backdrop; });
}

namespace {

void PutPanorama(authoring::Document& document, const std::shared_ptr<const ColourImage>& panorama,
                 const std::optional<Projection>& projection) {
  const bool same_size = document.panorama && document.panorama->width == panorama->width &&
                         document.panorama->height == panorama->height;
  const bool keeps_depth = document.is_depth_imported && same_size && !projection;
  if (projection)
    document.scene.backdrop.projection = *projection;
  else if (!same_size)
    document.scene.backdrop.projection =
        authoring::GuessProjection(panorama->width, panorama->height);
  // Strokes are shares of the picture, so they fit the same picture at another resolution only.
  const auto has_shape_of = [&](const ColourImage& other) {
    return std::abs(double(panorama->width) * other.height -
                    double(panorama->height) * other.width) <=
           std::max(panorama->width, other.width);
  };
  if (!document.panorama || !has_shape_of(*document.panorama)) {
    document.depth_strokes = nullptr;
    document.unmended = {};
  }
  document.panorama = panorama;
  document.scene.backdrop.panorama = "panorama.png";
  PutFootage(document, nullptr);  // it tells of the panorama before
  if (keeps_depth) return;
  document.scene.backdrop.depth = "depth.tiff";
  SetDepth(document, nullptr);
  document.unmended = {};
  document.is_depth_imported = false;
}

}  // namespace

void SetPanorama(EditorState& state, const std::string& name,
                 const std::shared_ptr<const ColourImage>& panorama,
                 const std::optional<Projection>& projection) {
  Edit(state, name, "", [&](auto& next) { PutPanorama(next, panorama, projection); });
}

void SetPanorama(EditorState& state, const std::string& name,
                 const std::shared_ptr<const ColourImage>& panorama, const Projection& projection,
                 const Lens& lens, bool is_lens_guessed) {
  Edit(state, name, "", [&](auto& next) {
    PutPanorama(next, panorama, projection);
    TakeFootageLens(next, lens, is_lens_guessed);
  });
}

void SetIncisionSpacing(EditorState& state, double spacing) {
  if (spacing == state.document().scene.portals.incision_spacing) return;
  Edit(state, "Change the incision spacing", "incision_spacing",
       [&](auto& next) { next.scene.portals.incision_spacing = spacing; });
}

void SetFieldOfView(EditorState& state, double field_of_view) {
  authoring::Document changed = state.document();
  if (field_of_view == changed.scene.scope.field_of_view || !PutFieldOfView(changed, field_of_view))
    return;
  Edit(state, "Change the field of view", "field_of_view",
       [&](auto& next) { PutFieldOfView(next, field_of_view); });
}

void SetMedium(EditorState& state, Medium medium) {
  if (medium == state.document().scene.backdrop.medium) return;
  Edit(state, "Change the filling", "", [&](auto& next) { next.scene.backdrop.medium = medium; });
}

void SetRelight(EditorState& state, double share) {
  if (share == state.document().scene.backdrop.relight) return;
  Edit(state, "Change the light", "relight",
       [&](auto& next) { next.scene.backdrop.relight = share; });
}

void SetRodLength(EditorState& state, double rod_length) {
  if (rod_length == state.document().scene.rig.scope.rod_length) return;
  Edit(state, "Change the scope's length", "rod_length",
       [&](auto& next) { next.scene.rig.scope.rod_length = rod_length; });
}

void AddTissue(EditorState& state, Tissue tissue, std::shared_ptr<const SurfaceMesh> surface) {
  tissue.name = authoring::FreeTissueName(state.document().scene, tissue.name);
  const std::string name = tissue.name;
  Edit(state, "Add " + name, "", [&](auto& next) {
    next.scene.tissues.push_back(std::move(tissue));
    next.surfaces.push_back(std::move(surface));
  });
  state.tissue = static_cast<int>(state.document().scene.tissues.size()) - 1;
}

void RemoveTissue(EditorState& state, int tissue) {
  if (!HasTissue(state, tissue)) return;
  const auto index = static_cast<std::ptrdiff_t>(tissue);
  const std::string name = state.document().scene.tissues[static_cast<std::size_t>(tissue)].name;
  Edit(state, "Remove " + name, "", [&](auto& next) {
    authoring::RenameInNotes(next.scene, name, "");
    next.scene.tissues.erase(next.scene.tissues.begin() + index);
    next.surfaces.erase(next.surfaces.begin() + index);
  });
  if (!HasTissue(state, state.tissue))
    state.tissue = static_cast<int>(state.document().scene.tissues.size()) - 1;
}

void DuplicateTissue(EditorState& state, int tissue) {
  if (!HasTissue(state, tissue)) return;
  const auto index = static_cast<std::size_t>(tissue);
  Tissue copy = state.document().scene.tissues[index];
  copy.pose.position.x += 0.2 * state.document().scene.backdrop.radius;  // beside it, not inside it
  AddTissue(state, std::move(copy), state.document().surfaces[index]);
}

void SetTissue(EditorState& state, int tissue, const Tissue& changed, const std::string& what) {
  if (!HasTissue(state, tissue)) return;
  const Tissue& old = state.document().scene.tissues[static_cast<std::size_t>(tissue)];
  if (changed == old) return;
  Edit(state, what + " " + old.name, Key("tissue " + std::to_string(tissue), what),
       [&](auto& next) {
         Tissue& own = next.scene.tissues[static_cast<std::size_t>(tissue)];
         if (own.name != changed.name) authoring::RenameInNotes(next.scene, own.name, changed.name);
         own = changed;
       });
}

void EndDrag(EditorState& state) {
  state.dragging = false;
  state.history.EndMerge();
}

}  // namespace arthro::app
