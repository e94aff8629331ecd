// Waits in a test of commands until the editor has no work left.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/state/editor_state.h"
#include "app/steps/depth/depth_step.h"

namespace arthro::app {

// Repeats `frame`, what the window does between two frames, until no job is under way. The test
// fails after ten minutes.
inline void SettleBy(const EditorState& state, const std::function<void()>& frame) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  do {
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_LT(std::chrono::steady_clock::now(), limit) << "work does not end";
  } while (HasWork(state) || DepthIsUnderWay(state));
  frame();
}

inline void Settle(EditorState& state) {
  SettleBy(state, [&state] { FinishWork(state); });
}

}  // namespace arthro::app
