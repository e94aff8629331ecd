#include "app/view/drawing/metered_models.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "app/view/shaders/constants.h"

namespace arthro::app {
namespace {

constexpr float kNearestMetered = kNearest;  // m
// Cosine to the view's axis; nothing beyond it is in any lens' view.
constexpr float kBehind = -0.5f;

// Returns a tissue's diffuse light by its cosine to the lens, as in model_fragment.glsl.
float FacingLight(float facing, bool is_plate) {
  if (is_plate) return kRelitAmbient + (1 - kRelitAmbient) * facing;
  constexpr float kEdge = kWhiteFacing, kOver = kWrap, kLeast = kAmbient;
  constexpr float kScattered = 0.745f;  // luma of the shader's kScattered
  const float t = std::min(facing / kEdge, 1.0f);
  const float scattered = kScattered + (1 - kScattered) * t * t * (3 - 2 * t);
  return scattered * (kLeast + (1 - kLeast) * (facing + kOver) / (1 + kOver));
}

float Cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

float Fraction(float x) { return x - std::floor(x); }

// Column of the places that a window place lies in, clamped; with y downwards its row.
int CellOf(float place) {
  constexpr float kLast = MeteredModels::kAcross - 1;
  return static_cast<int>(std::clamp((place + 1) * 0.5f * MeteredModels::kAcross, 0.0f, kLast));
}

}  // namespace

glm::vec2 MeteredModels::WindowPlace(int column, int row) noexcept {
  // Lattice of the plastic number [Roberts 2018] in each cell: evenly spread, with no alignment.
  constexpr float kFirst = 0.7548777f, kSecond = 0.5698403f;
  const auto i = static_cast<float>(column), j = static_cast<float>(row);
  const float x = i + Fraction(kFirst * i + kSecond * j);
  const float y = j + Fraction(kSecond * i + kFirst * j + 0.37f);
  constexpr float kScale = 2.0f / kAcross;
  return {kScale * x - 1, 1 - kScale * y};
}

MeteredModels::MeteredModels() : places_(kAcross * kAcross) {
  window_places_.reserve(places_.size());
  for (int row = 0; row < kAcross; ++row)
    for (int column = 0; column < kAcross; ++column)
      window_places_.push_back(WindowPlace(column, row));
}

void MeteredModels::Begin(const simulation::ScopeView& view,
                          const simulation::ScopeOptics& optics) {
  view_ = view;
  optics_ = optics;
  place_scale_ = static_cast<float>(1 / std::sin(0.25 * optics.field_of_view));
  if (has_any_) std::fill(places_.begin(), places_.end(), Place());
  has_any_ = false;
}

void MeteredModels::Draw(const MeteredSurface& surface) {
  // Double precision until the tip is subtracted.
  const glm::dmat3 lens_from_portal = glm::transpose(glm::dmat3(view_.right, view_.up, view_.view));
  const Pose& pose = surface.portal_from_surface;
  const glm::mat3 turn(lens_from_portal * glm::mat3_cast(pose.quaternion) * pose.scale);
  const glm::vec3 shift(lens_from_portal * (pose.position - view_.tip));
  const bool has_lens = !simulation::IsEquisolid(optics_.lens);
  const glm::vec2 axis(optics_.lens.axis);
  const std::size_t count = surface.xyz.size() / 3;
  corners_.resize(std::max(corners_.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    Corner& corner = corners_[i];
    const float* x = &surface.xyz[3 * i];
    corner.point = turn * glm::vec3(x[0], x[1], x[2]) + shift;
    const float distance = glm::length(corner.point);
    const bool is_ahead =
        distance >= kNearestMetered && distance < 1.0f && corner.point.z > kBehind * distance;
    corner.per_distance = is_ahead ? 1 / distance : 0;
    if (!is_ahead) continue;
    // Same formula as the shader: sin(θ/2) = sin θ / (2 cos(θ/2)).
    const float half_cosine = std::sqrt(0.5f + 0.5f * corner.point.z * corner.per_distance);
    corner.place =
        glm::vec2(corner.point) * (corner.per_distance * 0.5f * place_scale_ / half_cosine);
    if (has_lens)
      corner.place =
          axis + corner.place *
                     static_cast<float>(simulation::LensFactor(
                         optics_.lens.outward,
                         std::min<double>(glm::dot(corner.place, corner.place), optics_.lens.end)));
  }
  for (const auto& t : surface.triangles)
    DrawTriangle(corners_[static_cast<std::size_t>(t[0])], corners_[static_cast<std::size_t>(t[1])],
                 corners_[static_cast<std::size_t>(t[2])], surface);
}

void MeteredModels::DrawTriangle(const Corner& a, const Corner& b, const Corner& c,
                                 const MeteredSurface& surface) {
  if (!(a.per_distance > 0 && b.per_distance > 0 && c.per_distance > 0)) return;
  // Counter-clockwise in the window (y up) when seen from outside.
  const glm::vec2 ab = b.place - a.place, ac = c.place - a.place;
  const float twice = Cross(ab, ac);
  if (!(surface.is_closed ? twice > 0 : twice != 0)) return;
  const glm::vec2 low = glm::min(glm::min(a.place, b.place), c.place);
  const glm::vec2 high = glm::max(glm::max(a.place, b.place), c.place);
  if (!(low.x < 1 && low.y < 1 && high.x > -1 && high.y > -1)) return;
  const float per = 1 / twice;
  const int first_column = CellOf(low.x), last_column = CellOf(high.x);
  const int last_row = CellOf(-low.y);
  float light = -1;
  for (int row = CellOf(-high.y); row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column) {
      const auto index = IndexOf(column, row);
      const glm::vec2& at = window_places_[index];
      const float v = Cross(at - a.place, ac) * per, w = Cross(ab, at - a.place) * per;
      if (!(v >= 0 && w >= 0 && v + w <= 1) || glm::dot(at, at) > 1) continue;
      const float distance =
          1 / ((1 - v - w) * a.per_distance + v * b.per_distance + w * c.per_distance);
      Place& place = places_[index];
      if (place.distance > 0 && place.distance <= distance) continue;
      if (light < 0) {
        const glm::vec3 normal = glm::cross(b.point - a.point, c.point - a.point);
        const float size = glm::length(normal) * glm::length(a.point);
        const float facing = size > 0 ? std::abs(glm::dot(normal, a.point)) / size : 0.0f;
        light = static_cast<float>(surface.luma) * FacingLight(facing, surface.is_plate);
      }
      place = {distance, light};
      has_any_ = true;
    }
}

}  // namespace arthro::app
