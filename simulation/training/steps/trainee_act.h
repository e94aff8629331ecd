// Acts of trainee and instructor in an attempt beside moving the tools. Acts belong to the frame in
// which they happen.
#pragma once

#include <string>

namespace arthro::simulation {

enum class ActKind { kMark, kAnswer, kHint, kReset, kLookDown, kNote, kStop };

struct TraineeAct {
  ActKind kind = ActKind::kNote;
  int answer = 0;    // number of the chosen answer, from 0
  std::string note;  // remark of the instructor
  friend bool operator==(const TraineeAct&, const TraineeAct&) = default;
};

}  // namespace arthro::simulation
