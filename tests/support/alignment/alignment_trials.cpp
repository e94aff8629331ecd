#include "tests/support/alignment/alignment_trials.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/look/tissue_caster.h"
#include "authoring/phantom/phantom.h"
#include "authoring/phantom/shape/cavity.h"
#include "authoring/project/estimated_depth.h"
#include "simulation/core/geometry/box3.h"
#include "simulation/core/random.h"

namespace arthro::test {
namespace {

using authoring::LandmarkPair;

constexpr int kPictureSize = 512;        // px
constexpr double kLeastWrong = 5e-3;     // m, of a wrong partner from the right one
constexpr double kVisibleWithin = 3e-4;  // m, of a vertex from what the line to it meets

double Normal(Random& random) {  // Box-Muller
  const double u = random.Uniform(1e-12, 1.0), v = random.Uniform(0.0, 1.0);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

// The exact relief of the phantom with its tissues in place.
LoadedScene SceneWith(const authoring::Cavity& cavity,
                      const std::vector<authoring::PhantomTissue>& tissues) {
  authoring::TissueCaster caster;
  for (const auto& tissue : tissues)
    caster.Add(authoring::InPortal(tissue), authoring::Surface::kMeniscus, tissue.rims);
  caster.Sort();
  authoring::PhantomOptions options;
  options.size = authoring::PhantomSize::kSmall;
  const authoring::PhantomFrame frame = authoring::FrameOf(options);
  LoadedScene loaded;
  loaded.scene.backdrop.radius = cavity.radius;
  loaded.scene.backdrop.projection = frame.projection;
  DepthMap depth(frame.width, frame.height);
  for (int v = 0; v < frame.height; ++v)
    for (int u = 0; u < frame.width; ++u) {
      const glm::dvec3 direction = DirectionFromPixel(frame.projection, {u, v});
      double distance = authoring::CastFromPortal(cavity, direction).distance;
      if (caster.MayHit(direction))
        if (const auto hit = caster.Cast(direction)) distance = std::min(distance, hit->distance);
      depth.at(u, v) = static_cast<float>(cavity.radius - distance);
    }
  loaded.depth = Share(std::move(depth));
  return loaded;
}

// A scope that looks at about the middle of the tissue.
simulation::ScopeView ViewOf(const AlignmentCase& one, Random& random) {
  const glm::dvec3 middle = one.tissue.portal_from_tissue.position;
  const double alpha = one.scene.scene.scope.view_angle;
  simulation::ScopeView best;
  double most = -2;
  // The best of some random poses: nobody clicks in a picture that shows little of the tissue.
  for (int i = 0; i < 40; ++i) {
    const simulation::RodPose pose{random.Uniform(-0.8, 0.8), random.Uniform(-0.8, 0.8),
                                   random.Uniform(-std::numbers::pi, std::numbers::pi),
                                   random.Uniform(0.004, 0.012)};
    const simulation::ScopeView view = simulation::ViewFromPose(pose, alpha);
    const double towards = glm::dot(view.view, glm::normalize(middle - view.tip));
    if (towards > most) most = towards, best = view;
  }
  return best;
}

glm::dvec2 PixelOf(const simulation::ScopeOptics& optics, const simulation::ScopeView& view,
                   const glm::dvec3& x) {
  const glm::dvec2 place = simulation::PlaceOf(optics, view, x - view.tip);
  const double radius = 0.5 * kPictureSize, middle = 0.5 * (kPictureSize - 1);
  return {middle + radius * place.x, middle - radius * place.y};
}

std::optional<authoring::ScenePoint> Click(const AlignmentCase& one,
                                           const simulation::ScopeOptics& optics,
                                           const simulation::ScopeView& view,
                                           const glm::dvec2& pixel) {
  const auto sight = authoring::SightOfScope(optics, view, kPictureSize, pixel);
  return sight ? authoring::PointOnRelief(one.scene, *sight) : std::nullopt;
}

// Click on a landmark: in a guessed relief the range is another one than that of what is seen.
std::optional<authoring::ScenePoint> PlaceLandmark(const AlignmentCase& one,
                                                   const simulation::ScopeOptics& optics,
                                                   const simulation::ScopeView& view,
                                                   const glm::dvec2& pixel) {
  if (!one.guess) return Click(one, optics, view, pixel);
  const auto sight = authoring::SightOfScope(optics, view, kPictureSize, pixel);
  return sight ? authoring::PointOnRelief(*one.guess, *sight, ReliefOrigin::kBrightness)
               : std::nullopt;
}

// Vertices that the picture shows, tissue frame.
std::vector<glm::dvec3> VisibleVertices(const AlignmentCase& one,
                                        const simulation::ScopeOptics& optics,
                                        const simulation::ScopeView& view) {
  std::vector<glm::dvec3> visible;
  const auto& vertices = one.tissue.surface.vertices;
  const std::size_t stride = std::max<std::size_t>(1, vertices.size() / 150);
  for (std::size_t i = 0; i < vertices.size(); i += stride) {
    const glm::dvec3 x = one.tissue.portal_from_tissue * vertices[i];
    const auto point = Click(one, optics, view, PixelOf(optics, view, x));
    if (point && glm::distance(point->x_in_portal, x) < kVisibleWithin)
      visible.push_back(vertices[i]);
  }
  return visible;
}

// Landmarks far from each other, as a person spreads them: the first at random.
std::vector<glm::dvec3> Spread(const std::vector<glm::dvec3>& from, int count, Random& random) {
  std::vector<glm::dvec3> chosen{from[random.Below(from.size())]};
  while (static_cast<int>(chosen.size()) < count) {
    const auto nearest = [&](const glm::dvec3& x) {
      double least = 1e9;
      for (const glm::dvec3& other : chosen) least = std::min(least, glm::distance(x, other));
      return least;
    };
    chosen.push_back(*std::max_element(from.begin(), from.end(), [&](const auto& a, const auto& b) {
      return nearest(a) < nearest(b);
    }));
  }
  return chosen;
}

}  // namespace

std::vector<AlignmentCase> MakeAlignmentCases(int phantoms, bool shows_tissues) {
  std::vector<AlignmentCase> cases;
  for (int seed = 1; seed <= phantoms; ++seed) {
    const authoring::Cavity cavity = authoring::MakeCavity(static_cast<std::uint32_t>(seed));
    const std::vector<authoring::PhantomTissue> tissues{authoring::MakeMeniscus(cavity),
                                                        authoring::MakeCartilage(cavity)};
    const LoadedScene scene =
        SceneWith(cavity, shows_tissues ? tissues : std::vector<authoring::PhantomTissue>{});
    for (const auto& tissue : tissues) cases.push_back({scene, tissue, {}});
  }
  return cases;
}

std::vector<AlignmentCase> MakeGuessedCases(int phantoms) {
  std::vector<AlignmentCase> cases = MakeAlignmentCases(phantoms);
  for (int seed = 1; seed <= phantoms; ++seed) {
    authoring::PhantomOptions options;
    options.seed = seed;
    options.size = authoring::PhantomSize::kSmall;
    const authoring::Phantom phantom = authoring::MakePhantom(options);
    AlignmentCase* const of_seed = &cases[2 * static_cast<std::size_t>(seed - 1)];
    LoadedScene guess = of_seed->scene;
    const authoring::EstimatedDepth estimated = authoring::EstimateDepth(
        phantom.with_tissues.colour, {}, nullptr, guess.scene.backdrop, {});
    guess.depth = estimated.depth;
    guess.depth_sigma = estimated.sigma;
    of_seed[0].guess = of_seed[1].guess = guess;
  }
  return cases;
}

std::vector<Trial> MakeTrials(const std::vector<AlignmentCase>& cases,
                              const TrialOptions& options) {
  std::vector<Trial> trials;
  Random random(options.seed);
  const auto sigma =
      Share(DepthMap(cases.front().scene.depth->width, cases.front().scene.depth->height,
                     static_cast<float>(options.relief_sigma)));
  const simulation::ScopeOptics optics;
  while (static_cast<int>(trials.size()) < options.trials) {
    const AlignmentCase& clean = cases[trials.size() % cases.size()];
    AlignmentCase one = clean;
    if (options.relief_sigma > 0) one.scene.depth_sigma = sigma;
    const simulation::ScopeView view = ViewOf(one, random);
    const auto visible = VisibleVertices(one, optics, view);
    const int count = options.fewest + static_cast<int>(random.Below(static_cast<std::uint64_t>(
                                           options.most - options.fewest + 1)));
    if (static_cast<int>(visible.size()) < 4 * count) continue;
    std::vector<LandmarkPair> pairs;
    for (const glm::dvec3& x : Spread(visible, count, random)) {
      const glm::dvec2 pixel = PixelOf(optics, view, one.tissue.portal_from_tissue * x);
      const glm::dvec2 noise(Normal(random), Normal(random));
      const auto point = PlaceLandmark(one, optics, view, pixel + options.click_noise * noise);
      if (!point) break;
      LandmarkPair& pair = pairs.emplace_back();
      pair.x_in_tissue =
          x + options.model_noise * glm::dvec3(Normal(random), Normal(random), Normal(random));
      pair.scene = *point;
    }
    if (static_cast<int>(pairs.size()) < count) continue;
    const std::size_t wrong = random.Below(pairs.size());
    if (options.has_wrong_pair) {
      const glm::dvec3 right = pairs[wrong].scene.x_in_portal;
      std::optional<authoring::ScenePoint> other;
      while (!other || glm::distance(other->x_in_portal, right) < kLeastWrong)
        other = Click(one, optics, view,
                      {random.Uniform(0, kPictureSize), random.Uniform(0, kPictureSize)});
      pairs[wrong].scene = *other;
    }
    trials.push_back({&clean, std::move(pairs), wrong});
  }
  return trials;
}

TrialErrors RunTrials(const std::vector<AlignmentCase>& cases, const TrialOptions& options) {
  TrialErrors errors;
  for (const Trial& trial : MakeTrials(cases, options)) {
    const AlignmentCase& one = *trial.one;
    const auto& pairs = trial.pairs;
    const auto begun = std::chrono::steady_clock::now();
    const authoring::LandmarkAlignment found =
        authoring::AlignLandmarks(pairs, {}, one.tissue.surface, options.options);
    errors.seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
    errors.iterations += found.iterations;
    errors.most_iterations = std::max(errors.most_iterations, found.iterations);
    if (!found.is_aligned()) {
      ++errors.refused;
      continue;
    }
    Box3 box = kEmptyBox;
    for (const glm::dvec3& x : one.tissue.surface.vertices) box = Union(box, {x, x});
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const Pose &truth = one.tissue.portal_from_tissue, &pose = found.portal_from_tissue;
    const double position = glm::distance(truth * middle, pose * middle);
    const double rotation =
        2.0 * std::acos(std::min(1.0, std::abs(glm::dot(truth.quaternion, pose.quaternion))));
    errors.position.push_back(position);
    errors.rotation.push_back(rotation);
    errors.position_over_sigma.push_back(position / found.position_sigma);
    errors.rotation_over_sigma.push_back(rotation / found.rotation_sigma);
    int left_out = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) left_out += found.residuals[i].is_wrong;
    const bool is_named = options.has_wrong_pair && found.residuals[trial.wrong].is_wrong;
    errors.wrong_named += is_named;
    errors.wrong_found += is_named && left_out == 1;
    errors.false_alarms += left_out - is_named;
    errors.good_pairs += static_cast<int>(pairs.size()) - options.has_wrong_pair;
  }
  return errors;
}

}  // namespace arthro::test
