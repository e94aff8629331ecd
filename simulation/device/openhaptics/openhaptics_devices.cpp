#include "simulation/device/openhaptics/openhaptics_devices.h"

#include <HD/hd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "simulation/core/error.h"
#include "simulation/core/latest_value.h"
#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

constexpr double kSilentServo = 0.010;  // s; then the scheduler gives no force by itself
constexpr int kLastZeros = 5;           // frames; one may be lost
constexpr int kCalibrationEvery = 100;  // frames
constexpr int kMostErrors = 16;         // that are taken out of the library's list in a frame

// What the library does not say of itself [notes on haptics, 1 and 7]: values of a Touch.
constexpr double kQuantum = 5.5e-5;                              // m
constexpr double kGimbalSigma = 1.0 / 180.0 * std::numbers::pi;  // rad, potentiometers
constexpr double kPeriod = 1e-3;                                 // s, of the scheduler

struct News {
  DeviceSample sample;
  bool is_homed = false;
};

struct Push {
  glm::dvec3 force{0.0};
  double t = -1;  // s
};

// The handle's own protection, or the end of the link?
DeviceTrouble TroubleOf(HDerror error) noexcept {
  switch (error) {
    case HD_WARM_MOTORS:
    case HD_EXCEEDED_MAX_FORCE:
    case HD_EXCEEDED_MAX_FORCE_IMPULSE:
    case HD_EXCEEDED_MAX_VELOCITY:
    case HD_FORCE_ERROR:
      return DeviceTrouble::kProtected;
    default:
      return DeviceTrouble::kReadError;
  }
}

double DoubleOf(HDenum what) {
  HDdouble value = 0;
  hdGetDoublev(what, &value);
  return value;
}

int IntOf(HDenum what) {
  HDint value = 0;
  hdGetIntegerv(what, &value);
  return value;
}

std::string StringOf(HDenum what) {
  const HDstring text = hdGetString(what);
  return text != nullptr ? text : "";
}

// Of the current device.
DeviceCaps CapsOf() {
  DeviceCaps caps;
  caps.input = HandInput::kAbsolute;
  caps.sensed_dof = IntOf(HD_INPUT_DOF);
  caps.actuated_dof = std::min(3, IntOf(HD_OUTPUT_DOF));
  caps.feedback = caps.actuated_dof > 0 ? Feedback::kForce : Feedback::kNone;
  caps.position_quantum = kQuantum;
  caps.gimbal_sigma = kGimbalSigma;
  caps.peak_force = DoubleOf(HD_NOMINAL_MAX_FORCE);
  caps.continuous_force = DoubleOf(HD_NOMINAL_MAX_CONTINUOUS_FORCE);
  caps.max_stiffness = 1e3 * DoubleOf(HD_NOMINAL_MAX_STIFFNESS);  // from N/mm
  // What a wall of that stiffness needs to be passive at this rate: b = K T/2 [Colgate, Schenkel].
  caps.damping = 0.5 * kPeriod * caps.max_stiffness;
  caps.rate = 1 / kPeriod;
  caps.delay_ticks = 2;  // one until its scheduler takes the force, one until it is read
  std::array<HDdouble, 6> box{};
  hdGetDoublev(HD_USABLE_WORKSPACE_DIMENSIONS, box.data());
  caps.min_hip = 1e-3 * glm::dvec3(box[0], box[1], box[2]);
  caps.max_hip = 1e-3 * glm::dvec3(box[3], box[4], box[5]);
  caps.buttons = 2;
  return caps;
}

}  // namespace

// The scheduler's side of a device, and the servo's.
class OpenHapticsDevices::OneDevice final : public Device {
 public:
  OneDevice(HHD handle, double (*clock)() noexcept) : handle_(handle), clock_(clock) {
    hdMakeCurrentDevice(handle_);
    caps_ = CapsOf();
    name_ = StringOf(HD_DEVICE_MODEL_TYPE);
    serial_ = StringOf(HD_DEVICE_SERIAL_NUMBER);
    hdEnable(HD_FORCE_OUTPUT);
  }

