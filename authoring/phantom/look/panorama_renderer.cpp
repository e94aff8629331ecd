#include "authoring/phantom/look/panorama_renderer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>

namespace arthro::authoring {
namespace {

// Resolution of the relief, about a micrometre as a power of two; finer bits would only enlarge the
// file.
constexpr double kDepthStep = 0x1p-20;   // m
constexpr double kSilhouette = 0.25e-3;  // m, least step of depth at a silhouette
constexpr int kContrast = 16;            // grey levels of a channel to a neighbour, at an edge
constexpr int kSubpixels = 3;            // per side

double BedShareAt(const Cavity& cavity, const glm::dvec3& x) {
  const glm::dvec3 p = Inverse(cavity.plateau.portal_from_plateau) * x;
  return BedShare(cavity.plateau.bed, p.x, p.y);
}

// Nearest surface with the tissues. Only a tissue's point has a normal.
SurfacePoint PointAt(const PhantomView& view, const glm::dvec3& direction, const CavityHit& hit) {
  SurfacePoint point;
  point.direction = direction;
  point.surface = hit.surface;
  point.x = hit.distance * direction;
  if (!view.tissues) return point;
  const auto tissue = view.tissues->Cast(direction);
  if (tissue && tissue->distance < hit.distance) {
    point.surface = tissue->surface;
    point.x = tissue->distance * direction;
    point.normal = tissue->normal;
    point.rim = tissue->rim;
  } else {
    point.shade = view.tissues->ShadeAt(hit.surface, point.x);
  }
  return point;
}

// Adds the normal and the gap to the wall, which the colour of a point needs.
void Complete(const PhantomView& view, SurfacePoint& point) {
  const Cavity& cavity = view.cavity;
  switch (point.surface) {
    case Surface::kMeniscus:
      return;  // its normal is its mesh's
    case Surface::kCartilage:
      // The layer is flush: its seam shows in colour, not in shading.
      point.normal = NormalAt(cavity, Surface::kPlateau, point.x, false);
      return;
    case Surface::kCondyle:
      point.wall_gap = WallDistance(cavity, point.direction) - glm::length(point.x);
      break;
    default:
      break;
  }
  point.normal = NormalAt(cavity, point.surface, point.x, false);
  // Visible share of the bed's depth: translucent walls show the empty bed as a shallow dimple.
  constexpr double kDimple = 0.22;
  constexpr double kBedReach = 1.02;  // radii of the bed; the step of a normal reaches into it
  if (point.surface == Surface::kPlateau && !view.tissues &&
      BedShareAt(cavity, point.x) < kBedReach)
    point.normal = glm::normalize(
        point.normal + kDimple * (NormalAt(cavity, point.surface, point.x) - point.normal));
}

SurfacePoint PointAlong(const PhantomView& view, const glm::dvec3& direction) {
  SurfacePoint point = PointAt(view, direction, CastFromPortal(view.cavity, direction));
  Complete(view, point);
  return point;
}

glm::dvec3 ColourAlong(const PhantomView& view, const SurfacePoint& point, double exposure) {
  return Develop(Radiance(view.cavity, view.vessels, view.look, point), exposure);
}

// Runs `row` for every row on several threads; rows are independent, so their order does not
// matter.
template <class Row>
void ForEachRow(int rows, int threads, const Progress& progress, const char* stage, double from,
                double to, const Row& row) {
  if (threads <= 0) threads = std::max(1u, std::thread::hardware_concurrency());
  std::atomic<int> next{0};
  const auto work = [&](bool reports) {
    for (int y = next++; y < rows && !progress.ShouldStop(); y = next++) {
      row(y);
      if (reports && progress.report) progress.report(stage, from + (to - from) * y / rows);
    }
  };
  std::vector<std::jthread> crew;
  for (int i = 1; i < threads; ++i) crew.emplace_back(work, false);
  work(true);
  crew.clear();
  progress.Step(stage, to);
}

float ReliefOf(const Cavity& cavity, const SurfacePoint& point) {
  return static_cast<float>(std::round((cavity.radius - glm::length(point.x)) / kDepthStep) *
                            kDepthStep);
}

// True when the tissues change the appearance of this point.
bool ConcernsTissue(const Cavity& cavity, const SurfacePoint& point) {
  if (point.surface == Surface::kMeniscus || point.surface == Surface::kCartilage ||
      point.shade < 1.0)
    return true;
  if (point.surface != Surface::kPlateau) return false;
  // Reach of the bed's effect on the light around it, filled or empty.
  constexpr double kLightReach = 1.9;  // radii of the bed
  return BedShareAt(cavity, point.x) < kLightReach;
}

// Fast rejection: a ray in this direction meets no tissue, and no tissue shades the point it meets.
bool IsFarFromTissues(const TissueCaster& tissues, const PhantomPicture& without,
                      const glm::dvec3& direction, std::size_t pixel) {
  const Surface surface = without.surfaces[pixel];
  return surface != Surface::kPlateau && surface != Surface::kCondyle && !tissues.MayHit(direction);
}

void PutColour(ColourImage& image, int x, int y, const glm::dvec3& colour) {
  for (int i = 0; i < 3; ++i)
    image.at(x, y)[i] =
        static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[i], 0.0, 1.0)));
}

