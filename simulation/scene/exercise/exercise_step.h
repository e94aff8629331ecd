// Steps of an exercise, one struct per kind [method.md, Exercises]. Lengths in m, angles in rad,
// forces in N, times in s. Targets and bodies are named by their ids. `centre` is the largest
// distance of an image from the centre of the picture; 1 is the rim.
#pragma once

#include <filesystem>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#include "simulation/core/options.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {

enum class CueKind { kNone, kName, kArrow, kOutline, kGhost };
enum class StepBy { kView, kTip };  // guided part: the centre of the view or the instrument's tip

inline constexpr const char* kEndOfExercise = "end";  // in StepNext; no step has this id
inline constexpr Range kStepTime{0, 3600};
inline constexpr Range kStepForce{0, 100};
inline Choices<StepBy> StepByWords() { return {{{StepBy::kView, "view"}, {StepBy::kTip, "tip"}}}; }

// Ids of the steps that follow; empty: the following step after success, the end after failure.
struct StepNext {
  std::string done, failed;
  friend bool operator==(const StepNext&, const StepNext&) = default;
  template <class V>
  void Visit(V&& v) {
    v("done", done, Any{}, "", "Step after success; the following one if not given.");
    v("failed", failed, Any{}, "", "Step after failure; the end if not given.");
  }
};

// Fields of every kind of step.
struct StepBase {
  static constexpr const char* kKindKey = "kind";  // key of kType in the file
  std::string id, text;
  std::filesystem::path picture;
  std::vector<std::string> targets;
  CueKind cue = CueKind::kNone;
  double cue_after = 0;  // s
  double limit = 0;      // s; 0: none
  bool is_optional = false;
  StepNext next;
  friend bool operator==(const StepBase&, const StepBase&) = default;
  template <class V>
  void VisitBase(V& v) {
    static constexpr const char* kReserved[] = {kEndOfExercise};
    v("id", id, Name{kReserved, "stands for the end of the exercise"}, "",
      "Short name of the step.");
    v("targets", targets, TextList{}, "", "Ids of the targets, in their order.");
    v("text", text, Any{}, "", "What the trainee is asked to do.");
    v("picture", picture, Any{}, "", "Picture that is shown with the text.");
    v("cue", cue,
      LeftOutAt{CueKind::kNone, Choices<CueKind>{{{CueKind::kNone, "none"},
                                                  {CueKind::kName, "name"},
                                                  {CueKind::kArrow, "arrow"},
                                                  {CueKind::kOutline, "outline"},
                                                  {CueKind::kGhost, "ghost"}}}},
      "", "Help that is shown in the picture.");
    v("cue_after", cue_after, LeftOutAt{0.0, kStepTime}, "s",
      "Seconds from the start of the step to its hint.");
    v("limit", limit, LeftOutAt{0.0, kStepTime}, "s",
      "Seconds after which the step has failed; 0 for none.");
    v("optional", is_optional, LeftOutAt{false, Any{}}, "",
      "Whether the exercise can be passed without this step.");
    v("next", next, Any{}, "", "Steps that follow.");
  }
};

struct SeeStep : StepBase {
  static constexpr const char* kType = "see";
  static constexpr const char* kHelp = "Done when each target has been seen.";
  double centre = 0.5;
  glm::dvec2 distance{0.005, 0.030};
  double incidence = std::numbers::pi / 3;
  double hold = 1;
  friend bool operator==(const SeeStep&, const SeeStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("centre", centre, kShare, "", "Largest distance from the centre; 1 is the rim.");
    v("distance", distance, kLength, "m", "Nearest and farthest distance from the lens.");
    v("incidence", incidence, Range{0, std::numbers::pi / 2}, "rad",
      "Largest angle between the surface's normal and the line to the lens.");
    v("hold", hold, kStepTime, "s", "Seconds for which each target is seen.");
  }
};

