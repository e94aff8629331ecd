#include "app/steps/portals/reach_board.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/state/edits.h"
#include "app/steps/portals/portals_step.h"
#include "simulation/core/units.h"
#include "simulation/practice/reach/reach_picture.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {
namespace {

Jobs::Work ReachWork(const LoadedScene& loaded, ReachKey key,
                     std::shared_ptr<const simulation::ScopeReach> scope) {
  return [loaded, key = std::move(key), scope = std::move(scope)](const Progress&) -> Jobs::Apply {
    auto made = std::make_shared<MadeReach>();
    made->key = key;
    made->scope = scope ? scope : Share(simulation::ScopeReachOf(loaded));
    made->reach = simulation::ReachWith(*made->scope, loaded, key.incision_spacing);
    made->picture =
        Share(simulation::DrawReach(OrEmpty(loaded.panorama), *made->scope, made->reach));
    return [made](EditorState& state) { state.steps.portals->reach.made = made; };
  };
}

bool IsWanted(const EditorState& state) {
  return state.steps.portals->reach.is_shown && state.step == Step::kPortals && !state.practice &&
         state.document().panorama != nullptr;
}

std::string WordsOf(const simulation::ShaftConflict& conflict, const Scene& scene) {
  using Kind = simulation::ShaftConflict::Kind;
  const double mm = MmFromMetres(conflict.depth);
  switch (conflict.kind) {
    case Kind::kScopeInTissue:
    case Kind::kInstrumentInTissue:
      return fmt::format("The shaft of the {} passes through {}.",
                         conflict.kind == Kind::kScopeInTissue ? "scope" : "instrument",
                         scene.tissues[static_cast<std::size_t>(conflict.tissue)].name);
    case Kind::kScopeInRelief:
    case Kind::kInstrumentInRelief:
      return fmt::format("The shaft of the {} enters bone {:.0f} mm behind its portal.",
                         conflict.kind == Kind::kScopeInRelief ? "scope" : "instrument", mm);
    case Kind::kShaftsTouch:
      break;
  }
  return fmt::format("The two shafts touch {:.0f} mm behind the scope's portal.", mm);
}

}  // namespace

bool HasSameScope(const ReachKey& a, const ReachKey& b) {
  return a.panorama == b.panorama && a.depth == b.depth && a.surfaces == b.surfaces &&
         a.poses == b.poses && a.backdrop == b.backdrop && a.view_angle == b.view_angle &&
         a.scope_length == b.scope_length;
}

bool operator==(const ReachKey& a, const ReachKey& b) {
  return HasSameScope(a, b) && a.incision_spacing == b.incision_spacing &&
         a.instrument_length == b.instrument_length;
}

ReachKey ReachKeyOf(const authoring::Document& document) {
  const Scene& scene = document.scene;
  ReachKey key{document.panorama,
               document.depth,
               document.surfaces,
               {},
               scene.backdrop,
               scene.scope.view_angle,
               scene.rig.scope.rod_length,
               scene.portals.incision_spacing,
               scene.rig.instrument.rod_length};
  for (const Tissue& tissue : scene.tissues) key.poses.push_back(tissue.pose);
  return key;
}

bool KeepReachFresh(EditorState& state) {
  ReachBoard& board = state.steps.portals->reach;
  const bool was_busy = board.jobs.busy();
  const bool has_changed = was_busy && board.jobs.Finish(state);
  if (board.jobs.busy() || !IsWanted(state)) return has_changed;
  ReachKey key = ReachKeyOf(state.document());
  if (board.made && board.made->key == key) return has_changed;
  const auto scope = board.made && HasSameScope(board.made->key, key) ? board.made->scope : nullptr;
  board.jobs.Start("Reach", ReachWork(state.document(), std::move(key), scope));
  return has_changed;
}

std::shared_ptr<const ColourImage> ReachPictureOf(const EditorState& state) {
  const ReachBoard& board = state.steps.portals->reach;
  if (!IsWanted(state) || !board.made) return nullptr;
  return board.made->key.panorama == state.document().panorama ? board.made->picture : nullptr;
}

void SuggestSpacing(EditorState& state) {
  const std::vector<SpacingTarget> chosen = ChosenSpacingTargets(state);
  std::string words;
  for (const SpacingTarget& target : chosen) words += (words.empty() ? "" : ", ") + WordsOf(target);
  state.jobs.Start(
      "Suggest a spacing",
      [loaded = static_cast<const LoadedScene&>(state.document()), chosen,
       words](const Progress&) -> Jobs::Apply {
        const PlacedTargets placed = PlaceTargets(loaded, chosen);
        const simulation::ScopeReach scope = simulation::ScopeReachOf(loaded, {}, placed.points);
        const double spacing = simulation::SuggestedSpacing(scope, loaded, placed.targets);
        return [spacing, words](EditorState& now) {
          SetIncisionSpacing(now, spacing);
          EndDrag(now);
          now.message = fmt::format("Incision spacing {:.0f} mm, which suits {} best",
                                    MmFromMetres(spacing), words);
        };
      });
}

std::vector<ShaftFinding> FindShaftConflicts(EditorState& state) {
  ReachBoard& board = state.steps.portals->reach;
  const Scene& scene = state.document().scene;
  ReachKey key = ReachKeyOf(state.document());
  key.view_angle = key.scope_length = key.incision_spacing = key.instrument_length = 0;
  if (!board.obstacles || !(board.obstacle_key == key)) {
    board.obstacles = std::make_shared<const simulation::ShaftObstacles>(state.document());
    board.obstacle_key = std::move(key);
  }
  const glm::dvec3 portal(scene.portals.incision_spacing, 0, 0);
  std::vector<ShaftFinding> findings;
  for (const simulation::ShaftConflict& conflict :
       board.obstacles->Find(simulation::ViewFromPose(state.scope, scene.scope.view_angle).tip,
                             portal, portal + simulation::TipInOwnPortal(state.instrument)))
    findings.push_back({WordsOf(conflict, scene), conflict.place});
  return findings;
}

double AngleBetweenRods(const EditorState& state) {
  const double cosine =
      glm::dot(simulation::BasisOf(state.scope).axis, simulation::BasisOf(state.instrument).axis);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace arthro::app