  const DeviceCaps& caps() const noexcept override { return caps_; }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return serial_; }

  DeviceSample Read(double now) noexcept override {
    const News& news = news_.Read();
    events_.is_present = events_.is_open = true;
    events_.has_sample = news.sample.valid;
    events_.sample_age = std::max(0.0, now - news.sample.t);
    events_.is_homed = news.is_homed;
    events_.trouble = trouble_.load(std::memory_order_acquire);
    if (events_.trouble == DeviceTrouble::kNone && is_not_finite_)
      events_.trouble = DeviceTrouble::kNotFinite;
    is_not_finite_ = false;
    status_ = Next(status_, events_);
    // Its protection has been told of: it goes on when the hand has let go. What ended the link
    // stays.
    if (events_.trouble == DeviceTrouble::kProtected)
      trouble_.compare_exchange_strong(events_.trouble, DeviceTrouble::kNone);
    events_.trouble = trouble_.load(std::memory_order_acquire);
    DeviceSample sample = news.sample;
    sample.valid = sample.valid &&
                   (status_.state == DeviceState::kReady || status_.state == DeviceState::kArmed);
    return sample;
  }
  void HoldDeadMan(bool is_held) noexcept override { events_.is_dead_man_held = is_held; }
  void Command(const glm::dvec3& force) noexcept override {
    const bool is_finite =
        std::isfinite(force.x) && std::isfinite(force.y) && std::isfinite(force.z);
    is_not_finite_ = !is_finite;
    const bool may_push = is_finite && HasForce(caps_) && MayPush(status_, events_);
    pushes_.Write({may_push ? force : glm::dvec3(0.0), clock_()});
  }
  DeviceStatus status() const noexcept override { return status_; }

  // Scheduler: one frame. `is_released`: no force.
  void Frame(bool is_released) noexcept {
    hdBeginFrame(handle_);
    std::array<HDdouble, 3> position{};
    std::array<HDdouble, 16> transform{};
    hdGetDoublev(HD_CURRENT_POSITION, position.data());
    hdGetDoublev(HD_CURRENT_TRANSFORM, transform.data());
    News news;
    news.sample.buttons = static_cast<std::uint32_t>(IntOf(HD_CURRENT_BUTTONS)) & 0xfu;
    if (frames_++ % kCalibrationEvery == 0) Calibrate();
    news.is_homed = is_homed_;

    const double now = clock_();
    const Push& push = pushes_.Read();
    const bool may_push = !is_released && is_homed_ && now - push.t <= kSilentServo &&
                          trouble_.load(std::memory_order_acquire) == DeviceTrouble::kNone;
    const glm::dvec3 force = may_push ? push.force : glm::dvec3(0.0);
    const std::array<HDdouble, 3> newtons{force.x, force.y, force.z};
    hdSetDoublev(HD_CURRENT_FORCE, newtons.data());
    hdEndFrame(handle_);
    if (TakeErrors()) return;  // what it read is not to be believed

    news.sample.t = now;
    news.sample.hip_in_device = 1e-3 * glm::dvec3(position[0], position[1], position[2]);
    const auto column = [&](std::size_t i) {
      return glm::dvec3(transform[4 * i], transform[4 * i + 1], transform[4 * i + 2]);
    };
    news.sample.handle_in_device =
        glm::normalize(glm::quat_cast(glm::dmat3(column(0), column(1), column(2))));
    const glm::dquat& q = news.sample.handle_in_device;
    const glm::dvec3& x = news.sample.hip_in_device;
    news.sample.valid = std::isfinite(x.x + x.y + x.z + q.w + q.x + q.y + q.z);
    news_.Write(news);
  }

  HHD handle() const noexcept { return handle_; }

 private:
  void Calibrate() noexcept {
    HDenum calibration = hdCheckCalibration();
    if (calibration == HD_CALIBRATION_NEEDS_UPDATE) {
      hdUpdateCalibration(static_cast<HDenum>(IntOf(HD_CALIBRATION_STYLE)));
      calibration = hdCheckCalibration();
    }
    is_homed_ = calibration == HD_CALIBRATION_OK;
  }
  // True: there was one that ends the link.
  bool TakeErrors() noexcept {
    for (int i = 0; i < kMostErrors; ++i) {
      const HDErrorInfo error = hdGetError();
      if (!HD_DEVICE_ERROR(error)) break;
      const DeviceTrouble trouble = TroubleOf(error.errorCode);
      if (trouble_.load(std::memory_order_acquire) != DeviceTrouble::kReadError)
        trouble_.store(trouble, std::memory_order_release);
    }
    return trouble_.load(std::memory_order_acquire) == DeviceTrouble::kReadError;
  }

  HHD handle_;
  double (*clock_)() noexcept;
  DeviceCaps caps_;
  std::string name_, serial_;
  LatestValue<News> news_;
  LatestValue<Push> pushes_;
  std::atomic<DeviceTrouble> trouble_{DeviceTrouble::kNone};
  // The servo's.
  DeviceEvents events_;
  DeviceStatus status_;
  bool is_not_finite_ = false;
  // The scheduler's.
  long frames_ = 0;
  bool is_homed_ = false;
};

