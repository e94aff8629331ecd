#include "authoring/models/soft_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/disc_layer.h"
#include "authoring/phantom/shape/noise.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

struct Box {
  glm::dvec3 low{1e9}, high{-1e9};
};
Box BoxOf(const SurfaceMesh& surface) {
  Box box;
  for (const glm::dvec3& x : surface.vertices) {
    box.low = glm::min(box.low, x);
    box.high = glm::max(box.high, x);
  }
  return box;
}

void MirrorFor(KneeSide side, LibraryModel& model) {
  if (side == KneeSide::kLeft) Mirror(model);
}

// Direction at a share of the way from the pole to the equator, short of it by half a ring.
glm::dvec3 OnHalfSphere(double share, double angle, int rings) {
  const double polar = share * kQuarterTurn * (1.0 - 0.5 / rings);
  return {std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
}

}  // namespace

LibraryModel MakeLooseBody(const LooseBodyOptions& options, KneeSide side) {
  LooseBodyOptions checked = options;
  CheckOptions(checked);
  constexpr int kRings = 16;
  constexpr double kBumps = 0.10, kBumpSize = 1.3;  // share of the radius; per radius
  const auto seed = static_cast<std::uint32_t>(options.seed);
  LibraryModel model;
  model.name = "loose body";
  model.material = "cartilage";
  model.colour = {0.88, 0.86, 0.80};
  model.is_solid = true;
  model.surface = DiscLayer(kRings, 1.0, [&](double share, double angle, bool is_top) {
    glm::dvec3 to = OnHalfSphere(share, angle, kRings);
    if (!is_top) to.z = -to.z;
    const double bump = FractalNoise(kBumpSize * to, 3, seed);
    return (1.0 + kBumps * bump) *
           glm::dvec3(to.x, 0.5 * (1.0 + options.flatness) * to.y, options.flatness * to.z);
  });
  const Box box = BoxOf(model.surface);
  const glm::dvec3 base(0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y), box.low.z);
  const double scale = options.length / (box.high.x - box.low.x);
  for (glm::dvec3& x : model.surface.vertices) x = scale * (x - base);
  const Box made = BoxOf(model.surface);
  const glm::dvec3 size = made.high - made.low;
  model.sizes = {{std::max({size.x, size.y, size.z}), &kLooseBodyLength}};
  MirrorFor(side, model);
  return model;
}

LibraryModel MakeSynovialTuft(const SynovialTuftOptions& options, KneeSide side) {
  SynovialTuftOptions checked = options;
  CheckOptions(checked);
  constexpr int kRings = 34;
  constexpr double kSharpness = 30.0;  // a villus has half its height about 12° off its axis
  constexpr double kLean = 50.0;       // degrees from the base's normal, the outermost villus
  constexpr double kRoot = 0.32;       // radius of the base over the length of a villus
  Random random(0x7BF7ull + static_cast<std::uint64_t>(options.seed));
  struct Villus {
    glm::dvec3 to;
    double length;
  };
  std::vector<Villus> villi;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < options.villi; ++i) {
    const double lean = RadiansFromDegrees(kLean) * std::sqrt(static_cast<double>(i) / 6.0);
    const double polar = std::min(lean, RadiansFromDegrees(62)) * random.Near(1.0, 0.12);
    const double angle = golden * i + random.Uniform(-0.25, 0.25);
    villi.push_back(
        {{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)},
         i == 0 ? 1.0 : random.Uniform(0.62, 0.92)});
  }
  LibraryModel model;
  model.name = "synovial tuft";
  model.material = "synovium";
  model.colour = {0.72, 0.36, 0.30};
  model.is_solid = true;
  const double root = kRoot * options.length;
  model.surface = DiscLayer(kRings, 1.0, [&](double share, double angle, bool is_top) {
    // The flat base lies a little below the half sphere's border.
    if (!is_top)
      return glm::dvec3(share * root * std::cos(angle), share * root * std::sin(angle), 0.0);
    const glm::dvec3 to = OnHalfSphere(share, angle, kRings);
    double reach = 0;
    for (const Villus& villus : villi)
      reach =
          std::max(reach, villus.length * std::exp(kSharpness * (glm::dot(to, villus.to) - 1.0)));
    const glm::dvec3 x = (root + (options.length - root) * reach) * to;
    // Villi hang to one side.
    const double hang = 0.12 * x.z * x.z / options.length;
    return x + glm::dvec3(hang, 0.4 * hang, 0.25 * kMm);
  });
  const Box box = BoxOf(model.surface);
  model.fixed = {{{0, 0, -0.5 * root}, 1.1 * root}};
  model.sizes = {{box.high.z - box.low.z, &kTuftLength}};
  MirrorFor(side, model);
  return model;
}

LibraryModel MakeLigamentStump(const LigamentStumpOptions& options, KneeSide side) {
  LigamentStumpOptions checked = options;
  CheckOptions(checked);
  constexpr int kRings = 22;
  constexpr int kCapRings = 7;
  constexpr double kFlare = 0.45;  // growth of the section at the bone
  constexpr double kFray = 0.16;   // height of the frayed bundles, share of the length
  constexpr double kBase = 0.5 * kMm;
  const auto seed = static_cast<std::uint32_t>(options.seed);
  LibraryModel model;
  model.name = "ligament stump";
  model.material = "ligament";
  model.colour = {0.82, 0.74, 0.62};
  const double cap_share = static_cast<double>(kCapRings) / kRings;
  model.surface = DiscLayer(kRings, 1.0, [&](double share, double angle, bool is_top) {
    const bool is_cap = share <= cap_share;
    // `up` is 1 at the end and 0 at the bone; `wide` is a share of the section there.
    const double wide = !is_top ? share : is_cap ? share / cap_share : 1.0;
    const double up = !is_top ? 0.0 : is_cap ? 1.0 : (1.0 - share) / (1.0 - cap_share);
    const double flare = 1.0 + kFlare * (1.0 - up) * (1.0 - up) - 0.10 * up;
    // Bundles show as ridges along the sides.
    const double ridge = 1.0 + 0.05 * std::cos(7.0 * angle + 0.7 * options.seed) * wide;
    const double x = 0.5 * options.width * wide * flare * ridge * std::cos(angle);
    const double y = 0.5 * options.thickness * wide * flare * ridge * std::sin(angle);
    // Rounded towards the border of the end, and split into bundles of some 2 mm.
    const double tuft = LobeNoise(glm::dvec3(x, y, 0.0) / (1.6 * kMm), seed);
    const double end = (options.length - kBase) * (1.0 - kFray * (1.0 - tuft)) -
                       0.10 * options.length * std::pow(wide, 4);
    return glm::dvec3(x, y, is_top ? kBase + up * end : 0.0);
  });
  const Box box = BoxOf(model.surface);
  const auto half_way = [&](auto axis) {  // extent of the points in the middle of the length
    double least = 1e9, most = -1e9;
    for (const glm::dvec3& x : model.surface.vertices)
      if (std::abs(x.z - 0.55 * options.length) < 0.1 * options.length) {
        least = std::min(least, x.*axis);
        most = std::max(most, x.*axis);
      }
    return most - least;
  };
  model.fixed = {{{0, 0, -0.5 * options.width}, 0.62 * options.width}};
  model.sizes = {{box.high.z - box.low.z, &kStumpLength},
                 {half_way(&glm::dvec3::x), &kStumpWidth},
                 {half_way(&glm::dvec3::y), &kStumpThickness}};
  MirrorFor(side, model);
  return model;
}

}  // namespace arthro::authoring
