// Reach of scope and instrument, kept that of the document while the Portals page shows it; the
// work is done in a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "app/steps/portals/spacing_targets.h"
#include "simulation/practice/reach/portal_reach.h"
#include "simulation/practice/reach/shaft_conflicts.h"
#include "simulation/scene/image.h"

namespace arthro::app {

// Parts of a scene that its reach depends on.
struct ReachKey {
  std::shared_ptr<const ColourImage> panorama;
  std::shared_ptr<const DepthMap> depth;
  std::vector<SharedSurface> surfaces;
  std::vector<Pose> poses;
  Backdrop backdrop;
  double view_angle = 0, scope_length = 0;             // rad, m
  double incision_spacing = 0, instrument_length = 0;  // m
};
// All but the last two, which only the instrument depends on.
bool HasSameScope(const ReachKey& a, const ReachKey& b);
bool operator==(const ReachKey& a, const ReachKey& b);
ReachKey ReachKeyOf(const authoring::Document& document);

struct MadeReach {
  ReachKey key;
  std::shared_ptr<const simulation::ScopeReach> scope;
  simulation::PortalReach reach;
  std::shared_ptr<const ColourImage> picture;  // the panorama in the colours of what is reached
};

struct ReachBoard {
  explicit ReachBoard(std::function<void()> wake) : jobs(std::move(wake)) {}
  bool is_shown = false;
  std::shared_ptr<const MadeReach>
      made;  // null: none yet; of an earlier document while one is made
  Jobs jobs;
  std::vector<SpacingTarget> targets;  // last choice; see ChosenSpacingTargets
  // Obstacles of the shafts, kept while they lie where they are.
  std::shared_ptr<const simulation::ShaftObstacles> obstacles;
  ReachKey obstacle_key;  // scene of the obstacles; its scope and instrument do not count
};

// Starts the work that is wanted, if any, and takes over what ended. Once a frame; returns at once.
// True when something changed.
bool KeepReachFresh(EditorState& state);

// The panorama for the overview while the page shows the reach; null: the document's own.
std::shared_ptr<const ColourImage> ReachPictureOf(const EditorState& state);

// Sets the incision spacing that suits the chosen targets best. Long work; undoable.
void SuggestSpacing(EditorState& state);

// Conflicts of the shafts as the author holds them, each with a sentence.
struct ShaftFinding {
  std::string words;
  glm::dvec3 x_in_portal{0.0};
};
std::vector<ShaftFinding> FindShaftConflicts(EditorState& state);

// Angle between the author's rods as they are held, rad.
double AngleBetweenRods(const EditorState& state);

}  // namespace arthro::app
