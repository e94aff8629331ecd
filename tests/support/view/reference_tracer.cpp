#include "tests/support/view/reference_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace arthro::test {
namespace {

// Columns are the images of the axes.
glm::dmat3 TurnX(double a) {
  return {{1, 0, 0}, {0, std::cos(a), std::sin(a)}, {0, -std::sin(a), std::cos(a)}};
}
glm::dmat3 TurnY(double a) {
  return {{std::cos(a), 0, -std::sin(a)}, {0, 1, 0}, {std::sin(a), 0, std::cos(a)}};
}
glm::dmat3 TurnZ(double a) {
  return {{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1}};
}

// A triangle as seen from the tip, with the cone about it, so that most rays pass it by at once.
struct SeenTriangle {
  glm::dvec3 corner, edge1, edge2;  // relative to the tip
  glm::dvec3 middle;                // unit
  double cos_cone;                  // cosine of the cone's half angle; -1 for all directions
  int mesh;
};

std::vector<SeenTriangle> SeeTriangles(std::span<const ReferenceMesh> meshes,
                                       const glm::dvec3& tip) {
  std::vector<SeenTriangle> seen;
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (const auto& corners : meshes[m].surface->triangles) {
      std::array<glm::dvec3, 3> p;
      for (int i = 0; i < 3; ++i) p[i] = meshes[m].surface->vertices[corners[i]] - tip;
      const glm::dvec3 centroid = (p[0] + p[1] + p[2]) / 3.0;
      double reach = 0.0;
      for (const glm::dvec3& corner : p) reach = std::max(reach, glm::length(corner - centroid));
      const double distance = glm::length(centroid);
      const double sine = distance > 0.0 ? reach / distance : 2.0;
      SeenTriangle triangle{p[0], p[1] - p[0], p[2] - p[0], {0, 0, 1}, -1.0, static_cast<int>(m)};
      if (sine < 1.0) {
        triangle.middle = centroid / distance;
        triangle.cos_cone = std::sqrt(1.0 - sine * sine) - 1e-9;
      }
      seen.push_back(triangle);
    }
  return seen;
}

// Distance along the unit ray from the tip; nothing if it misses. Cramer's rule for
// s d - a e1 - b e2 = c.
std::optional<double> MeetTriangle(const SeenTriangle& triangle, const glm::dvec3& ray) {
  const glm::dvec3 normal = glm::cross(triangle.edge1, triangle.edge2);
  const double determinant = glm::dot(ray, normal);
  if (determinant == 0.0) return std::nullopt;
  const glm::dvec3 across = glm::cross(ray, triangle.corner);
  const double a = -glm::dot(across, triangle.edge2) / determinant;
  const double b = glm::dot(across, triangle.edge1) / determinant;
  const double s = glm::dot(triangle.corner, normal) / determinant;
  if (a < 0.0 || b < 0.0 || a + b > 1.0 || s <= 0.0) return std::nullopt;
  return s;
}

std::uint8_t Byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l));
}

}  // namespace

simulation::ScopeView ReferenceView(const ReferencePose& pose) {
  const double head = pose.head_roll.value_or(pose.roll) - pose.roll;
  const glm::dmat3 rod = TurnY(pose.longitude) * TurnX(pose.latitude);
  const glm::dmat3 camera = rod * TurnZ(pose.roll) * TurnX(pose.view_angle) * TurnZ(head);
  return {pose.depth * rod[2], camera[2], -camera[1], camera[0]};
}

std::optional<glm::dvec3> ReferenceRay(const simulation::ScopeView& view, double field_of_view,
                                       int size, const glm::dvec2& pixel, const Lens* lens) {
  const double half = 0.5 * size;
  const glm::dvec2 q = (pixel + 0.5 - half) / half;  // 1 at the rim
  if (glm::dot(q, q) > 1.0) return std::nullopt;
  if (lens) {
    const auto ray =
        RayFromPixel(*lens, glm::dvec2(lens->circle.cx, lens->circle.cy) + lens->circle.r * q);
    if (!ray) return std::nullopt;
    return ray->x * view.right - ray->y * view.up + ray->z * view.view;
  }
  // Equal-area: with s = sin(θ/2) q, cos θ = 1 − 2 s² and sin θ = 2 s √(1 − s²).
  const glm::dvec2 s = q * std::sin(0.25 * field_of_view);
  const double s2 = glm::dot(s, s);
  const glm::dvec2 across = 2.0 * std::sqrt(1.0 - s2) * s;
  return across.x * view.right - across.y * view.up + (1.0 - 2.0 * s2) * view.view;
}

