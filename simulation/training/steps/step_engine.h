// Steps of an exercise against the frames of an attempt [method.md, Exercises]. The same frames and
// acts give the same events, whether they come from a practice or from its recording, in any
// pieces. Within a frame: acts, pause, limits, zones, steps, transitions. SI units.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/steps/marked_area.h"
#include "simulation/training/steps/step_rules.h"

namespace arthro::simulation {

// Note of the event `stopped` where a recording ends before the attempt does.
inline constexpr std::string_view kRecordingEnds = "the recording ends";
// Note of a cue that comes before its time.
inline constexpr std::string_view kAskedFor = "asked for";

// Reason for which an attempt ended.
enum class AttemptEnd { kRunning, kCompleted, kStepFailed, kLimit, kStopped, kVoid };

// A step under way.
struct OpenStep {
  int step = -1;        // number in the exercise
  double progress = 0;  // share of it, 0 to 1
  friend bool operator==(const OpenStep&, const OpenStep&) = default;
};

// State of an attempt for the strip above the picture.
struct StripState {
  int step = -1;        // number of the step under way, the first of several; −1: none
  int done = 0;         // steps
  double progress = 0;  // share of that step, 0 to 1
  std::optional<glm::dvec2> force_band;  // N
  double force = 0;                      // N, on the instrument's tip
  double time = 0;                       // s without pauses
  std::optional<double> step_time_left;  // s
  bool is_cue_due = false;
  std::vector<OpenStep> open;      // steps under way: of a free order all that are not done
  std::vector<StripCue> cues;      // cues of those steps
  std::optional<glm::dvec3> goal;  // moving goal of the step; portal frame
  double haze = 0;                 // strength that a bleeding asks of the picture, 0 to 1
  bool is_paused = false;
};

class StepEngine : private StepEvents {
 public:
  explicit StepEngine(Exercise exercise, double safe_force = kSafeProbingForce);

  // Takes the next frame, 10 ms after the last. After the end nothing changes.
  void Advance(const AttemptFrame& frame, std::span<const TraineeAct> acts = {});
  // The recording ends; an attempt that is still running was stopped.
  void Finish();

  AttemptEnd end() const { return end_; }
  const std::string& reason() const { return reason_; }  // one sentence about the end
  const std::vector<AttemptEvent>& events() const { return events_; }
  const std::vector<StepResult>& steps() const { return results_; }
  const StripState& strip() const { return strip_; }
  const AttemptMeasures& measures() const { return measures_; }
  const Exercise& exercise() const { return exercise_; }
  double duration() const;  // s without pauses

 private:
  struct ZoneState {
    int target = -1;
    bool is_inside = false;
    int outside = 0;  // frames
  };
  // A bite or a pass that takes tissue, until nothing was taken for a while.
  struct Taking {
    double taken = 0, outside = 0;  // m³
    int quiet = 0;                  // frames
    bool is_under_way = false;
  };

  void Add(EventKind kind, int target, double value, std::string_view note) override;
  void Event(EventKind kind, const std::string& step, std::string_view note = {}, double value = 0);
  void End(AttemptEnd end, std::string reason);
  void Begin(std::size_t step, const StepFrame& at);
  void Conclude(std::size_t step, StepOutcome outcome, const std::string& next,
                const StepFrame& at);
  void TakeActs(std::span<const TraineeAct> acts);
  bool CheckLimits(const AttemptFrame& frame);
  void CheckZones(const AttemptFrame& frame);
  void CheckTissue(const AttemptFrame& frame);
  void EndBite();
  void AdvanceSteps(const StepFrame& at);
  void UpdateHaze();
  void UpdateStrip(const StepFrame& at);
  double now() const;  // s

  Exercise exercise_;
  double safe_force_;
  bool uses_instrument_ = false;
  long frames_ = 0, unpaused_ = 0;
  AttemptEnd end_ = AttemptEnd::kRunning;
  std::string reason_;
  std::vector<AttemptEvent> events_;
  std::vector<StepResult> results_;
  std::vector<StepState> states_;
  std::vector<ZoneState> zones_;
  AttemptMeasures measures_;
  StripState strip_;
  MarkedArea marked_;
  Taking taking_;
  bool is_paused_ = false, is_over_force_ = false, is_hint_asked_ = false, is_closed_ = false;
  int lost_frames_ = 0;
  int emitting_ = -1;  // step whose rule runs
  int bleeding_ = -1;  // step whose haze is seen
  long bled_at_ = 0, stanched_at_ = -1;
};

// All frames of a recording; `acts` holds those of each frame, or is empty.
void AdvanceAll(StepEngine& engine, std::span<const AttemptFrame> frames,
                std::span<const std::vector<TraineeAct>> acts = {});

}  // namespace arthro::simulation
