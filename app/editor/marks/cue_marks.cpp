#include "app/editor/marks/cue_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/platform/theme.h"
#include "app/steps/lessons/cues/shown_cues.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/practice_step.h"

namespace arthro::app {
namespace {

constexpr unsigned kCue = 0xFF60E8F8;    // yellow
constexpr unsigned kOther = 0xFFE8D8C8;  // targets that are not chosen
constexpr unsigned kPath = 0x7060E8F8;   // the same yellow, faint
constexpr unsigned kGhost = 0xB0E0E0A0;  // pale blue
constexpr unsigned kRemove = 0xF0F0C040;
constexpr unsigned kSpare = 0xFF6A6AF0;
constexpr double kLeastRing = 14;      // px at scale 1
constexpr double kPathPiece = 0.5e-3;  // m, drawn as a straight line in the picture
constexpr int kRingPoints = 48;

// Draws over the picture's own window.
class Marks {
 public:
  Marks(Ui& ui, const Area& picture, const simulation::ScopeView& view,
        const simulation::ScopeOptics& optics, unsigned colour = kCue)
      : ui_(ui), picture_(picture), view_(view), optics_(optics), colour_(colour) {}

  // Right and up from the middle of the picture; 1 is the rim.
  glm::dvec2 PlaceOf(const glm::dvec3& x_in_portal) const {
    return simulation::PlaceOf(optics_, view_, x_in_portal - view_.tip);
  }
  bool Shows(const glm::dvec3& x_in_portal) const {
    return glm::length(PlaceOf(x_in_portal)) <= 1.0;
  }

  void Mark(const glm::dvec3& x_in_portal, const std::string& name) const {
    if (Shows(x_in_portal))
      Ring(PlaceOf(x_in_portal), name);
    else
      ArrowAtRim(x_in_portal);
  }

  // Words beside a small dot.
  void Name(const glm::dvec3& x_in_portal, const std::string& name) const {
    if (!Shows(x_in_portal)) return;
    const ImVec2 at = At(PlaceOf(x_in_portal));
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddCircleFilled(at, ui_.Px(4), kMarkShadow);
    draw->AddCircleFilled(at, ui_.Px(2.5f), colour_);
    Words({at.x + ui_.Px(9), at.y - ui_.Px(8)}, name);
  }

  // An arrow that ends beside the target, or at the rim towards it.
  void Arrow(const glm::dvec3& x_in_portal) const {
    if (!Shows(x_in_portal)) return ArrowAtRim(x_in_portal);
    const ImVec2 at = At(PlaceOf(x_in_portal));
    const float gap = ui_.Px(6), head = ui_.Px(14), shaft = ui_.Px(34), half = ui_.Px(7);
    const auto along = [&](float way, float aside) {  // from the upper left to the target
      const float s = std::numbers::sqrt2_v<float> / 2;
      return ImVec2{at.x - s * (way + aside), at.y - s * (way - aside)};
    };
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddLine(along(gap + head, 0), along(gap + head + shaft, 0), kMarkShadow, ui_.Px(6));
    draw->AddLine(along(gap + head, 0), along(gap + head + shaft, 0), colour_, ui_.Px(3));
    draw->AddTriangleFilled(along(gap, 0), along(gap + head, half), along(gap + head, -half),
                            colour_);
  }

  void ArrowAtRim(const glm::dvec3& x_in_portal) const {
    const glm::dvec2 place = PlaceOf(x_in_portal);
    const double from_centre = glm::length(place);
    const glm::dvec2 towards =
        std::isfinite(from_centre) && from_centre > 0 ? place / from_centre : glm::dvec2(0, 1);
    const glm::dvec2 across(-towards.y, towards.x);
    ImGui::GetWindowDrawList()->AddTriangleFilled(At(0.97 * towards),
                                                  At(0.88 * towards + 0.05 * across),
                                                  At(0.88 * towards - 0.05 * across), colour_);
  }

  // Outline of a ball as the lens shows it, no smaller than a ring.
  void Outline(const Ball& ball, const std::string& name) const {
    const glm::dvec3 way = ball.centre - view_.tip;
    const double far = glm::length(way);
    if (!(far > ball.radius)) return Mark(ball.centre, name);
    // Circle in which the lens' rays touch the ball.
    const double share = ball.radius / far;
    const glm::dvec3 middle = ball.centre - share * ball.radius * (way / far);
    const glm::dvec3 right = glm::normalize(glm::cross(way, view_.up)),
                     up = glm::normalize(glm::cross(right, way));
    const double radius = ball.radius * std::sqrt(1 - share * share);
    std::vector<glm::dvec3> ring;
    double widest = 0;
    const ImVec2 at = At(PlaceOf(ball.centre));
    for (int i = 0; i <= kRingPoints; ++i) {
      const double angle = 2 * std::numbers::pi * i / kRingPoints;
      ring.push_back(middle + radius * (std::cos(angle) * right + std::sin(angle) * up));
      const ImVec2 point = At(PlaceOf(ring.back()));
      widest = std::max(widest, static_cast<double>(std::hypot(point.x - at.x, point.y - at.y)));
    }
    if (widest < static_cast<double>(ui_.Px(kLeastRing))) return Mark(ball.centre, name);
    Line(ring, ui_.Px(2));
    if (Shows(ball.centre))
      Words({at.x + static_cast<float>(widest) + ui_.Px(4), at.y - ui_.Px(8)}, name);
  }

