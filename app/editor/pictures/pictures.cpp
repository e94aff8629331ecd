#include "app/editor/pictures/pictures.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "app/editor/pictures/picture_clicks.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/solids/solid_edit.h"
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/fault_board.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/landmark_mode.h"
#include "app/steps/tissue/tissue_balls.h"
#include "app/view/attempt_picture.h"
#include "app/view/still_picture.h"
#include "simulation/core/error.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {
namespace {

constexpr int kStillSamples = 8;  // texture samples per ray of a picture at rest
constexpr auto kOverviewPause = std::chrono::milliseconds(200);  // between two, on a slow machine

Overview::Side SideOf(OverviewSide side) {
  switch (side) {
    case OverviewSide::kFront:
      return Overview::Side::kFront;
    case OverviewSide::kTop:
      return Overview::Side::kTop;
    case OverviewSide::kRight:
      return Overview::Side::kRight;
    case OverviewSide::kWhole:
      break;
  }
  return Overview::Side::kWhole;
}

bool Same(const Picture& a, const Picture& b) {
  return a.view.tip == b.view.tip && a.view.view == b.view.view && a.view.up == b.view.up &&
         a.field_of_view == b.field_of_view && a.lens == b.lens && a.camera == b.camera &&
         a.notch == b.notch && a.instrument == b.instrument && a.disturbances == b.disturbances &&
         a.flecks == b.flecks;
}

// Picture of the tools that the author holds while no session runs.
Picture AuthorsPicture(const EditorState& state, const simulation::ScopeOptics& optics) {
  const Scene& scene = state.document().scene;
  Picture picture = PictureFromPose(state.scope, scene.scope.view_angle, optics.field_of_view);
  picture.lens = optics.lens;
  picture.camera = optics.camera;
  picture.relief = kUsualRelief;
  const glm::dvec3 portal(scene.portals.incision_spacing, 0, 0);
  picture.instrument = InstrumentView{
      portal,
      state.steps.practice->poke ? state.steps.practice->poke->snapshot().instrument.proxy_in_portal
                                 : portal + simulation::TipInOwnPortal(state.instrument),
      state.instrument.roll};
  return picture;
}

Picture ShownPicture(const EditorState& state, const simulation::ScopeOptics& optics) {
  Picture picture;
  if (const simulation::AttemptFrame* frame = DebriefFrame(state)) {
    picture = PictureOfFrame(*frame, optics);
  } else if (const auto& practice = state.practice) {
    const simulation::Snapshot& snapshot = practice->snapshot();
    picture = PictureOf(snapshot, practice->seen_from(), practice->instrument_kind(), optics,
                        state.steps.practice->head);
    picture.instrument->turn = practice->blade_turn();
    picture.disturbances = state.steps.practice->disturbing.now;
    picture.flecks = FlecksIn(state.document().scene.backdrop);
    // The time advances only for disturbances that move, so that a still picture is not redrawn.
    if (picture.disturbances.is_moving()) picture.disturbances.time = snapshot.t;
  } else {
    picture = AuthorsPicture(state, optics);
  }
  picture.samples = 2;
  return picture;
}

}  // namespace

void Pictures::TakeTissues(const EditorState& state) {
  const authoring::Document& document = state.document();
  std::vector<Tissue> tissues = document.scene.tissues;
  if (const auto before = ShownBefore(state))
    tissues[static_cast<std::size_t>(state.tissue)].pose = *before;
  std::vector<simulation::TissueLook> looks = simulation::LooksOf(tissues, state.tissue_presets);
  const auto same_look = [&] {
    if (surfaces_ != document.surfaces || tissues_.size() != tissues.size() || looks_ != looks)
      return false;
    for (std::size_t i = 0; i < tissues.size(); ++i)
      if (tissues_[i].colour != tissues[i].colour) return false;
    return true;
  };
  if (!same_look()) {
    scope_.SetTissues(tissues, document.surfaces, looks);
    overview_.SetTissues(tissues, document.surfaces);
    shown_cuts_.assign(tissues.size(), nullptr);
    chosen_ = coloured_ = -1;
    left_out_.clear();
    faults_ = nullptr;
    surfaces_ = document.surfaces;
    changed_ = true;
  } else {
    for (std::size_t i = 0; i < tissues.size(); ++i)
      if (!(tissues_[i].pose == tissues[i].pose)) {
        scope_.SetTissuePose(static_cast<int>(i), tissues[i].pose);
        overview_.SetTissuePose(static_cast<int>(i), tissues[i].pose);
        changed_ = true;
      }
  }
  tissues_ = tissues;
  looks_ = std::move(looks);
  TakeCuts(document);
}

