// Cost of tissue, force and picture per frame on this machine, the verdict on each, and the change
// that helps most. Every time is measured in the session that runs, and only while the panel is
// shown. Times in s; a median is that of the newest frames or steps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/state/command.h"
#include "app/steps/budget/running_median.h"
#include "app/view/drawing/picture_cost.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/practice/servo_loop.h"

namespace arthro::app {

struct Ui;
struct Area;

// A frame of the window, as the window measures it.
struct FrameCost {
  PictureCost picture;  // stages of the scope's picture
  double overview = 0;
  double whole = 0;  // with the ticks of the force loop that the window runs
};

struct TissueCost {
  int tissue = 0;        // index in the scene
  int elements = 0;      // 0: it has none
  RunningMedian step{};  // processor time of a step in which the tissue is not at rest
};

struct ForceCost {
  double period = 0;           // s between two ticks
  double median = 0, p99 = 0;  // s, a tick without tissue
  double missed = 0;           // share of the ticks
};

struct FrameBudget {
  bool is_shown = false;
  const simulation::Practice* session = nullptr;  // the session that was measured last
  std::uint64_t step = 0;                         // newest step that was counted
  std::vector<TissueCost> tissues;
  std::optional<ForceCost> force;
  RunningMedian scene, occlusion, disturbances, camera, overview, rest, whole;
};

// Allowances: a step of the tissue, a picture.
inline constexpr double kTissueAllowance = 1.0 / 60;
inline constexpr double kPictureAllowance = 1.0 / 30;

// ---- Measuring. ----
// Takes over the costs of the newest step and of the force loop. Does nothing while the panel is
// hidden.
void KeepBudgetFresh(EditorState& state);
void NoteWorld(FrameBudget& budget, const simulation::WorldPicture& world);
void NoteForce(FrameBudget& budget, const simulation::ServoReport& report);
void NoteFrame(FrameBudget& budget, const FrameCost& cost);

// ---- Judging. ----
enum class BudgetPart { kTissue, kForce, kPicture };
struct Verdict {
  BudgetPart part = BudgetPart::kTissue;
  std::optional<double> share;  // share of the allowance; nullopt: not measured
  std::string words;            // a sentence
};
std::array<Verdict, 3> VerdictsOf(const FrameBudget& budget, const Scene& scene);

struct BudgetChange {
  enum class Kind { kCoarserTissue, kRigidTissue, kPlainPicture, kSmallPicture } kind{};
  int tissue = -1;
  authoring::MeshSize size = authoring::MeshSize::kDefault;
  double saving = 0;  // s, from measured times
};
// The mildest change that brings the part that is furthest over its allowance within it, or the
// change that saves most. Nothing while every part keeps to kTight of its allowance.
inline constexpr double kTight = 0.8;
std::optional<BudgetChange> HelpfulChange(const FrameBudget& budget, const Scene& scene,
                                          MovingPicture picture);
std::string WordsOf(const BudgetChange& change, const Scene& scene);
// One step of the history for a tissue; the setting of moving pictures otherwise.
void Make(EditorState& state, const BudgetChange& change);

std::span<const Command> BudgetCommands();

// A button that opens the panel, and the panel below it.
void BudgetFields(Ui& ui, EditorState& state);
void BudgetPage(Ui& ui, EditorState& state, const Area& area);  // beside a practice

}  // namespace arthro::app
