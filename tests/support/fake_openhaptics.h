// A library behind the stub header HD/hd.h: devices that a test makes and moves, a scheduler that
// runs when the test says, and all forces that were written. One per program; Reset between tests.
// A test that ticks it in a thread reads its devices only under HoldOpenHaptics, as the scheduler
// does.
#pragma once

#include <array>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace arthro::test {

struct FakeTouch {
  std::string name, serial = "T1";
  bool opens = true;
  std::array<double, 3> position_mm{};
  std::array<double, 16> transform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // column-major
  int buttons = 0;
  unsigned calibration = 0;     // HD_CALIBRATION_OK
  std::deque<unsigned> errors;  // reported one at a time, at the ends of frames
  // Calls that it received.
  bool is_open = false, has_force_output = false;
  int calibrated = 0;
  std::vector<std::array<double, 3>> forces;
};

struct FakeOpenHaptics {
  std::vector<FakeTouch> devices;
  bool is_running = false, starts = true;
  int wrong_calls = 0;  // outside a frame, nested, or on a device that is not open
  void Reset() { *this = {}; }
  // A tick of the scheduler. False: nothing was scheduled, or it does not run.
  bool Tick();
};
FakeOpenHaptics& OpenHaptics();
std::unique_lock<std::mutex> HoldOpenHaptics();

}  // namespace arthro::test
