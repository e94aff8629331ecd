#include "simulation/device/openhaptics/openhaptics_devices.h"

#include <HD/hd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "simulation/core/finite.h"
#include "simulation/core/latest_value.h"

namespace arthro::simulation {
namespace {

constexpr double kSilentServo = 0.010;  // s; then the scheduler sets no force
constexpr int kLastZeros = 5;           // frames; one may be lost
constexpr int kCalibrationEvery = 100;  // frames
constexpr int kMostErrors = 16;  // errors that are taken from the list of the library per frame

// Values of a Touch, which the library does not report [devices.md, Families].
constexpr double kQuantum = 5.5e-5;                              // m
constexpr double kGimbalSigma = 1.0 / 180.0 * std::numbers::pi;  // rad, potentiometers
constexpr double kPeriod = 1e-3;                                 // s, period of the scheduler

struct News {
  DeviceSample sample;
  bool is_homed = false;
};

struct Push {
  glm::dvec3 force{0.0};
  double t = -1;  // s
};

// Distinguishes the protection of the handle from the end of the link.
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

// Reads the capabilities of the current device.
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
  caps.max_stiffness = 1e3 * DoubleOf(HD_NOMINAL_MAX_STIFFNESS);  // N/m, from N/mm
  // Damping that a wall of that stiffness needs to be passive at this rate: b = K T/2 [Colgate &
  // Schenkel 1997].
  caps.damping = 0.5 * kPeriod * caps.max_stiffness;
  caps.rate = 1 / kPeriod;
  caps.delay_ticks = 2;  // one until the scheduler takes the force, one until it is read
  std::array<HDdouble, 6> box{};
  hdGetDoublev(HD_USABLE_WORKSPACE_DIMENSIONS, box.data());
  caps.min_hip = 1e-3 * glm::dvec3(box[0], box[1], box[2]);
  caps.max_hip = 1e-3 * glm::dvec3(box[3], box[4], box[5]);
  caps.buttons = 2;
  return caps;
}

// Discards errors of earlier calls.
void ForgetErrors() {
  for (int i = 0; i < kMostErrors && HD_DEVICE_ERROR(hdGetError()); ++i) {
  }
}

}  // namespace