struct HoldStep : StepBase {
  static constexpr const char* kType = "hold";
  static constexpr const char* kHelp = "Done when each target was kept in the centre unbroken.";
  double centre = 0.25;
  glm::dvec2 distance{0.005, 0.030};
  double hold = 5;
  friend bool operator==(const HoldStep&, const HoldStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("centre", centre, kShare, "", "Largest distance from the centre; 1 is the rim.");
    v("distance", distance, kLength, "m", "Nearest and farthest distance from the lens.");
    v("hold", hold, kStepTime, "s", "Seconds for which each target stays in the centre.");
  }
};

struct TelescopeStep : StepBase {
  static constexpr const char* kType = "telescope";
  static constexpr const char* kHelp =
      "Done when the scope went from far to near and back to far, so many times.";
  double near = 0.008, far = 0.020;
  int cycles = 2;
  double centre = 0.25;
  friend bool operator==(const TelescopeStep&, const TelescopeStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("near", near, kLength, "m", "Distance of the lens to reach at the near end.");
    v("far", far, kLength, "m", "Distance of the lens to reach at the far end.");
    v("cycles", cycles, Range{1, 100}, "", "Times from far to near and back.");
    v("centre", centre, kShare, "", "Largest distance from the centre; 1 is the rim.");
  }
};

struct PeriscopeStep : StepBase {
  static constexpr const char* kType = "periscope";
  static constexpr const char* kHelp =
      "Done when the targets of a ring were seen in order by turning an oblique scope.";
  double view_angle = std::numbers::pi / 6;
  double centre = 0.25;
  glm::dvec2 distance{0.005, 0.030};
  double hold = 0.5;
  double tip_within = 0.006;
  friend bool operator==(const PeriscopeStep&, const PeriscopeStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("view_angle", view_angle, Range{0, RadiansFromDegrees(120)}, "rad", "View angle to use.");
    v("centre", centre, kShare, "", "Largest distance from the centre; 1 is the rim.");
    v("distance", distance, kLength, "m", "Nearest and farthest distance from the lens.");
    v("hold", hold, kStepTime, "s", "Seconds for which each target is seen.");
    v("tip_within", tip_within, kLength, "m",
      "Largest distance of the scope's tip from where it was when the first target was seen.");
  }
};

struct TrackStep : StepBase {
  static constexpr const char* kType = "track";
  static constexpr const char* kHelp =
      "A goal moves along straight legs between targets; done when it has arrived.";
  std::vector<std::string> path;
  double speed = 0.004;  // m/s
  StepBy by = StepBy::kView;
  friend bool operator==(const TrackStep&, const TrackStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("path", path, TextList{}, "", "Ids of the targets at the ends of the legs.");
    v("speed", speed, Range{0, 0.1, true}, "m/s", "Speed of the goal, metres per second.");
    v("by", by, StepByWords(), "", "What follows the goal.");
  }
};

struct ProbeStep : StepBase {
  static constexpr const char* kType = "probe";
  static constexpr const char* kHelp = "Done when each target was pressed in sight.";
  glm::dvec2 force{0.5, 3.0};
  double hold = 0.5;
  bool must_see = true;
  friend bool operator==(const ProbeStep&, const ProbeStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("force", force, kStepForce, "N", "Least and largest force on the tip.");
    v("hold", hold, kStepTime, "s", "Seconds for which each target is pressed.");
    v("view", must_see, LeftOutAt{true, Any{}}, "", "Whether the tip must be visible.");
  }
};

struct FollowStep : StepBase {
  static constexpr const char* kType = "follow";
  static constexpr const char* kHelp =
      "Done when enough of a path of straight legs between targets was followed in order.";
  std::vector<std::string> path;
  double within = 0.002;
  StepBy by = StepBy::kTip;
  double cover = 0.9;
  friend bool operator==(const FollowStep&, const FollowStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("path", path, TextList{}, "", "Ids of the targets at the ends of the legs.");
    v("within", within, kLength, "m", "Largest distance from the path.");
    v("by", by, StepByWords(), "", "What follows the path.");
    v("cover", cover, kShare, "", "Share of the path's pieces of 1 mm to follow.");
  }
};