std::optional<glm::dvec3> ReferenceSphereHit(const glm::dvec3& origin, const glm::dvec3& direction,
                                             double radius) {
  const double along = -glm::dot(origin, direction);
  const glm::dvec3 foot = origin + along * direction;
  const double half_chord2 = radius * radius - glm::dot(foot, foot);
  if (half_chord2 < 0.0) return std::nullopt;
  const double half_chord = std::sqrt(half_chord2);
  if (along + half_chord < 0.0) return std::nullopt;
  return foot + half_chord * direction;
}

std::optional<glm::dvec2> ReferencePixel(const Projection& projection,
                                         const glm::dvec3& direction) {
  const double x = direction.x, y = direction.y, z = direction.z;
  if (projection.type == ProjectionType::kGnomonic) {
    if (z <= 1e-9) return std::nullopt;
    return glm::dvec2(projection.centre_px.x + projection.focal_px * (x / z),
                      projection.centre_px.y + projection.focal_px * (y / z));
  }
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const double longitude = kDegrees * std::atan2(x, z);
  const double latitude = kDegrees * std::atan2(-y, std::hypot(x, z));
  return glm::dvec2(projection.centre_px.x + projection.px_per_deg * longitude,
                    projection.centre_px.y - projection.px_per_deg * latitude);
}

std::optional<glm::dvec3> ReferenceReliefHit(const Backdrop& backdrop, const DepthMap& depth,
                                             const glm::dvec3& origin,
                                             const glm::dvec3& direction) {
  const auto sphere = ReferenceSphereHit(origin, direction, backdrop.radius);
  if (!sphere) return std::nullopt;
  const auto relief = [&](int x, int y) {
    const double h = static_cast<double>(depth.at(x, y));
    return std::isfinite(h) ? h : 0.0;
  };
  const auto is_behind = [&](const glm::dvec3& x) {
    double h = 0.0;
    const auto pixel = ReferencePixel(backdrop.projection, x);
    if (pixel) {  // the relief of the panorama's edge goes on beyond it
      const double u = std::clamp(pixel->x, 0.0, depth.width - 1.0);
      const double v = std::clamp(pixel->y, 0.0, depth.height - 1.0);
      const int i = std::min(static_cast<int>(u), depth.width - 2);
      const int j = std::min(static_cast<int>(v), depth.height - 2);
      const double right = relief(i + 1, j) + (v - j) * (relief(i + 1, j + 1) - relief(i + 1, j));
      const double left = relief(i, j) + (v - j) * (relief(i, j + 1) - relief(i, j));
      h = left + (u - i) * (right - left);
    }
    return glm::length(x) > backdrop.radius - h;
  };
  const double whole = glm::dot(*sphere - origin, direction);
  double before = 0.0;
  // A lens that is behind the relief sees from there until it is out.
  bool was_behind = is_behind(origin);
  const double step = backdrop.radius / 2000;
  for (double t = step; t < whole; t += step) {
    const bool is = is_behind(origin + t * direction);
    if (is && !was_behind) {
      double low = before, high = t;
      while (high - low > 1e-12 * backdrop.radius) {
        const double middle = 0.5 * (low + high);
        (is_behind(origin + middle * direction) ? high : low) = middle;
      }
      return origin + low * direction;
    }
    was_behind = is;
    before = t;
  }
  return sphere;
}

