// Panorama and relief that the scope's picture and the overview show: hands them what changed since
// the last frame. The noise of a depth map is removed beside the window; until that is done, the
// last relief of the panorama stays, moved where a stroke of a brush changed the map.
#pragma once

#include <memory>
#include <optional>

#include "app/state/editor_state.h"
#include "app/view/arthroscopic_view.h"
#include "app/view/backdrop/relief_work.h"
#include "app/view/overview/overview.h"

namespace arthro::app {

class ShownBackdrop {
 public:
  // Takes over what was made beside the window.
  bool Collect() { return work_.Collect(); }
  bool busy() const { return work_.busy(); }
  bool has_panorama() const { return panorama_ != nullptr; }
  // Returns whether a picture changes.
  bool Take(const EditorState& state, ArthroscopicView& scope, Overview& overview);

 private:
  bool TakeQuietRelief(ArthroscopicView& scope);
  // The relief of `source`, of a panorama that is shown anew or not. Null: the last one stays.
  std::shared_ptr<const DrawnRelief> ReliefOf(const ReliefWork::Source& source, bool is_shown);

  std::shared_ptr<const ColourImage> panorama_;
  std::shared_ptr<const ColourImage> shown_of_;  // panorama of the document at that time
  std::shared_ptr<const DepthMap> depth_, sigma_;
  std::shared_ptr<const DrawnRelief> relief_;  // relief of a noisy map; null: not kept
  ReliefWork work_;
  std::optional<ReliefWork::Source> awaited_;  // whose relief is shown with its noise
  std::shared_ptr<const ColourImage> reach_;   // null: the panorama as it is
  Backdrop backdrop_;
  bool as_filmed_ = false;
};

}  // namespace arthro::app