struct MeasureStep : StepBase {
  static constexpr const char* kType = "measure";
  static constexpr const char* kHelp =
      "Done when both targets were touched and marked; the distance of the marks is measured.";
  friend bool operator==(const MeasureStep&, const MeasureStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
  }
};

struct TransferStep : StepBase {
  static constexpr const char* kType = "transfer";
  static constexpr const char* kHelp = "Done when each loose body is at rest at the target.";
  std::vector<std::string> bodies;
  std::string to;
  friend bool operator==(const TransferStep&, const TransferStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("bodies", bodies, TextList{}, "", "Ids of the loose targets to carry.");
    v("to", to, Required{Any{}}, "", "Id of the target to which they are brought.");
  }
};

struct ResectStep : StepBase {
  static constexpr const char* kType = "resect";
  static constexpr const char* kHelp =
      "Done when the regions are removed and the instrument has left the tissue.";
  std::vector<std::string> regions;
  double share = 0.9;
  friend bool operator==(const ResectStep&, const ResectStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("regions", regions, TextList{}, "", "Ids of the targets with the regions to remove.");
    v("share", share, kShare, "", "Share of their volume to remove.");
  }
};

struct RecoverStep : StepBase {
  static constexpr const char* kType = "recover";
  static constexpr const char* kHelp =
      "A bleeding clouds the picture; done when its source was found and pressed.";
  std::string source;
  double haze = 0.8;
  double rise = 3;
  glm::dvec2 force{0.5, 8.5};
  double hold = 4;
  double decay = 3;
  friend bool operator==(const RecoverStep&, const RecoverStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("source", source, Required{Any{}}, "", "Id of the target that bleeds.");
    v("haze", haze, kShare, "", "Strength of the haze that the bleeding reaches.");
    v("rise", rise, kStepTime, "s", "Seconds until it has reached this strength.");
    v("force", force, kStepForce, "N", "Least and largest force on the source.");
    v("hold", hold, kStepTime, "s", "Seconds for which the source is pressed.");
    v("decay", decay, kStepTime, "s", "Time constant with which the haze falls afterwards.");
  }
};

struct AnswerChoice {
  std::string text;
  std::string next;  // step after this answer; empty: that of the step
  friend bool operator==(const AnswerChoice&, const AnswerChoice&) = default;
  template <class V>
  void Visit(V&& v) {
    v("text", text, Required{Any{}}, "", "The answer.");
    v("next", next, Any{}, "", "Step after this answer; that of the step if not given.");
  }
};

struct AnswerStep : StepBase {
  static constexpr const char* kType = "answer";
  static constexpr const char* kHelp = "Done when the right answer was chosen.";
  std::string question;
  std::vector<AnswerChoice> choices;
  int right = 0;
  friend bool operator==(const AnswerStep&, const AnswerStep&) = default;
  template <class V>
  void Visit(V&& v) {
    VisitBase(v);
    v("question", question, Required{Any{}}, "", "The question.");
    v("choices", choices, Any{}, "", "Answers to choose from.");
    v("right", right, Range{0, 20}, "", "Number of the right answer, from 0.");
  }
};

using ExerciseStep =
    std::variant<SeeStep, HoldStep, TelescopeStep, PeriscopeStep, TrackStep, ProbeStep, FollowStep,
                 MeasureStep, TransferStep, ResectStep, RecoverStep, AnswerStep>;

inline const StepBase& BaseOf(const ExerciseStep& step) {
  return std::visit([](const StepBase& base) -> const StepBase& { return base; }, step);
}
inline StepBase& BaseOf(ExerciseStep& step) {
  return std::visit([](StepBase& base) -> StepBase& { return base; }, step);
}
inline const char* KindOf(const ExerciseStep& step) {
  return std::visit([](const auto& kind) { return kind.kType; }, step);
}

}  // namespace arthro