// State of one device, open or not, shared by the scheduler and a servo.
class OpenHapticsDevices::Line {
 public:
  Line(std::string configured, double (*clock)() noexcept)
      : clock_(clock), configured_(std::move(configured)) {}
  ~Line() { Close(); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  // Call these while the scheduler is stopped.
  void Open() {
    Close();
    ForgetErrors();
    const HHD handle = hdInitDevice(configured_.empty() ? HD_DEFAULT_DEVICE : configured_.c_str());
    if (const HDErrorInfo error = hdGetError();
        HD_DEVICE_ERROR(error) || handle == HD_INVALID_HANDLE) {
      detail_ = fmt::format(
          "{} could not be opened ({}); check its power and cable, and its name in the maker's "
          "setup tool; it is tried again when a practice begins",
          configured_.empty() ? "the default OpenHaptics device"
                              : "the OpenHaptics device \"" + configured_ + "\"",
          hdGetErrorString(error.errorCode));
      return;
    }
    handle_ = handle;
    hdMakeCurrentDevice(handle_);
    caps_ = CapsOf();
    name_ = StringOf(HD_DEVICE_MODEL_TYPE);
    serial_ = StringOf(HD_DEVICE_SERIAL_NUMBER);
    hdEnable(HD_FORCE_OUTPUT);
    detail_.clear();
    trouble_ = DeviceTrouble::kNone;
    news_.Write({});
    pushes_.Write({});
    is_homed_ = false;
    frames_of_opening_ = 0;
    is_open_ = true;
  }
  void Close() noexcept {
    if (handle_ != HD_INVALID_HANDLE) hdDisableDevice(handle_);
    handle_ = HD_INVALID_HANDLE;
    is_open_ = false;
  }
  void Refuse(const std::string& detail) {
    Close();
    detail_ = detail;
  }

  bool is_open() const noexcept { return is_open_; }
  bool is_lost() const noexcept { return trouble() == DeviceTrouble::kReadError; }
  const std::string& configured() const noexcept { return configured_; }
  const std::string& name() const noexcept { return name_; }
  const std::string& serial() const noexcept { return serial_; }
  const DeviceCaps& caps() const noexcept { return caps_; }
  std::string detail() const {
    return is_open_ && is_lost() ? "it was unplugged, switched off or has failed; see to it, then "
                                   "begin the practice again (Escape, F5)"
                                 : detail_;
  }
  long frames() const noexcept { return frames_; }

  // Called by the reader: one servo, or the window while there is none.
  const News& Newest() noexcept { return news_.Read(); }
  DeviceTrouble trouble() const noexcept { return trouble_.load(std::memory_order_acquire); }
  void ForgetProtection() noexcept {
    DeviceTrouble told = DeviceTrouble::kProtected;
    trouble_.compare_exchange_strong(told, DeviceTrouble::kNone);
  }
  void Send(const glm::dvec3& force) noexcept { pushes_.Write({force, clock_()}); }

  // Called by the scheduler, once per frame. `is_released`: sets no force.
  void Frame(bool is_released) noexcept {
    if (!is_open_) return;
    hdBeginFrame(handle_);
    std::array<HDdouble, 3> position{};
    std::array<HDdouble, 16> transform{};
    hdGetDoublev(HD_CURRENT_POSITION, position.data());
    hdGetDoublev(HD_CURRENT_TRANSFORM, transform.data());
    News news;
    news.sample.buttons = static_cast<std::uint32_t>(IntOf(HD_CURRENT_BUTTONS)) & 0xfu;
    if (frames_of_opening_++ % kCalibrationEvery == 0) Calibrate();
    news.is_homed = is_homed_;

    const double now = clock_();
    const Push& push = pushes_.Read();
    const bool may_push = !is_released && is_homed_ && now - push.t <= kSilentServo &&
                          trouble() == DeviceTrouble::kNone;
    const glm::dvec3 force = may_push ? push.force : glm::dvec3(0.0);
    const std::array<HDdouble, 3> newtons{force.x, force.y, force.z};
    hdSetDoublev(HD_CURRENT_FORCE, newtons.data());
    hdEndFrame(handle_);
    if (TakeErrors()) return;  // the sample is not valid

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
    ++frames_;
  }

 private:
  void Calibrate() noexcept {
    HDenum calibration = hdCheckCalibration();
    if (calibration == HD_CALIBRATION_NEEDS_UPDATE) {
      hdUpdateCalibration(static_cast<HDenum>(IntOf(HD_CALIBRATION_STYLE)));
      calibration = hdCheckCalibration();
    }
    is_homed_ = calibration == HD_CALIBRATION_OK;
  }
  // Takes all errors. Returns true where one of them ends the link.
  bool TakeErrors() noexcept {
    for (int i = 0; i < kMostErrors; ++i) {
      const HDErrorInfo error = hdGetError();
      if (!HD_DEVICE_ERROR(error)) break;
      const DeviceTrouble told = TroubleOf(error.errorCode);
      if (!is_lost()) trouble_.store(told, std::memory_order_release);
    }
    return is_lost();
  }

  double (*clock_)() noexcept;
  std::string configured_, name_ = kOpenHapticsName, serial_, detail_;
  HHD handle_ = HD_INVALID_HANDLE;
  DeviceCaps caps_;
  LatestValue<News> news_;
  LatestValue<Push> pushes_;
  std::atomic<DeviceTrouble> trouble_{DeviceTrouble::kNone};
  std::atomic<long> frames_{0};
  std::atomic<bool> is_open_{false};
  // Used by the scheduler only.
  long frames_of_opening_ = 0;
  bool is_homed_ = false;
};

// Device of a servo on a line. A line that is opened again while this lives is used only by the
// next device.
class OpenHapticsDevices::OneHand final : public Device {
 public:
  explicit OneHand(Line& line)
      : line_(line),
        caps_(line.is_open() ? line.caps() : DeviceCaps{}),
        name_(line.name()),
        serial_(line.serial()) {
    events_.is_present = events_.is_open = line.is_open() && !line.is_lost();
  }

  const DeviceCaps& caps() const noexcept override { return caps_; }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return serial_; }

  DeviceSample Read(double now) noexcept override {
    if (!events_.is_open) return {};
    const News& news = line_.Newest();
    events_.has_sample = news.sample.valid;
    events_.sample_age = std::max(0.0, now - news.sample.t);
    events_.is_homed = news.is_homed;
    events_.trouble = line_.trouble();
    if (events_.trouble == DeviceTrouble::kNone && is_not_finite_)
      events_.trouble = DeviceTrouble::kNotFinite;
    is_not_finite_ = false;
    status_ = Next(status_, events_);
    // A trip of the protection is reported once, and the device continues after the dead-man is
    // released. A lost link stays lost.
    line_.ForgetProtection();
    events_.trouble = line_.trouble();
    DeviceSample sample = news.sample;
    sample.valid = sample.valid &&
                   (status_.state == DeviceState::kReady || status_.state == DeviceState::kArmed);
    return sample;
  }
  void HoldDeadMan(bool is_held) noexcept override { events_.is_dead_man_held = is_held; }
  void Command(const glm::dvec3& force) noexcept override {
    const bool is_finite = IsFinite(force);
    is_not_finite_ = !is_finite;
    const bool may_push = is_finite && HasForce(caps_) && MayPush(status_, events_);
    line_.Send(may_push ? force : glm::dvec3(0.0));
  }
  DeviceStatus status() const noexcept override { return status_; }

