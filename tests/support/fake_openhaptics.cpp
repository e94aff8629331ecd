#include "tests/support/fake_openhaptics.h"

#include <HD/hd.h>
#include <algorithm>

namespace {

using arthro::test::FakeTouch;
using arthro::test::OpenHaptics;

HDSchedulerCallback scheduled = nullptr;
void* scheduled_data = nullptr;
HHD current = HD_INVALID_HANDLE, framed = HD_INVALID_HANDLE;
std::deque<unsigned> pending;
std::mutex scheduler;  // one callback at a time

FakeTouch* Of(HHD device) {
  auto& all = OpenHaptics().devices;
  if (device < all.size() && all[device].is_open) return &all[device];
  ++OpenHaptics().wrong_calls;
  return nullptr;
}

// Values that may be read and written only inside a frame.
FakeTouch* InFrame() {
  if (framed != current || framed == HD_INVALID_HANDLE) ++OpenHaptics().wrong_calls;
  return Of(current);
}

}  // namespace

namespace arthro::test {

FakeOpenHaptics& OpenHaptics() {
  static FakeOpenHaptics one;
  return one;
}

std::unique_lock<std::mutex> HoldOpenHaptics() { return std::unique_lock(scheduler); }

bool FakeOpenHaptics::Tick() {
  const std::scoped_lock lock(scheduler);
  if (!is_running || scheduled == nullptr) return false;
  if (scheduled(scheduled_data) == HD_CALLBACK_DONE) scheduled = nullptr;
  return true;
}

}  // namespace arthro::test

HHD hdInitDevice(HDstring name) {
  auto& all = OpenHaptics().devices;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (name == HD_DEFAULT_DEVICE ? i == 0 : all[i].name == name) {
      if (!all[i].opens) break;
      all[i].is_open = true;
      return current = static_cast<HHD>(i);
    }
  pending.push_back(HD_COMM_ERROR);
  return HD_INVALID_HANDLE;
}
void hdDisableDevice(HHD device) {
  if (FakeTouch* touch = Of(device)) touch->is_open = false;
}
void hdMakeCurrentDevice(HHD device) {
  if (Of(device) != nullptr) current = device;
}
void hdEnable(HDenum capability) {
  if (FakeTouch* touch = Of(current)) touch->has_force_output = capability == HD_FORCE_OUTPUT;
}
void hdBeginFrame(HHD device) {
  if (framed != HD_INVALID_HANDLE) ++OpenHaptics().wrong_calls;
  if (Of(device) != nullptr) framed = current = device;
}
void hdEndFrame(HHD device) {
  if (framed != device) ++OpenHaptics().wrong_calls;
  framed = HD_INVALID_HANDLE;
  if (FakeTouch* touch = Of(device); touch != nullptr && !touch->errors.empty()) {
    pending.push_back(touch->errors.front());
    touch->errors.pop_front();
  }
}
void hdGetDoublev(HDenum what, HDdouble* values) {
  switch (what) {
    case HD_CURRENT_POSITION:
      if (FakeTouch* touch = InFrame()) std::ranges::copy(touch->position_mm, values);
      break;
    case HD_CURRENT_TRANSFORM:
      if (FakeTouch* touch = InFrame()) std::ranges::copy(touch->transform, values);
      break;
    case HD_NOMINAL_MAX_FORCE:
      *values = 3.3;
      break;
    case HD_NOMINAL_MAX_CONTINUOUS_FORCE:
      *values = 0.88;
      break;
    case HD_NOMINAL_MAX_STIFFNESS:
      *values = 0.4;
      break;
    case HD_USABLE_WORKSPACE_DIMENSIONS:
      std::ranges::copy(std::array{-80.0, -60.0, -35.0, 80.0, 60.0, 35.0}, values);
      break;
    default:
      ++OpenHaptics().wrong_calls;
  }
}
void hdGetIntegerv(HDenum what, HDint* values) {
  *values = 0;
  if (what == HD_CURRENT_BUTTONS) {
    if (FakeTouch* touch = InFrame()) *values = touch->buttons;
  } else if (what == HD_INPUT_DOF) {
    *values = 6;
  } else if (what == HD_OUTPUT_DOF) {
    *values = 3;
  } else if (what != HD_CALIBRATION_STYLE) {
    ++OpenHaptics().wrong_calls;
  }
}
HDstring hdGetString(HDenum what) {
  FakeTouch* touch = Of(current);
  if (touch == nullptr) return "";
  return what == HD_DEVICE_SERIAL_NUMBER ? touch->serial.c_str() : "Touch";
}
void hdSetDoublev(HDenum what, const HDdouble* values) {
  if (what != HD_CURRENT_FORCE) ++OpenHaptics().wrong_calls;
  if (FakeTouch* touch = InFrame()) touch->forces.push_back({values[0], values[1], values[2]});
}
HDenum hdCheckCalibration() {
  const FakeTouch* touch = Of(current);
  return touch != nullptr ? touch->calibration : HD_CALIBRATION_NEEDS_MANUAL_INPUT;
}
void hdUpdateCalibration(HDenum) {
  if (FakeTouch* touch = Of(current)) {
    ++touch->calibrated;
    touch->calibration = HD_CALIBRATION_OK;
  }
}
HDErrorInfo hdGetError() {
  HDErrorInfo info{HD_SUCCESS, 0, current};
  if (!pending.empty()) {
    info.errorCode = pending.front();
    pending.pop_front();
  }
  return info;
}
HDstring hdGetErrorString(HDerror) { return "no answer"; }
void hdStartScheduler() {
  const std::scoped_lock lock(scheduler);
  OpenHaptics().is_running = OpenHaptics().starts;
  if (!OpenHaptics().starts) pending.push_back(HD_COMM_ERROR);
}
void hdStopScheduler() {
  const std::scoped_lock lock(scheduler);
  OpenHaptics().is_running = false;
}
HDSchedulerHandle hdScheduleAsynchronous(HDSchedulerCallback callback, void* data, HDushort) {
  const std::scoped_lock lock(scheduler);
  scheduled = callback;
  scheduled_data = data;
  return 1;
}
void hdScheduleSynchronous(HDSchedulerCallback callback, void* data, HDushort) {
  const std::scoped_lock lock(scheduler);
  if (!OpenHaptics().is_running) ++OpenHaptics().wrong_calls;
  callback(data);
}
void hdUnschedule(HDSchedulerHandle) {
  const std::scoped_lock lock(scheduler);
  scheduled = nullptr;
}