// The tissue whose outline is drawn over the scope's picture is not in it; those that the author
// hid are in neither view.
void Pictures::HideTissues(const EditorState& state) {
  left_out_.resize(shown_cuts_.size(), false);
  for (std::size_t i = 0; i < left_out_.size(); ++i) {
    const int tissue = static_cast<int>(i);
    const bool is_hidden = IsHiddenByAuthor(state, tissue);
    overview_.ShowTissue(tissue, !is_hidden);
    const bool is_left_out = is_hidden || (IsOutlined(state) && tissue == state.tissue);
    if (is_left_out == left_out_[i]) continue;
    left_out_[i] = is_left_out;
    if (is_left_out)
      scope_.SetTissueSurface(tissue, {});
    else
      ShowInScope(tissue);
    changed_ = true;
  }
}

bool Pictures::IsFaded(const EditorState& state) const {
  const auto chosen = static_cast<std::size_t>(state.tissue);
  return FadeOf(state) > 0 && chosen < left_out_.size() && !left_out_[chosen];
}

void Pictures::ShowInScope(int tissue) {
  const auto at = static_cast<std::size_t>(tissue);
  if (shown_cuts_[at])
    scope_.SetTissueSurface(tissue, shown_cuts_[at]->surface, shown_cuts_[at]->is_fresh);
  else
    scope_.SetTissueSurface(tissue, OrEmpty(surfaces_[at]));
}

void Pictures::DrawBare(const EditorState& state, int pixels) {
  if (!IsFaded(state)) return bare_.reset();
  scope_.SetTissueSurface(state.tissue, {});
  scope_.Render(picture_, pixels);
  bare_.emplace(scope_.ReadPixels());
  ShowInScope(state.tissue);
}

void Pictures::ShowFaults(const EditorState& state) {
  const auto found = ShownFaults(state);
  if (found == faults_) return;
  faults_ = found;
  std::vector<SurfaceMark> marks;
  for (std::size_t i = 0; found && i < found->faults.size(); ++i)
    marks.push_back(
        {found->faults[i].edges, found->faults[i].triangles, ColourOf(found->faults[i].kind)});
  overview_.ShowMarks(state.tissue, marks);
}

void Pictures::ShowDistances(EditorState& state) {
  const auto colours = ShownDistances(state);
  const int wanted = colours ? state.tissue : -1;
  if (wanted == coloured_ && colours == distances_) return;
  if (coloured_ >= 0 && wanted != coloured_) {
    const auto at = static_cast<std::size_t>(coloured_);
    if (shown_cuts_[at])
      overview_.SetTissueSurface(coloured_, shown_cuts_[at]->surface, shown_cuts_[at]->is_fresh);
    else
      overview_.SetTissueSurface(coloured_, OrEmpty(surfaces_[at]));
  }
  // The distances are those of the whole surface.
  if (wanted >= 0 && wanted != coloured_)
    overview_.SetTissueSurface(wanted, OrEmpty(surfaces_[static_cast<std::size_t>(wanted)]));
  if (wanted >= 0) overview_.SetTissueColours(wanted, *colours);
  coloured_ = wanted;
  distances_ = colours;
}

// Tissues as their author's cuts leave them.
void Pictures::TakeCuts(const authoring::Document& document) {
  cut_fault_.clear();
  for (std::size_t i = 0; i < tissues_.size(); ++i) {
    const auto skin = cut_skins_.SkinOf(document, static_cast<int>(i));
    if (!cut_skins_.fault().empty()) cut_fault_ = cut_skins_.fault();
    if (skin == shown_cuts_[i]) continue;
    const SurfaceMesh& surface = skin ? skin->surface : OrEmpty(document.surfaces[i]);
    const std::vector<std::uint8_t> fresh = skin ? skin->is_fresh : std::vector<std::uint8_t>{};
    scope_.SetTissueSurface(static_cast<int>(i), surface, fresh);
    overview_.SetTissueSurface(static_cast<int>(i), surface, fresh);
    shown_cuts_[i] = skin;
    changed_ = true;
  }
}

// Tissues that live, or that are looked back at, are shown as they are; after that, as the document
// has them.
void Pictures::TakeLiveTissues(const EditorState& state) {
  const simulation::Practice* live = LiveSession(state);
  const simulation::WorldPicture* world = live != nullptr ? live->tissues() : DebriefTissues(state);
  const void* source = live != nullptr ? static_cast<const void*>(live) : world;
  if (live_ != source) {
    if (!live_tissues_.empty()) surfaces_.clear();  // they are shown anew
    live_ = source;
    live_tissues_.Forget();
    TakeTissues(state);
  }
  if (world != nullptr &&
      live_tissues_.Show(*world, state.document().scene.tissues, scope_, &overview_))
    changed_ = true;
}