std::optional<glm::dvec2> PanoramaPixelAt(const Backdrop& backdrop,
                                          const simulation::ScopeView& view, double field_of_view,
                                          int size, const glm::dvec2& pixel, const Lens* lens) {
  const auto ray = ReferenceRay(view, field_of_view, size, pixel, lens);
  if (!ray) return std::nullopt;
  const auto hit = ReferenceSphereHit(view.tip, *ray, backdrop.radius);
  if (!hit) return std::nullopt;
  return ReferencePixel(backdrop.projection, *hit / backdrop.radius);
}

glm::dvec3 ReferenceColour(const ColourImage& panorama, const glm::dvec2& pixel) {
  const double right = panorama.width - 1.0, bottom = panorama.height - 1.0;
  if (!(pixel.x >= -0.5 && pixel.x <= right + 0.5 && pixel.y >= -0.5 && pixel.y <= bottom + 0.5))
    return glm::dvec3(0.0);
  const double x = std::clamp(pixel.x, 0.0, right), y = std::clamp(pixel.y, 0.0, bottom);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, panorama.width - 1), y1 = std::min(y0 + 1, panorama.height - 1);
  const double fx = x - x0, fy = y - y0;
  const auto colour = [&](int i, int j) {
    const std::uint8_t* rgb = panorama.at(i, j);
    return glm::dvec3(rgb[0], rgb[1], rgb[2]);
  };
  return (1 - fy) * ((1 - fx) * colour(x0, y0) + fx * colour(x1, y0)) +
         fy * ((1 - fx) * colour(x0, y1) + fx * colour(x1, y1));
}

std::vector<TracedRay> TraceRays(const Backdrop& backdrop, const ColourImage& panorama,
                                 const glm::dvec3& tip, std::span<const glm::dvec3> rays,
                                 std::span<const ReferenceMesh> meshes, const DepthMap* depth) {
  const std::vector<SeenTriangle> triangles = SeeTriangles(meshes, tip);
  std::vector<TracedRay> traced(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const glm::dvec3& ray = rays[i];
    TracedRay& met = traced[i];
    double closest = INFINITY;
    const auto hit = depth ? ReferenceReliefHit(backdrop, *depth, tip, ray)
                           : ReferenceSphereHit(tip, ray, backdrop.radius);
    if (hit) {
      closest = glm::dot(*hit - tip, ray);
      met.what = TracedRay::kBackdrop;
      if (const auto pixel = ReferencePixel(backdrop.projection, *hit))
        met.colour = ReferenceColour(panorama, *pixel);
    }
    for (const SeenTriangle& triangle : triangles) {
      if (glm::dot(triangle.middle, ray) < triangle.cos_cone) continue;
      const auto distance = MeetTriangle(triangle, ray);
      if (!distance || *distance >= closest) continue;
      closest = *distance;
      met.what = 1 + triangle.mesh;
      met.colour = meshes[static_cast<std::size_t>(triangle.mesh)].colour;
    }
    if (met.what != TracedRay::kNothing) met.distance = closest;
  }
  return traced;
}

TracedPicture TraceWindow(const Backdrop& backdrop, const ColourImage& panorama,
                          const simulation::ScopeView& view, double field_of_view, int size,
                          std::span<const ReferenceMesh> meshes, const DepthMap* depth,
                          const Lens* lens) {
  TracedPicture picture;
  picture.colours = ColourImage(size, size);
  picture.what.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size),
                      TracedPicture::kOutside);
  picture.distance.assign(picture.what.size(), 0.0);
  std::vector<glm::dvec3> rays;
  std::vector<std::size_t> pixels;  // one per ray
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if (const auto ray = ReferenceRay(view, field_of_view, size, {x, y}, lens)) {
        rays.push_back(*ray);
        pixels.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                         static_cast<std::size_t>(x));
      }
  const std::vector<TracedRay> traced =
      TraceRays(backdrop, panorama, view.tip, rays, meshes, depth);
  for (std::size_t i = 0; i < traced.size(); ++i) {
    picture.what[pixels[i]] = traced[i].what;
    picture.distance[pixels[i]] = traced[i].distance;
    for (std::size_t c = 0; c < 3; ++c)
      picture.colours.rgb[3 * pixels[i] + c] = Byte(traced[i].colour[static_cast<int>(c)]);
  }
  return picture;
}

}  // namespace arthro::test