struct OpenHapticsDevices::Scheduled {
  std::vector<OneDevice*> devices;
  std::atomic<bool> is_released{false};
  HDSchedulerHandle handle = 0;

  void Frames() noexcept {
    for (OneDevice* device : devices) device->Frame(is_released.load(std::memory_order_relaxed));
  }
  static HDCallbackCode HDCALLBACK EachTick(void* self) {
    static_cast<Scheduled*>(self)->Frames();
    return HD_CALLBACK_CONTINUE;
  }
  static HDCallbackCode HDCALLBACK Once(void* self) {
    static_cast<Scheduled*>(self)->Frames();
    return HD_CALLBACK_DONE;
  }
};

OpenHapticsDevices::OpenHapticsDevices(std::span<const std::string> names,
                                       double (*clock)() noexcept)
    : scheduled_(std::make_unique<Scheduled>()) {
  for (const std::string& name : names) {
    const HHD handle = hdInitDevice(name.empty() ? HD_DEFAULT_DEVICE : name.c_str());
    if (const HDErrorInfo error = hdGetError();
        HD_DEVICE_ERROR(error) || handle == HD_INVALID_HANDLE) {
      for (const auto& device : devices_) hdDisableDevice(device->handle());
      throw Error(Code::kDevice,
                  fmt::format("the device {} could not be opened ({}); check its power and cable, "
                              "and its name in the maker's setup tool",
                              name.empty() ? "of no name" : "\"" + name + "\"",
                              hdGetErrorString(error.errorCode)));
    }
    devices_.push_back(std::make_unique<OneDevice>(handle, clock));
    scheduled_->devices.push_back(devices_.back().get());
  }
  hdStartScheduler();
  scheduled_->handle =
      hdScheduleAsynchronous(Scheduled::EachTick, scheduled_.get(), HD_MAX_SCHEDULER_PRIORITY);
}

OpenHapticsDevices::~OpenHapticsDevices() {
  Release();
  for (int i = 0; i < kLastZeros; ++i)
    hdScheduleSynchronous(Scheduled::Once, scheduled_.get(), HD_MAX_SCHEDULER_PRIORITY);
  hdUnschedule(scheduled_->handle);
  hdStopScheduler();
  for (const auto& device : devices_) hdDisableDevice(device->handle());
}

Device& OpenHapticsDevices::at(std::size_t i) noexcept { return *devices_[i]; }

void OpenHapticsDevices::Release() noexcept {
  scheduled_->is_released.store(true, std::memory_order_relaxed);
}

}  // namespace arthro::simulation
