#include "app/editor/pictures/picture_clicks.h"

#include <glm/geometric.hpp>

#include "app/editor/pictures/pictures.h"
#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/lessons/author/target_edit.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/solids/solid_edit.h"
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/landmark_mode.h"
#include "app/steps/tissue/tissue_balls.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {
namespace {

constexpr double kLandmarkReach = 8;  // px at scale 1; a click that misses the model by less counts

void UseBrush(EditorState& state, const std::optional<Overview::TissuePlace>& place) {
  if (!place)
    state.message = "There is no tissue at that place. Click on the tissue; Esc ends this.";
  else if (PicksPatch(state))
    TakePatch(state, place->tissue, place->x_in_tissue);
  else if (state.steps.tissue->cut_brush.kind != CutBrush::Kind::kNone)
    UseCutBrush(state, place->tissue, place->x_in_tissue);
  else
    AddBall(state, *state.steps.tissue->brush, place->tissue, place->x_in_tissue);
}

}  // namespace

bool IsTissueEdited(const EditorState& state) {
  return state.step == Step::kTissue && !state.practice;
}

bool HasBrush(const EditorState& state) {
  return IsTissueEdited(state) && (state.steps.tissue->brush.has_value() || PicksPatch(state) ||
                                   state.steps.tissue->cut_brush.kind != CutBrush::Kind::kNone);
}

void Pictures::ClickScope(EditorState& state, const glm::dvec2& place) {
  if ((!HasBrush(state) && !TakesTarget(state)) || !has_picture_) return;
  std::optional<Overview::TissuePlace> hit;
  if (glm::length(place) <= 1.0) {
    const glm::dvec3 ray =
        simulation::RayThrough(TakeOptics(state.document()), picture_.view, place);
    hit =
        overview_.PickAlong(picture_.view.tip, 4.0 * state.document().scene.backdrop.radius * ray);
    if (TakesTarget(state))
      return PlaceTarget(
          state, {picture_.view.tip, ray},
          hit ? std::optional(TissueHit{hit->tissue, hit->x_in_tissue}) : std::nullopt);
  }
  if (!HasBrush(state)) return;
  UseBrush(state, hit);
}

void Pictures::HandleOverview(EditorState& state, const OverviewInput& input, double scale) {
  if (!has_overview_) return;
  overview_.handle_scale = scale;
  overview_.on_pose = [&state](int index, const Pose& pose, bool finished) {
    const auto& tissues = state.document().scene.tissues;
    if (index < 0 || index >= static_cast<int>(tissues.size())) return;
    state.dragging = true;
    PlaceTissue(state, index, pose, "Place");
    if (finished) EndDrag(state);
  };
  overview_.on_part = [&state](const Pose& pose, bool finished) {
    PlacePart(state, pose, finished);
  };
  overview_held_ = input.owned || input.wheel != 0;
  using Kind = PointerEvent::Kind;
  constexpr PointerEvent::Button kButtons[] = {
      PointerEvent::Button::kLeft, PointerEvent::Button::kRight, PointerEvent::Button::kMiddle};
  const auto sight = [&]() -> authoring::Sight {
    const Overview::Line line = overview_.LineThrough(input.pointer.x, input.pointer.y);
    return {line.eye, line.direction, line.px_per_radian};
  };
  PointerEvent event;
  event.x = input.pointer.x, event.y = input.pointer.y;
  event.shift = input.shift, event.control = input.ctrl;
  if ((input.hovered || input.owned) && input.pointer != pointer_) {
    event.kind = Kind::kMove;
    overview_.Handle(event);
    pointer_ = input.pointer;
  }
  for (int button = 0; button < 3; ++button) {
    event.button = kButtons[button];
    if (input.pressed[button]) {
      // With Shift the view turns, as it does elsewhere.
      if (button == 0 && LaysOnRelief(state) && !input.shift) {
        is_laying_ = true;
        continue;
      }
      if (button == 0 && PaintsDepth(state) && !input.shift) {
        is_painting_ = true;
        continue;
      }
      if (button == 0 && HasBrush(state)) {
        const auto place = overview_.PickTissue(event.x, event.y);
        UseBrush(state, place);
        if (place) continue;  // a drag beside the tissue turns the view
      }
      event.kind = Kind::kPress;
      overview_.Handle(event);
    }
    if (input.released[button]) {
      event.kind = Kind::kRelease;
      overview_.Handle(event);
    }
  }
  if (is_laying_) {
    LayTissue(state, sight());
    if (!input.owned) {
      EndDrag(state);
      is_laying_ = false;
    }
  }
  if (input.hovered || is_painting_) PointAtRelief(state, sight(), is_painting_);
  if (is_painting_ && !input.owned) {
    EndStroke(state);
    is_painting_ = false;
  }
  if (input.clicked && TakesTarget(state)) {
    const auto place = overview_.PickTissue(event.x, event.y);
    PlaceTarget(state, sight(),
                place ? std::optional(TissueHit{place->tissue, place->x_in_tissue}) : std::nullopt);
  }
  if (input.clicked && PlacesLandmarks(state)) {
    const auto place = overview_.PickTissueNear(event.x, event.y, kLandmarkReach * scale);
    // A model point that waits for its partner is followed by a click on the relief.
    if (place && !state.steps.tissue->landmarks.model) {
      TakeModelPoint(state, place->tissue, place->x_in_tissue);
    } else {
      TakeScenePoint(state, sight());
    }
  }
  if (input.wheel != 0) {
    event.kind = Kind::kWheel;
    event.wheel = input.wheel;
    overview_.Handle(event);
  }
  overview_.on_pose = {};
  overview_.on_part = {};
}

}  // namespace arthro::app
