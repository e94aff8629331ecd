#include "simulation/tissue/body/tool_cut.h"

#include <algorithm>

#include "simulation/tissue/cut/cutters.h"

namespace arthro::simulation {
namespace {

constexpr double kOpened = 0.5, kClosed = 0.15;  // fraction of the jaws' opening: ready, bitten
constexpr int kShaveEvery = 6;  // steps; a shaver removes volume ten times per second

}  // namespace

ToolCut TriggerCut(ToolKind kind, const ToolInput& now, double dt, CutTrigger& trigger,
                   double& time) noexcept {
  if (kind == ToolKind::kPunch) {
    if (now.opening > kOpened) trigger.is_ready_to_bite = true;
    if (!(now.opening < kClosed) || !trigger.is_ready_to_bite) return ToolCut::kNone;
    trigger.is_ready_to_bite = false;
    time = dt;
    return ToolCut::kBite;
  }
  if (kind != ToolKind::kShaver || !now.is_running || ++trigger.since_shave < kShaveEvery)
    return ToolCut::kNone;
  time = dt * trigger.since_shave;
  trigger.since_shave = 0;
  return ToolCut::kShave;
}

LooseReport RemoveLoosePieces(SolidField& field, std::span<const Ball> fixed) {
  const FieldPieces pieces = PiecesOf(field);
  if (pieces.count() == 0) return {};
  std::vector<unsigned char> is_debris = HeldPieces(field, pieces, fixed);
  if (fixed.empty())
    is_debris[static_cast<std::size_t>(std::ranges::max_element(pieces.volume) -
                                       pieces.volume.begin())] = 1;
  for (std::size_t i = 0; i < is_debris.size(); ++i)
    is_debris[i] = is_debris[i] == 0 && pieces.volume[i] < kDebrisVolume;
  const CrumbReport gone = RemovePieces(field, pieces, is_debris);
  return {gone, pieces.count() - gone.crumbs};
}

std::vector<std::uint8_t> MarkFreshVertices(const SurfaceMesh& skin, const SolidField& field) {
  std::vector<std::uint8_t> fresh;
  for (const glm::dvec3& x : skin.vertices)
    fresh.push_back(field.CutDistance(x) > -0.3 * field.spacing() ? 1 : 0);
  return fresh;
}

}  // namespace arthro::simulation