// Shows tissues of an attempt in the scope's picture alone; those that it does not name are as the
// document has them.
void Pictures::ShowInAttempt(const EditorState& state, const simulation::WorldPicture* world) {
  for (std::size_t i = 0; i < shown_cuts_.size(); ++i) ShowInScope(static_cast<int>(i));
  live_tissues_.Forget();
  if (world != nullptr) live_tissues_.Show(*world, state.document().scene.tissues, scope_, nullptr);
}

// The expert's picture is drawn before the trainee's, with the tissues of the expert.
void Pictures::DrawExpert(const EditorState& state, int pixels) {
  if (!expert_picture_) return expert_.reset();
  ShowInAttempt(state, ExpertTissues(state));
  scope_.SetLooseBodies(ExpertLooseBodies(state));
  Picture picture = *expert_picture_;
  picture.rays = picture_.rays;
  picture.samples = picture_.samples;
  picture.features = picture_.features;
  scope_.Render(picture, pixels);
  expert_.emplace(scope_.ReadPixels());
  ShowInAttempt(state, DebriefTissues(state));
  scope_.SetLooseBodies(ShownLooseBodies(state));
}

void Pictures::Take(const EditorState& state) {
  changed_ = backdrop_.Take(state, scope_, overview_) || changed_;
  TakeTissues(state);
  HideTissues(state);
  TakeLiveTissues(state);
  const std::vector<Ball> loose = ShownLooseBodies(state);
  changed_ = scope_.SetLooseBodies(loose) || changed_;
  overview_.ShowLooseBodies(loose);
}

const simulation::ScopeOptics& Pictures::TakeOptics(const authoring::Document& document) {
  const ScopeSpec& scope = document.scene.scope;
  if (document.lens == optics_.lens && scope.field_of_view == optics_.field_of_view)
    return optics_.fitted;
  optics_ = {document.lens, scope.field_of_view, {scope.field_of_view, {}, {}}, {}};
  try {
    optics_.fitted = simulation::OpticsOf(scope, document.lens);
  } catch (const Error& error) {
    optics_.fault = std::string(error.what()) + "; an equisolid lens is drawn";
  }
  return optics_.fitted;
}

bool Pictures::DrawScope(const EditorState& state, int size, double seconds) {
  Take(state);
  Picture picture = ShownPicture(state, TakeOptics(state.document()));
  if (state.practice && picture.instrument)
    picture.instrument = live_tissues_.Settled(*picture.instrument);
  std::optional<Picture> expert;
  if (const simulation::AttemptFrame* frame = ExpertFrame(state))
    expert = PictureOfFrame(*frame, TakeOptics(state.document()));
  const bool has_other_expert = expert.has_value() != expert_picture_.has_value() ||
                                (expert && expert_picture_ && !Same(*expert, *expert_picture_));
  expert_picture_ = expert;
  const bool is_faded = IsFaded(state);
  // The fluid flows while something moves: villi sway and flecks drift then, and a picture at rest
  // stays as it is.
  const bool flows = state.practice && !picture.disturbances.is_moving();
  if (flows) picture.disturbances.time = flow_.time;
  const bool has_changed = changed_ || has_other_expert || !Same(picture, picture_) ||
                           full_size_ != size || is_faded != bare_.has_value();
  if (flows) picture.disturbances.time = flow_.Advance(state.practice->snapshot().t, has_changed);
  picture_ = picture;
  full_size_ = size;
  has_picture_ = backdrop_.has_panorama();
  is_timed_ = false;
  if (!has_picture_) return false;
  const int rays = rest_.RaysDue(has_changed, seconds);
  if (rays == 0) return !rest_.is_final();

  // A machine that is slow at full size draws coarser while things move, and full when they rest.
  const bool is_moving = rays == 1 && !steady_;
  double scale = is_moving ? scale_.value() : 1.0;
  picture_.features = is_moving ? scale_.features() : CameraFeatures::kOcclusion;
  if (rays == 1 && state.settings.moving_picture != MovingPicture::kAutomatic)
    picture_.features = std::min(picture_.features, CameraFeatures::kEdges);
  if (rays == 1 && state.settings.moving_picture == MovingPicture::kSmall)
    scale = std::min(scale, kSmallScale);
  picture_.rays = rays;
  if (rays == 2) picture_.samples = kStillSamples;
  const int pixels = static_cast<int>(std::lround(scale * size));
  DrawBare(state, pixels);
  DrawExpert(state, pixels);
  const bool is_measured = rays == 1 && state.steps.practice->budget->is_shown;
  scope_.SetTimed(is_measured);
  scope_.Render(picture_, pixels);
  cost_.reset();
  if (is_measured) cost_ = FrameCost{scope_.cost()};
  is_timed_ = is_moving;
  drawn_size_ = pixels;
  ++drawn_count_;
  changed_ = false;
  return !rest_.is_final();
}

