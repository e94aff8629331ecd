// Panorama and relief that the scope's picture and the overview show: hands them what changed since
// the last frame. The noise of a depth map is removed beside the window; until that is done, a
// rough relief is drawn, or the last relief of the panorama, moved where a stroke of a brush
// changed the map.
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
  bool has_panorama() const { return shown_.panorama != nullptr; }
  // Returns whether a picture changes.
  bool Take(const EditorState& state, ArthroscopicView& scope, Overview& overview);

 private:
  // Everything that the pictures depend on; parts are compared by identity.
  struct Content {
    std::shared_ptr<const ColourImage> panorama;  // the document's, or a preview of it
    std::shared_ptr<const ColourImage> of;        // panorama of the document
    std::shared_ptr<const DepthMap> depth, sigma;
    std::shared_ptr<const ColourImage> reach;  // null: the panorama as it is
    Backdrop backdrop;
    bool is_as_filmed = false;
    bool HasPlaceOf(const Content& other) const {
      return backdrop == other.backdrop && is_as_filmed == other.is_as_filmed;
    }
    bool HasReliefOf(const Content& other) const {
      return depth == other.depth && sigma == other.sigma;
    }
    friend bool operator==(const Content&, const Content&) = default;
  };
  static Content ContentOf(const EditorState& state);
  // The backdrop as it is drawn: its light as it is known, its projection that of a preview.
  static Backdrop Drawn(const Content& wanted);

  // Makes the relief of the content. False: it is being made, and the last one stays.
  bool TakeRelief(const Content& wanted, const Backdrop& drawn);
  // The relief of a noisy map; null: the last one stays.
  std::shared_ptr<const DrawnRelief> NoisyRelief(const ReliefWork::Source& source, bool is_shown);
  bool TakeQuietRelief(ArthroscopicView& scope, Overview& overview);

  Content shown_;
  std::shared_ptr<const DrawnRelief> relief_;  // relief of a noisy map; null: not kept
  ReliefWork work_;
  std::optional<ReliefWork::Source> awaited_;  // whose relief is shown rough, or moved
};

}  // namespace arthro::app
