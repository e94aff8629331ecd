// The state as pictures: hands the views what changed since the last frame and draws only then.
// Needs the window's OpenGL context.
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/editor/panels/panels.h"
#include "app/editor/pictures/footage_textures.h"
#include "app/editor/pictures/picture_rest.h"
#include "app/editor/pictures/render_scale.h"
#include "app/editor/pictures/shown_backdrop.h"
#include "app/platform/translation.h"
#include "app/recording/live_film.h"
#include "app/state/editor_state.h"
#include "app/steps/budget/frame_budget.h"
#include "app/steps/tissue/cut/cut_skins.h"
#include "app/view/arthroscopic_view.h"
#include "app/view/live_tissues.h"
#include "app/view/overview/overview.h"
#include "authoring/alignment/scene_point.h"
#include "authoring/tissue/surface_faults.h"

namespace arthro::app {

class Pictures {
 public:
  // `steady`: always at full size, so that the same input gives the same bytes; otherwise a slow
  // machine gets a coarser picture while it moves.
  explicit Pictures(bool steady) : steady_(steady) {}

  // Once a frame, before the pictures: takes over what was made beside the window.
  bool Collect() { return backdrop_.Collect(); }
  // Something is being made beside the window.
  bool busy() const { return backdrop_.busy(); }
  // Draws the scope's picture to fill `size` pixels a side, at `seconds` of the window's clock.
  // True when it is not the final one yet: call again soon.
  bool DrawScope(const EditorState& state, int size, double seconds);
  // The picture that was drawn last, into a film: no more often than the film needs it.
  void Record(LiveFilm& film, double t);
  // The author's view from outside. Draws only what changed; on a slow machine less often while the
  // user is busy elsewhere. True when it is not up to date yet.
  bool DrawOverview(EditorState& state, int width, int height);
  unsigned overview_texture() const { return has_overview_ ? overview_.TextureId() : 0; }
  // Writes the labels of the overview in this language.
  void SetOverviewLabels(Translation& translation);
  // Turns the overview or, on its handle, moves the chosen tissue. `scale`: of the window.
  void HandleOverview(EditorState& state, const OverviewInput& input, double scale = 1.0);
  std::optional<glm::dvec2> handle() const {
    return has_overview_ ? overview_.HandlePlace() : std::nullopt;
  }
  // Uses the brush at hand, if any, where the scope's picture was clicked: right and up, in units
  // of its radius.
  void ClickScope(EditorState& state, const glm::dvec2& place);

  // How long the whole frame took, handing over included, s: graphics in software draw behind our
  // back.
  void NoteFrame(double seconds);
  // Costs of the frame at hand while the budget is shown and a moving picture was drawn, but for
  // the whole; takes them.
  std::optional<FrameCost> TakeCost() { return std::exchange(cost_, std::nullopt); }
  unsigned scope_texture() const { return has_picture_ ? scope_.TextureId() : 0; }
  // The last picture without the chosen tissue; 0 where that is not faded.
  unsigned bare_texture() const { return bare_ ? bare_->id() : 0; }
  // The expert's picture at the same step; 0 where no expert is looked back at.
  unsigned expert_texture() const { return has_picture_ && expert_ ? expert_->id() : 0; }
  // The scope's picture, read from the graphics card.
  ColourImage ReadScope() const { return scope_.ReadPixels(); }
  int scope_edge() const { return drawn_size_; }       // px of that texture
  long scope_version() const { return drawn_count_; }  // grows with each picture
  const simulation::ScopeView& view() const { return picture_.view; }
  simulation::ScopeOptics optics() const { return {picture_.field_of_view, picture_.lens}; }
  // Pixel of the overview for a place; nothing behind its camera.
  std::optional<glm::dvec2> OverviewPixelOf(const glm::dvec3& x_in_portal) const {
    return overview_.PixelOf(x_in_portal);
  }
  // Line of sight through a pixel of the overview.
  authoring::Sight OverviewSight(const glm::dvec2& pixel) const {
    const Overview::Line line = overview_.LineThrough(pixel.x, pixel.y);
    return {line.eye, line.direction, line.px_per_radian};
  }
  const std::string& notice() const {
    if (!cut_fault_.empty()) return cut_fault_;
    return optics_.fault.empty() ? scope_.notice() : optics_.fault;
  }

