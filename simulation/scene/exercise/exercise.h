// Exercise: goal, steps and criteria that a trainee practises, as scene.json holds it
// [method.md, Exercises]. Portal frame; m, rad, N, s. An exercise without steps is free practice.
#pragma once

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/scene/exercise/exercise_step.h"
#include "simulation/scene/exercise/exercise_target.h"
#include "simulation/scene/limits/scene_limits.h"

namespace arthro {

inline constexpr int kMostTargets = 16;  // per exercise

enum class StepOrder { kFixed, kFree };
enum class HeadChoice { kAny, kScope, kUpright };   // how the camera head is turned
enum class AvoidBy { kInstrument, kScope, kBoth };  // tools that must stay out of a zone

// Passes that open the next exercise: `consecutive` of them in a row, then `in_total` more.
struct ExerciseGate {
  int consecutive = 2, in_total = 0;
  friend bool operator==(const ExerciseGate&, const ExerciseGate&) = default;
  template <class V>
  void Visit(V&& v) {
    v("consecutive", consecutive, Range{0, 100}, "", "Passes of tests in a row.");
    v("in_total", in_total, Range{0, 100}, "", "Passes of tests after those.");
  }
};

struct StartPose {
  double latitude = 0, longitude = 0, roll = 0, insertion = 0.012;
  friend bool operator==(const StartPose&, const StartPose&) = default;
  template <class V>
  void Visit(V&& v) {
    constexpr double kQuarter = std::numbers::pi / 2;
    v("latitude", latitude, Range{-kQuarter, kQuarter}, "rad", "Direction of the rod, up.");
    v("longitude", longitude, Range{-kQuarter, kQuarter}, "rad", "Direction of the rod, right.");
    v("roll", roll, Range{-2 * std::numbers::pi, 2 * std::numbers::pi}, "rad", "Roll.");
    v("insertion", insertion, kCoordinate, "m", "Insertion depth.");
  }
};

// Strengths of the picture's disturbances from 0 to 1 at the start.
struct StartDisturbances {
  double haze = 0, bubbles = 0, debris = 0, fog = 0, near_blur = 0, far_blur = 0, overexposure = 0;
  friend bool operator==(const StartDisturbances&, const StartDisturbances&) = default;
  template <class V>
  void Visit(V&& v) {
    const LeftOutAt rule{0.0, kShare};
    v("haze", haze, rule, "", "Blood in the fluid.");
    v("bubbles", bubbles, rule, "", "Air bubbles.");
    v("debris", debris, rule, "", "Loose flakes and fibres.");
    v("fog", fog, rule, "", "A fogged lens.");
    v("near_blur", near_blur, rule, "", "Near parts are out of focus.");
    v("far_blur", far_blur, rule, "", "Far parts are out of focus.");
    v("overexposure", overexposure, rule, "", "Too much light for the camera.");
  }
};

struct ExerciseSetup {
  std::vector<double> view_angles;       // allowed; empty: any
  std::vector<std::string> instruments;  // allowed; empty: any
  std::optional<double> incision_spacing;
  HeadChoice head = HeadChoice::kAny;
  StartPose scope;
  StartDisturbances disturbances;
  friend bool operator==(const ExerciseSetup&, const ExerciseSetup&) = default;
  template <class V>
  void Visit(V&& v) {
    v("view_angles", view_angles, NumberList{}, "rad",
      "View angles that may be used; any if not given.");
    v("instruments", instruments, TextList{}, "", "Kinds of instruments; any if not given.");
    v("incision_spacing", incision_spacing, kCoordinate, "m",
      "Incision spacing; that of the scene if not given.");
    v("head", head,
      LeftOutAt{HeadChoice::kAny, Choices<HeadChoice>{{{HeadChoice::kAny, "any"},
                                                       {HeadChoice::kScope, "scope"},
                                                       {HeadChoice::kUpright, "upright"}}}},
      "", "How the camera head is turned.");
    v("scope", scope, LeftOutAt{StartPose(), Any{}}, "", "Pose of the scope to begin with.");
    v("disturbances", disturbances, Any{}, "", "Strengths of the picture's disturbances.");
  }
};

// A zone that a tool must not touch, beside all steps.
struct AvoidZone {
  std::string target;
  AvoidBy by = AvoidBy::kInstrument;
  double above = 0;  // N; a touch with at most this force does not count
  friend bool operator==(const AvoidZone&, const AvoidZone&) = default;
  template <class V>
  void Visit(V&& v) {
    v("target", target, Required{Any{}}, "", "Id of the target whose ball is the zone.");
    v("by", by,
      Choices<AvoidBy>{{{AvoidBy::kInstrument, "instrument"},
                        {AvoidBy::kScope, "scope"},
                        {AvoidBy::kBoth, "both"}}},
      "", "Tool that must stay out.");
    v("above", above, kStepForce, "N", "Force up to which it may touch; 0 for none.");
  }
};

// Limits that end the attempt.
struct ExerciseLimits {
  std::optional<double> time, force, marked_area;
  friend bool operator==(const ExerciseLimits&, const ExerciseLimits&) = default;
  template <class V>
  void Visit(V&& v) {
    v("time", time, Range{0, 36000, true}, "s", "Seconds.");
    v("force", force, Range{0, 100, true}, "N", "Force on the tip of a tool.");
    v("marked_area", marked_area, Range{0, 1, true}, "m2",
      "Square metres touched with more than the safe probing force.");
  }
};

// Limit from the results of a group: its mean, plus so many standard deviations.
struct GroupLimit {
  std::string group;
  double plus_sd = 2;
  friend bool operator==(const GroupLimit&, const GroupLimit&) = default;
  template <class V>
  void Visit(V&& v) {
    v("group", group, Required{Any{}}, "", "Name of the group.");
    v("plus_sd", plus_sd, Range{-10, 10}, "", "Standard deviations added to its mean.");
  }
};

struct Criterion {
  std::string metric, part;
  std::optional<double> min, max;
  std::optional<GroupLimit> max_from;
  std::string source;
  friend bool operator==(const Criterion&, const Criterion&) = default;
  template <class V>
  void Visit(V&& v) {
    v("metric", metric, Required{Any{}}, "", "Id of the metric.");
    v("part", part, Any{}, "", "Tool or pair that is measured; the only one if not given.");
    v("min", min, Range{-1e9, 1e9}, "", "Least value, in the unit of the metric.");
    v("max", max, Range{-1e9, 1e9}, "", "Largest value, in the unit of the metric.");
    v("max_from", max_from, Any{}, "",
      "Largest value from a group of at least five; max until then.");
    v("source", source, Any{}, "", "Publication or person that the limit comes from.");
  }
};

struct Exercise {
  // Compiled once, in exercise.cpp, since most sources copy scenes.
  Exercise();
  Exercise(const Exercise&);
  Exercise(Exercise&&) noexcept;
  Exercise& operator=(const Exercise&);
  Exercise& operator=(Exercise&&) noexcept;
  ~Exercise();

