#include "app/editor/marks/model_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "app/platform/theme.h"
#include "app/steps/tissue/hand_placing.h"

namespace arthro::app {
namespace {

std::vector<glm::dvec3> VerticesOf(const SurfaceMesh& surface, const Pose& pose) {
  std::vector<glm::dvec3> x;
  x.reserve(surface.vertices.size());
  for (const glm::dvec3& vertex : surface.vertices) x.push_back(pose * vertex);
  return x;
}

// Two neighbours on the surface lie on both sides of the seam of a panorama.
bool IsTorn(const glm::dvec2& a, const glm::dvec2& b, const Area& area) {
  return std::abs(a.x - b.x) > 0.5 * area.width;
}

}  // namespace

void DrawOutline(const Ui& ui, const EditorState& state, const Area& area, const glm::dvec3& eye,
                 const ToWindow& to_window) {
  const auto index = static_cast<std::size_t>(state.tissue);
  const auto& surface = state.document().surfaces[index];
  if (!surface) return;
  const MarkClip clip(area);
  const Pose& pose = state.document().scene.tissues[index].pose;
  const std::vector<glm::dvec3> x = VerticesOf(*surface, pose);
  // An edge belongs to the silhouette when one of its triangles faces the eye and the other not.
  std::map<std::pair<int, int>, int> facing;
  for (const auto& triangle : surface->triangles) {
    const auto at = [&](int corner) {
      return x[static_cast<std::size_t>(triangle[static_cast<std::size_t>(corner)])];
    };
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    const int side = glm::dot(normal, eye - at(0)) > 0 ? 1 : -1;
    for (int corner = 0; corner < 3; ++corner)
      facing[std::minmax(triangle[static_cast<std::size_t>(corner)],
                         triangle[static_cast<std::size_t>((corner + 1) % 3)])] += side;
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (const auto& [edge, sum] : facing) {
    if (sum != 0) continue;
    const auto from = to_window(x[static_cast<std::size_t>(edge.first)]),
               to = to_window(x[static_cast<std::size_t>(edge.second)]);
    if (!from || !to || IsTorn(*from, *to, area)) continue;
    draw->AddLine(Corner(*from), Corner(*to), kMarkShadow, ui.Px(3));
    draw->AddLine(Corner(*from), Corner(*to), kModelColour, ui.Px(1.4));
  }
}

void DrawContours(const Ui& ui, EditorState& state, const Area& area, const glm::dvec3& eye,
                  const ToWindow& to_window) {
  const auto contours = ShownContours(state);
  if (!contours) return;
  const Pose& pose = state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].pose;
  const MarkClip clip(area);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (const bool is_shadow : {true, false})
    for (std::size_t k = 0; k < contours->size(); ++k) {
      const double level = authoring::kContourLevels[k];
      const float width = ui.Px((level == 0 ? 2.4 : 1.5) + (is_shadow ? 1.4 : 0.0));
      for (const authoring::ContourSegment& segment : (*contours)[k]) {
        const glm::dvec3 from = pose * segment.from, to = pose * segment.to;
        if (glm::dot(pose.quaternion * segment.normal, eye - from) <= 0) continue;
        const auto a = to_window(from), b = to_window(to);
        if (a && b && !IsTorn(*a, *b, area))
          draw->AddLine(Corner(*a), Corner(*b), is_shadow ? kMarkShadow : ColourOfContour(level),
                        width);
      }
    }
}

void FillModel(const EditorState& state, const Area& area, const glm::dvec3& eye,
               const ToWindow& to_window, double share) {
  const auto index = static_cast<std::size_t>(state.tissue);
  const auto& surface = state.document().surfaces[index];
  if (!surface || !(share > 0)) return;
  const Tissue& tissue = state.document().scene.tissues[index];
  const std::vector<glm::dvec3> x = VerticesOf(*surface, tissue.pose);
  std::vector<std::optional<glm::dvec2>> places;
  places.reserve(x.size());
  for (const glm::dvec3& vertex : x) places.push_back(to_window(vertex));

  // The far triangles first, so that near ones cover them.
  struct Facing {
    double distance, light;
    const std::array<int, 3>* corners;
  };
  std::vector<Facing> facing;
  for (const auto& corners : surface->triangles) {
    const glm::dvec3 &a = x[static_cast<std::size_t>(corners[0])],
                     &b = x[static_cast<std::size_t>(corners[1])],
                     &c = x[static_cast<std::size_t>(corners[2])];
    const glm::dvec3 normal = glm::cross(b - a, c - a), to_eye = eye - (a + b + c) / 3.0;
    const double lengths = glm::length(normal) * glm::length(to_eye);
    if (lengths > 0 && glm::dot(normal, to_eye) > 0)
      facing.push_back({glm::length(to_eye), glm::dot(normal, to_eye) / lengths, &corners});
  }
  std::sort(facing.begin(), facing.end(),
            [](const Facing& a, const Facing& b) { return a.distance > b.distance; });

  const MarkClip clip(area);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  constexpr double kShade = 0.25;  // brightness of a surface along the line of sight
  constexpr double kInverseGamma = 1 / 2.2;
  for (const Facing& one : facing) {
    std::array<ImVec2, 3> corner;
    bool is_whole = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& place = places[static_cast<std::size_t>((*one.corners)[i])];
      const auto& first = places[static_cast<std::size_t>((*one.corners)[0])];
      is_whole = is_whole && place && first && !IsTorn(*place, *first, area);
      if (is_whole) corner[i] = Corner(*place);
    }
    if (!is_whole) continue;
    const double light = kShade + (1 - kShade) * one.light;
    const auto channel = [&](double linear) {
      return static_cast<float>(std::pow(std::clamp(linear * light, 0.0, 1.0), kInverseGamma));
    };
    const ImU32 colour =
        ImGui::GetColorU32({channel(tissue.colour.r), channel(tissue.colour.g),
                            channel(tissue.colour.b), static_cast<float>(std::min(share, 1.0))});
    draw->PrimReserve(3, 3);
    for (const ImVec2& at : corner) draw->PrimVtx(at, white, colour);
  }
}

}  // namespace arthro::app
