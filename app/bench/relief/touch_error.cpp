#include "app/bench/relief/touch_error.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "simulation/haptics/contact.h"

namespace arthro::app {
namespace {

using namespace simulation;

constexpr double kSphere = 0.08;  // m, outside of every surface
constexpr double kTick = 1e-3;    // s
constexpr int kTicks = 200;       // until the force of a tip at rest has settled

DepthField FieldOf(const test::FoundSurface& found, const Projection& projection) {
  Backdrop backdrop;
  backdrop.radius = kSphere;
  backdrop.projection = projection;
  DepthMap depth = found.radius;
  for (float& h : depth.relief) h = static_cast<float>(kSphere) - h;
  // The grid is coarse, so the force fades within one cell.
  DepthFieldOptions options;
  options.fade_px = 1;
  return {backdrop, depth, options, found.sigma};
}

glm::dvec3 ForceAt(const DepthField& field, const glm::dvec3& tip) {
  const ContactOptions options;
  ContactState state;
  ContactForce contact;
  for (int i = 0; i < kTicks; ++i)
    contact = TickContact({field, {}}, options, options.stiffness, {}, tip, kTick, state);
  return contact.force;
}

}  // namespace

TouchError MeasureTouches(const test::FoundSurface& found, const test::TrueSurface& truth,
                          int touches, int seed) {
  constexpr int kAround = 3;  // cells about a touch that three frames see
  constexpr int kLeastFrames = 3;
  const DepthField should = FieldOf({truth.radius, {}}, truth.projection),
                   is = FieldOf(found, truth.projection);
  std::mt19937 random(static_cast<unsigned>(seed));
  const int width = truth.radius.width, height = truth.radius.height;
  std::uniform_int_distribution<int> column(kAround, width - 1 - kAround),
      row(kAround, height - 1 - kAround);
  std::uniform_real_distribution<double> below(2e-4, 2e-3);  // m
  TouchError error;
  double squares = 0, true_squares = 0;
  for (int tries = 0; error.touches < touches && tries < 1000 * touches; ++tries) {
    const int x = column(random), y = row(random);
    const double depth = below(random);
    bool is_seen = true;
    for (int j = -kAround; j <= kAround && is_seen; ++j)
      for (int i = -kAround; i <= kAround && is_seen; ++i)
        is_seen = truth.seen_by[static_cast<std::size_t>(y + j) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x + i)] >= kLeastFrames;
    if (!is_seen) continue;
    const glm::dvec3 tip = (static_cast<double>(truth.radius.at(x, y)) + depth) *
                           DirectionFromPixel(truth.projection, {x, y});
    const glm::dvec3 right = ForceAt(should, tip), made = ForceAt(is, tip);
    ++error.touches;
    squares += glm::dot(made - right, made - right);
    true_squares += glm::dot(right, right);
    error.felt += glm::length(made) > 0 ? 1 : 0;
  }
  if (error.touches == 0) return error;
  const double count = error.touches;
  error.rms = std::sqrt(squares / count);
  error.true_rms = std::sqrt(true_squares / count);
  error.felt /= count;
  return error;
}

}  // namespace arthro::app