  // Lines through the places that the picture shows.
  void Line(const std::vector<glm::dvec3>& places, float width, bool has_shadow = true) const {
    for (std::size_t i = 1; i < places.size(); ++i)
      Piece(places[i - 1], places[i], width, has_shadow);
  }
  void Piece(const glm::dvec3& a, const glm::dvec3& b, float width, bool has_shadow = true) const {
    if (!Shows(a) || !Shows(b)) return;
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 from = At(PlaceOf(a)), to = At(PlaceOf(b));
    if (has_shadow) draw->AddLine(from, to, kMarkShadow & 0x60FFFFFF, width + ui_.Px(2));
    draw->AddLine(from, to, colour_, width);
  }
  // Straight legs in space, which the lens bends.
  void Legs(const std::vector<glm::dvec3>& corners, float width) const {
    std::vector<glm::dvec3> places;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const int pieces = std::max(
          1, static_cast<int>(std::ceil(glm::distance(corners[i - 1], corners[i]) / kPathPiece)));
      for (int k = i == 1 ? 0 : 1; k <= pieces; ++k)
        places.push_back(glm::mix(corners[i - 1], corners[i], static_cast<double>(k) / pieces));
    }
    Line(places, width, false);
  }

  void Dot(const glm::dvec3& x_in_portal, float radius) const {
    if (!Shows(x_in_portal)) return ArrowAtRim(x_in_portal);
    ImGui::GetWindowDrawList()->AddCircleFilled(At(PlaceOf(x_in_portal)), radius, colour_);
  }

 private:
  ImVec2 At(const glm::dvec2& place) const {
    const double radius = 0.5 * picture_.width;
    return {static_cast<float>(picture_.x + radius * (1 + place.x)),
            static_cast<float>(picture_.y + radius * (1 - place.y))};
  }
  void Ring(const glm::dvec2& place, const std::string& name) const {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 at = At(place);
    draw->AddCircle(at, ui_.Px(kLeastRing), kMarkShadow, 32, ui_.Px(4));
    draw->AddCircle(at, ui_.Px(kLeastRing), colour_, 32, ui_.Px(2));
    Words({at.x + ui_.Px(18), at.y - ui_.Px(8)}, name);
  }
  void Words(const ImVec2& at, const std::string& name) const {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddText({at.x + 1, at.y + 1}, kMarkShadow, name.c_str());
    draw->AddText(at, colour_, name.c_str());
  }

  Ui& ui_;
  const Area& picture_;
  const simulation::ScopeView& view_;
  const simulation::ScopeOptics& optics_;
  unsigned colour_;
};

void Draw(const Marks& marks, const CueMark& cue) {
  switch (cue.kind) {
    case CueKind::kNone:
    case CueKind::kGhost:  // its way is drawn instead
      return;
    case CueKind::kName:
      return marks.Name(cue.ball.centre, cue.name);
    case CueKind::kArrow:
      return marks.Arrow(cue.ball.centre);
    case CueKind::kOutline:
      if (!marks.Shows(cue.ball.centre)) return marks.ArrowAtRim(cue.ball.centre);
      if (cue.has_outline) return marks.Name(cue.ball.centre, cue.name);
      return marks.Outline(cue.ball, cue.name);
  }
}

// True where nothing of the tissues lies between the lens and a piece that faces it.
bool IsInSight(const EditorState& state, const simulation::ScopeView& view,
               const OutlinePiece& piece) {
  constexpr double kAbove = 1e-4;  // m, over the skin on which the piece lies
  const glm::dvec3 middle = 0.5 * (piece.a + piece.b) + kAbove * piece.normal;
  if (!(glm::dot(piece.normal, view.tip - middle) > 0)) return false;
  return !state.practice || !state.practice->eye().IsHiddenByTissue({view.tip, middle});
}

}  // namespace

void MarkTargets(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                 const simulation::ScopeView& view, const simulation::ScopeOptics& optics) {
  const ShownCues shown = CuesOf(state);
  const FixedWindow same(ui, "picture", window, kPictureWindow);
  const auto in = [&](unsigned colour) { return Marks(ui, picture, view, optics, colour); };
  for (const auto& path : shown.paths) in(kPath).Legs(path, ui.Px(2));
  for (const OutlinePiece& piece : shown.remove)
    if (IsInSight(state, view, piece)) in(kRemove).Piece(piece.a, piece.b, ui.Px(2));
  for (const CueMark& zone : shown.spare)
    if (in(kSpare).Shows(zone.ball.centre)) in(kSpare).Outline(zone.ball, ui.In("keep off"));
  for (const CueMark& cue : shown.cues) Draw(in(kCue), cue);
  if (shown.goal) in(kCue).Mark(*shown.goal, "");
  in(kGhost).Line(shown.ghost, ui.Px(2), false);
  if (shown.ghost_now) in(kGhost).Dot(*shown.ghost_now, ui.Px(6));
}

void MarkTouches(Ui& ui, const EditorState& state, const char* name, const Area& window,
                 const Area& picture, const simulation::ScopeView& view,
                 const simulation::ScopeOptics& optics) {
  const Debrief& debrief = state.steps.lessons->debrief;
  const FixedWindow same(ui, name, window, kPictureWindow);
  constexpr unsigned kFaint = 0xC0FFFFFF;
  for (const TouchMark& touch : debrief.touches) {
    if (touch.t > debrief.at) break;  // they have the order of their times
    const unsigned colour = touch.grade == TouchGrade::kHarm   ? kBad
                            : touch.grade == TouchGrade::kCare ? kWarning
                                                               : kGood;
    const Marks marks(ui, picture, view, optics, colour & kFaint);
    if (marks.Shows(touch.place)) marks.Dot(touch.place, ui.Px(2.5));
  }
}

void MarkTarget(Ui& ui, const Area& picture, const simulation::ScopeView& view,
                const simulation::ScopeOptics& optics, const glm::dvec3& x_in_portal,
                const std::string& name, bool is_bright) {
  Marks(ui, picture, view, optics, is_bright ? kCue : kOther).Mark(x_in_portal, name);
}

}  // namespace arthro::app