  std::string id;
  int version = 1;  // raised by an edit
  std::string title, brief;
  std::filesystem::path picture, ghost;
  std::vector<std::string> needs;  // ids of exercises that come first
  StepOrder order = StepOrder::kFixed;
  ExerciseGate gate;
  ExerciseSetup setup;
  std::vector<ExerciseTarget> targets;
  std::vector<ExerciseStep> steps;
  std::vector<AvoidZone> avoid;
  ExerciseLimits limits;
  std::vector<Criterion> criteria;
  friend bool operator==(const Exercise&, const Exercise&);
  template <class V>
  void Visit(V&& v) {
    v("id", id, Name{}, "", "Short name of the exercise.");
    v("version", version, Range{1, 1e6}, "", "Raised by every edit; 1 if not given.");
    v("title", title, Any{}, "", "Title of the exercise.");
    v("brief", brief, Any{}, "", "What the trainee is asked to do.");
    v("picture", picture, Any{}, "", "Picture that is shown with the brief.");
    v("needs", needs, TextList{}, "", "Ids of the exercises whose gates open this one.");
    v("order", order,
      LeftOutAt{StepOrder::kFixed,
                Choices<StepOrder>{{{StepOrder::kFixed, "fixed"}, {StepOrder::kFree, "free"}}}},
      "", "Whether the steps have an order.");
    v("ghost", ghost, Any{}, "", "Recording of an expert.");
    v("gate", gate, LeftOutAt{ExerciseGate(), Any{}}, "",
      "Passes that open the exercises which need this one.");
    v("setup", setup, Any{}, "", "State at the start.");
    v("targets", targets, Any{}, "", "Places that steps and zones name; at most 16.");
    v("steps", steps, Any{}, "", "Steps; free practice without any.");
    v("avoid", avoid, Any{}, "", "Zones that must not be touched.");
    v("limits", limits, Any{}, "", "Limits that end the attempt.");
    v("criteria", criteria, Any{}, "", "What a pass needs, beside the steps.");
  }
};

}  // namespace arthro