// Marks the pixels that a single sample shows as stairs: at a change of surface, at a discontinuity
// of depth (a steep slope is none), and at a step of colour, as along a crease, where two slopes
// meet without a step of depth. Pixels that only copy another picture are left out, away from drawn
// ones.
std::vector<std::uint8_t> EdgesOf(const PhantomPicture& picture,
                                  const std::vector<std::uint8_t>& is_drawn) {
  const int width = picture.colour.width, height = picture.colour.height;
  std::vector<std::uint8_t> is_edge(is_drawn.size(), 0);
  const auto breaks = [&](std::size_t here, std::size_t step) {
    const std::size_t next = here + step, last = here - step;
    const auto& h = picture.depth.relief;
    if (picture.surfaces[next] != picture.surfaces[here] ||
        picture.surfaces[last] != picture.surfaces[here] ||
        std::abs(h[next] - 2.0f * h[here] + h[last]) > kSilhouette)
      return true;
    const std::uint8_t* rgb = picture.colour.rgb.data();
    for (int c = 0; c < 3; ++c)
      if (std::abs(rgb[3 * next + c] - rgb[3 * here + c]) > kContrast ||
          std::abs(rgb[3 * last + c] - rgb[3 * here + c]) > kContrast)
        return true;
    return false;
  };
  for (int y = 1; y < height - 1; ++y)
    for (int x = 1; x < width - 1; ++x) {
      const std::size_t here = static_cast<std::size_t>(y) * width + x,
                        row = static_cast<std::size_t>(width);
      const bool is_drawn_near = is_drawn[here] || is_drawn[here - 1] || is_drawn[here + 1] ||
                                 is_drawn[here - row] || is_drawn[here + row];
      is_edge[here] = is_drawn_near && (breaks(here, 1) || breaks(here, row));
    }
  return is_edge;
}

}  // namespace

double ExposureOf(const PhantomView& view, const Projection& projection, int width, int height) {
  constexpr int kColumns = 96, kRows = 72;
  std::vector<double> brightness;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const glm::dvec2 pixel((i + 0.5) * width / kColumns - 0.5, (j + 0.5) * height / kRows - 0.5);
      const SurfacePoint point = PointAlong(view, DirectionFromPixel(projection, pixel));
      const glm::dvec3 radiance =
          Radiance(view.cavity, view.vessels, view.look, point) / view.look.light;
      brightness.push_back(glm::dot(radiance, glm::dvec3(0.30, 0.59, 0.11)));
    }
  // The brightest tenth may be compressed.
  const auto bright = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() * 9 / 10);
  std::nth_element(brightness.begin(), bright, brightness.end());
  constexpr double kTarget = 0.74;
  return kTarget / std::max(*bright, 1e-6);
}

PhantomPicture RenderPanorama(const PhantomView& view, const Projection& projection, int width,
                              int height, double exposure, int threads, const Progress& progress,
                              const char* stage, const PhantomPicture* without) {
  PhantomPicture picture{ColourImage(width, height), DepthMap(width, height), {}, {}};
  const auto index = [width](int x, int y) { return static_cast<std::size_t>(y) * width + x; };
  picture.surfaces.resize(index(0, height));
  if (!without) picture.distances.resize(index(0, height));
  std::vector<std::uint8_t> is_drawn(index(0, height), 1);
  ForEachRow(height, threads, progress, stage, 0.0, 0.6, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 direction = DirectionFromPixel(projection, {x, y});
      if (without && IsFarFromTissues(*view.tissues, *without, direction, index(x, y))) {
        is_drawn[index(x, y)] = 0;
        picture.surfaces[index(x, y)] = without->surfaces[index(x, y)];
        picture.depth.at(x, y) = without->depth.at(x, y);
        std::copy_n(without->colour.at(x, y), 3, picture.colour.at(x, y));
        continue;
      }
      const CavityHit hit =
          without ? CavityHit{without->distances[index(x, y)], without->surfaces[index(x, y)]}
                  : CastFromPortal(view.cavity, direction);
      if (!without) picture.distances[index(x, y)] = hit.distance;
      SurfacePoint point = PointAt(view, direction, hit);
      picture.surfaces[index(x, y)] = point.surface;
      picture.depth.at(x, y) = ReliefOf(view.cavity, point);
      if (without && !ConcernsTissue(view.cavity, point)) {
        is_drawn[index(x, y)] = 0;
        std::copy_n(without->colour.at(x, y), 3, picture.colour.at(x, y));
      } else {
        Complete(view, point);
        PutColour(picture.colour, x, y, ColourAlong(view, point, exposure));
      }
    }
  });
  // Marked before any pixel changes, so that the order of the rows does not matter.
  const std::vector<std::uint8_t> is_edge = EdgesOf(picture, is_drawn);
  ForEachRow(height, threads, progress, stage, 0.6, 1.0, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (!is_edge[index(x, y)]) continue;
      glm::dvec3 sum(0.0);
      for (int j = 0; j < kSubpixels; ++j)
        for (int i = 0; i < kSubpixels; ++i) {
          const glm::dvec2 pixel(x + (i + 0.5) / kSubpixels - 0.5,
                                 y + (j + 0.5) / kSubpixels - 0.5);
          sum +=
              ColourAlong(view, PointAlong(view, DirectionFromPixel(projection, pixel)), exposure);
        }
      PutColour(picture.colour, x, y, sum / static_cast<double>(kSubpixels * kSubpixels));
    }
  });
  return picture;
}

}  // namespace arthro::authoring