 private:
  void Take(const EditorState& state);
  void TakeTissues(const EditorState& state);
  void TakeCuts(const authoring::Document& document);
  void ShowPlaces(const EditorState& state);
  void HideTissues(const EditorState& state);
  bool IsFaded(const EditorState& state) const;
  // The scope's picture shows a tissue of the document as its cuts leave it.
  void ShowInScope(int tissue);
  void ShowFaults(const EditorState& state);
  void ShowDistances(EditorState& state);
  // Keeps the picture without the chosen tissue while that is faded.
  void DrawBare(const EditorState& state, int pixels);
  void TakeLiveTissues(const EditorState& state);
  void ShowInAttempt(const EditorState& state, const simulation::WorldPicture* world);
  void DrawExpert(const EditorState& state, int pixels);

  ArthroscopicView scope_;
  Overview overview_;
  bool steady_, has_picture_ = false, has_overview_ = false, changed_ = true;
  // The scope's lens, fitted when it changes.
  struct Optics {
    std::optional<Lens> lens;
    double field_of_view = 0;
    simulation::ScopeOptics fitted;
    std::string fault;  // why the lens is not drawn
  };
  const simulation::ScopeOptics& TakeOptics(const authoring::Document& document);
  Optics optics_;
  Picture picture_;
  int drawn_size_ = 0, full_size_ = 0;  // px
  long drawn_count_ = 0;
  PictureRest rest_;
  RenderScale scale_;  // scale and features of moving pictures
  // Time of the fluid, which stands still while nothing moves, s.
  struct Flow {
    double time = 0, seen = 0;
    double Advance(double now, bool moves) {
      if (moves) time += std::clamp(now - seen, 0.0, kMostFlow);
      seen = now;
      return time;
    }
    static constexpr double kMostFlow = 0.1;  // s per frame
  };
  Flow flow_;
  bool is_timed_ = false;  // the frame at hand drew one at that scale
  std::optional<FrameCost> cost_;
  bool overview_held_ = false;
  bool is_laying_ = false;    // a drag over the overview lays a tissue onto the relief
  bool is_painting_ = false;  // a drag over the overview paints on the depth map
  std::chrono::steady_clock::time_point overview_drawn_{};
  // Contents of the view.
  ShownBackdrop backdrop_;
  std::vector<std::shared_ptr<const SurfaceMesh>> surfaces_;
  std::vector<Tissue> tissues_;
  std::vector<simulation::TissueLook> looks_;  // one per tissue
  CutSkins cut_skins_;
  std::vector<std::shared_ptr<const simulation::BodySkin>>
      shown_cuts_;  // one per tissue; null: whole
  std::string cut_fault_;
  std::optional<PictureTexture> bare_;
  std::optional<Picture> expert_picture_;  // none: no expert is looked back at
  std::optional<PictureTexture> expert_;
  std::shared_ptr<const authoring::SurfaceFaults> faults_;    // those that the overview shows
  std::shared_ptr<const std::vector<glm::dvec3>> distances_;  // colours of `coloured_`
  int coloured_ = -1;           // tissue in the colours of its distances, -1 none
  std::vector<bool> left_out_;  // one per tissue: the scope's picture leaves it out
  const void* live_ = nullptr;  // identity of the practice or track whose bodies are shown
  LiveTissues live_tissues_;
  int chosen_ = -1, document_number_ = -1, overview_fits_ = 0;
  Picture overview_tools_;  // tools of the last overview
  glm::dvec2 pointer_{-1.0};
};

}  // namespace arthro::app
