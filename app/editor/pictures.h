// The state as pictures: hands the views what changed since the last frame and draws only then.
// Needs the window's OpenGL context.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/commands/editor_state.h"
#include "app/view/arthroscopic_view.h"

namespace arthro::app {

class Pictures {
 public:
  // `steady`: always at full size, so that the same input gives the same bytes; otherwise a slow
  // machine gets a coarser picture while it moves.
  explicit Pictures(bool steady) : steady_(steady) {}

  // Draws the scope's picture to fill `size` pixels a side. True when it is not the final one yet:
  // call again soon.
  bool DrawScope(const EditorState& state, int size);
  unsigned scope_texture() const { return has_picture_ ? scope_.TextureId() : 0; }
  const simulation::ScopeView& view() const { return picture_.view; }
  const std::string& notice() const { return scope_.notice(); }

 private:
  void TakeBackdrop(const EditorState& state);
  void TakeTissues(const authoring::Document& document);

  ArthroscopicView scope_;
  bool steady_, has_picture_ = false, changed_ = true;
  Picture picture_;
  int drawn_size_ = 0;
  double milliseconds_ = 0;  // of the last full-size frame
  // What the view holds.
  std::shared_ptr<const ColourImage> panorama_;
  std::shared_ptr<const DepthMap> depth_;
  Backdrop backdrop_;
  std::vector<std::shared_ptr<const SurfaceMesh>> surfaces_;
  std::vector<Tissue> tissues_;
};

}  // namespace arthro::app
