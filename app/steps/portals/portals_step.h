// Step 4: where the instrument comes in, and which scope looks.
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "app/state/command.h"
#include "app/steps/panorama/board/lens_choice.h"
#include "app/steps/portals/reach_board.h"

namespace arthro::app {

struct Ui;

struct PortalsStep {
  explicit PortalsStep(std::function<void()> wake) : reach(std::move(wake)) {}

  std::vector<LensChoice> lenses;  // common scopes, read when the panel is first shown
  bool shows_as_filmed = false;    // the footage's light, to compare
  ReachBoard reach;
};
std::span<const Command> PortalsCommands();
void PortalsPanel(Ui& ui, EditorState& state);

void SetViewAngle(EditorState& state, double view_angle);  // rad; in practice the session's

}  // namespace arthro::app