 private:
  Line& line_;
  DeviceCaps caps_;
  std::string name_, serial_;
  DeviceEvents events_;
  DeviceStatus status_;
  bool is_not_finite_ = false;
};

struct OpenHapticsDevices::Scheduled {
  std::vector<Line*> lines;
  std::atomic<bool> is_released{false}, has_let_go{false};
  HDSchedulerHandle handle = 0;
  std::atomic<bool> is_running{false};

  void Frames() noexcept {
    const bool was_released = is_released.load(std::memory_order_relaxed);
    for (Line* line : lines) line->Frame(was_released);
    if (was_released) has_let_go = true;
  }
  static HDCallbackCode HDCALLBACK EachTick(void* self) {
    static_cast<Scheduled*>(self)->Frames();
    return HD_CALLBACK_CONTINUE;
  }
  static HDCallbackCode HDCALLBACK NoForce(void* self) {
    for (Line* line : static_cast<Scheduled*>(self)->lines) line->Frame(true);
    return HD_CALLBACK_DONE;
  }
};

bool HasOpenHaptics() noexcept { return true; }

OpenHapticsDevices::OpenHapticsDevices(const std::vector<std::string>& names,
                                       double (*clock)() noexcept)
    : scheduled_(std::make_unique<Scheduled>()) {
  for (const std::string& name : names)
    scheduled_->lines.push_back(lines_.emplace_back(std::make_unique<Line>(name, clock)).get());
  OpenMissing();
}

OpenHapticsDevices::~OpenHapticsDevices() {
  Release();
  Stop();
}

void OpenHapticsDevices::OpenMissing() {
  const auto is_missing = [](const auto& line) { return !line->is_open() || line->is_lost(); };
  if (std::ranges::none_of(lines_, is_missing)) return;
  Stop();
  for (const auto& line : lines_)
    if (is_missing(line)) line->Open();
  Start();
}

void OpenHapticsDevices::Start() {
  if (std::ranges::none_of(lines_, [](const auto& line) { return line->is_open(); })) return;
  ForgetErrors();
  scheduled_->handle =
      hdScheduleAsynchronous(Scheduled::EachTick, scheduled_.get(), HD_MAX_SCHEDULER_PRIORITY);
  hdStartScheduler();
  const HDErrorInfo error = hdGetError();
  scheduled_->is_running = !HD_DEVICE_ERROR(error);
  if (!scheduled_->is_running) {
    hdUnschedule(scheduled_->handle);
    for (const auto& line : lines_)
      line->Refuse(
          fmt::format("the scheduler of OpenHaptics did not start ({}); end other programs "
                      "that use these devices, then begin the practice again",
                      hdGetErrorString(error.errorCode)));
  }
}

void OpenHapticsDevices::Stop() noexcept {
  if (!scheduled_->is_running) return;
  for (int i = 0; i < kLastZeros; ++i)
    hdScheduleSynchronous(Scheduled::NoForce, scheduled_.get(), HD_MAX_SCHEDULER_PRIORITY);
  hdUnschedule(scheduled_->handle);
  hdStopScheduler();
  scheduled_->is_running = false;
}

std::size_t OpenHapticsDevices::size() const noexcept { return lines_.size(); }

std::unique_ptr<Device> OpenHapticsDevices::Hand(std::size_t i) {
  return std::make_unique<OneHand>(*lines_[i]);
}

DeviceStatus OpenHapticsDevices::Look(std::size_t i) noexcept {
  Line& line = *lines_[i];
  if (!line.is_open()) return {};
  if (line.is_lost()) return {DeviceState::kLost, DeviceTrouble::kReadError, true};
  return {line.Newest().is_homed ? DeviceState::kReady : DeviceState::kHoming, {}, true};
}

std::string OpenHapticsDevices::detail(std::size_t i) const { return lines_[i]->detail(); }
bool OpenHapticsDevices::is_open(std::size_t i) const noexcept {
  return lines_[i]->is_open() && !lines_[i]->is_lost();
}
long OpenHapticsDevices::frames(std::size_t i) const noexcept { return lines_[i]->frames(); }

void OpenHapticsDevices::Release() noexcept {
  scheduled_->is_released.store(true, std::memory_order_relaxed);
}

bool OpenHapticsDevices::IsReleased() const noexcept {
  return !scheduled_->is_running || scheduled_->has_let_go;
}

}  // namespace arthro::simulation