void Pictures::NoteFrame(double seconds) {
  if (is_timed_) scale_.Note(seconds);
  is_timed_ = false;
}

void Pictures::Record(LiveFilm& film, double t) {
  if (has_picture_ && film.IsDue(t)) film.Offer(t, scope_.ReadPixels());
}

void Pictures::SetOverviewLabels(Translation& translation) {
  std::array<std::string, Overview::kLabels.size()> words;
  std::ranges::transform(Overview::kLabels, words.begin(),
                         [&](const char* label) { return translation.Of(label); });
  overview_.SetLabels(words);
}

bool Pictures::DrawOverview(EditorState& state, int width, int height) {
  Take(state);
  has_overview_ = backdrop_.has_panorama();
  if (!has_overview_) return false;
  if (document_number_ != state.document_number || overview_fits_ != state.overview_fits) {
    overview_.LookFrom(document_number_ == state.document_number ? SideOf(state.overview_side)
                                                                 : Overview::Side::kWhole);
    document_number_ = state.document_number;
    overview_fits_ = state.overview_fits;
  }
  const Picture picture = ShownPicture(state, TakeOptics(state.document()));
  if (!Same(picture, overview_tools_)) {
    overview_tools_ = picture;
    overview_.SetIncisionSpacing(state.document().scene.portals.incision_spacing);
    overview_.SetTools({picture.view, picture.field_of_view, picture.instrument});
  }
  // The box is there while tissue is worked on.
  const bool is_clicked = HasBrush(state) || PlacesLandmarks(state) || LaysOnRelief(state);
  const int chosen = IsTissueEdited(state) && !is_clicked ? state.tissue : -1;
  if (chosen != chosen_) overview_.ChooseTissue(chosen_ = chosen);
  const PartInPortal part = chosen >= 0 ? ChosenPart(state) : PartInPortal();
  overview_.ShowPart(part.surface, part.pose);
  ShowPlaces(state);
  ShowFaults(state);
  ShowDistances(state);
  // Landmarks are clicked on the model, which rods and labels hide.
  overview_.ShowTools(!PlacesLandmarks(state));
  const HandPlacing& placing = state.steps.tissue->placing;
  overview_.snap_step = placing.snaps ? placing.step : 0;
  overview_.snap_turn = placing.snaps ? placing.turn : 0;
  overview_.ShowArms(state.steps.tissue->placing.axes == authoring::NudgeAxes::kTissue
                         ? Overview::Arms::kOwn
                         : Overview::Arms::kPortal);
  // Draws the scope's picture before the overview on a slow machine.
  const auto now = std::chrono::steady_clock::now();
  if (!steady_ && scale_.is_slow() && !overview_held_ && now - overview_drawn_ < kOverviewPause)
    return true;
  if (overview_.Render(width, height)) overview_drawn_ = now;
  if (cost_) {
    scope_.Finish();
    cost_->overview = std::chrono::duration<double>(std::chrono::steady_clock::now() - now).count();
  }
  return false;
}

// The balls that the page at hand is about.
void Pictures::ShowPlaces(const EditorState& state) {
  const auto& tissues = state.document().scene.tissues;
  const bool has_tissue =
      IsTissueEdited(state) && state.tissue >= 0 && state.tissue < static_cast<int>(tissues.size());
  const auto kind = BallKindOf(state.steps.tissue->page);
  if (has_tissue && kind)
    return overview_.ShowBalls(state.tissue,
                               BallsOf(tissues[static_cast<std::size_t>(state.tissue)], *kind),
                               state.steps.tissue->ball);
  if (const auto patch = PatchOf(state); has_tissue && patch)
    return overview_.ShowBalls(state.tissue, std::span(&*patch, 1), 0);
  if (!has_tissue || state.steps.tissue->page != TissuePage::kCut)
    return overview_.ShowBalls(-1, {}, -1);
  const Tissue& tissue = tissues[static_cast<std::size_t>(state.tissue)];
  std::vector<Ball> balls;
  for (const Region& region : tissue.regions) balls.push_back(region.ball);
  int chosen = state.steps.tissue->region;
  if (const CutBrush& brush = state.steps.tissue->cut_brush;
      brush.start && brush.start_tissue == state.tissue) {
    constexpr double kMark = 6e-4;  // m, of the first point of a tear
    chosen = static_cast<int>(balls.size());
    balls.push_back({*brush.start, kMark / tissue.pose.scale});
  }
  overview_.ShowBalls(state.tissue, balls, chosen);
}

}  // namespace arthro::app
