#include "simulation/practice/hands/hands.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/json/rig_io.h"

namespace arthro::simulation {

namespace {

// Serial number of a simulated device.
const char* SerialOf(DeviceRole role) { return role == DeviceRole::kScope ? "1" : "2"; }

const char* ToString(HandKind kind) {
  switch (kind) {
    case HandKind::kMouse:
      return "mouse and keys";
    case HandKind::kRecorded:
      return "recorded hand";
    case HandKind::kSimulated:
    case HandKind::kPluggedIn:
      break;
  }
  return "simulated device";
}

// Status of a device that no servo reads. Freshness is not asked for, since a board that only
// answers requests is then read too seldom.
DeviceStatus StatusOfLink(LiveLink& link, int hand) {
  if (const DeviceTrouble trouble = link.trouble(); trouble != DeviceTrouble::kNone)
    return {DeviceState::kFault, trouble, true};
  if (!link.is_present()) return {DeviceState::kAbsent, {}, true};
  const int opening = link.opening();
  if (opening == 0) return {DeviceState::kOpening, {}, true};
  const HandNews& news = link.Newest(hand);
  const bool is_homed = news.opening == opening ? news.reading.is_homed : !IsSteady(link.caps());
  return {is_homed ? DeviceState::kReady : DeviceState::kHoming, {}, true};
}

}  // namespace

Hands::Hands(HandsChoice choice, std::unique_ptr<HidBus> bus, const LiveOptions& options)
    : choice_(std::move(choice)),
      options_(options),
      bus_(std::move(bus)),
      is_zero_force_(choice_.is_zero_force) {
  for (const TraceRow& row : choice_.trace) is_recorded_[Index(row.device)] = true;
  if (!choice_.log.empty()) OpenLog();
  if (choice_.rig) OpenRig();
}

Hands::~Hands() = default;

const std::optional<RigRole>& Hands::RigOf(DeviceRole role) const noexcept {
  static const std::optional<RigRole> none;
  if (!choice_.rig) return none;
  return role == DeviceRole::kScope ? choice_.rig->scope : choice_.rig->instrument;
}

void Hands::OpenRig() {
  std::vector<std::string> names;
  for (const DeviceRole role : kDeviceRoles)
    if (const auto& own = DrivenOf(role); own && IsOpenHaptics(own->device)) {
      roles_[Index(role)].number = names.size();
      names.push_back(own->device.serial);
    } else if (own) {
      roles_[Index(role)].link = LinkOf(own->device);
    }
  if (choice_.rig->pedals) pedals_ = LinkOf(choice_.rig->pedals->device);
  std::vector<std::shared_ptr<Releasable>> devices;
  for (const Link& own : links_) devices.push_back(own.link);
  if (!names.empty()) {
    openhaptics_ = std::make_shared<OpenHapticsDevices>(names, options_.clock);
    devices.push_back(openhaptics_);
  }
  for (const DeviceRole role : kDeviceRoles)
    if (DrivenOf(role)) roles_[Index(role)].device = DeviceOf(role);
  crash_.emplace(std::move(devices));
}

// Makes a device for a servo: it begins without force, and its dead-man must be released first.
std::unique_ptr<Device> Hands::DeviceOf(DeviceRole role) {
  const Role& own = Of(role);
  if (own.number) return openhaptics_->Hand(*own.number);
  return std::make_unique<LiveDevice>(own.link, RigOf(role)->device.hand);
}

const std::optional<RigRole>& Hands::DrivenOf(DeviceRole role) const noexcept {
  static const std::optional<RigRole> none;
  return choice_.is_simulated || is_recorded_[Index(role)] ? none : RigOf(role);
}

// Lists one source per link, in the order in which links are made, then the hands without a link.
void Hands::OpenLog() {
  std::vector<LogSource> sources;
  const auto source_of = [&](const RigDevice& device) {
    for (std::size_t i = 0; i < sources.size(); ++i)
      if (sources[i].family == device.family && sources[i].serial == device.serial) return i;
    sources.push_back({device.family, device.model, device.serial, {}});
    return sources.size() - 1;
  };
  // Devices of the maker's library give no HID reports.
  const auto has_reports = [&](DeviceRole role) {
    return DrivenOf(role) && !IsOpenHaptics(DrivenOf(role)->device);
  };
  for (const DeviceRole role : kDeviceRoles)
    if (has_reports(role)) {
      const auto& own = DrivenOf(role);
      const std::size_t source = source_of(own->device);
      logged_[Index(role)] = {static_cast<int>(source), own->device.hand};
      sources[source].roles[static_cast<std::size_t>(own->device.hand)] = role;
    }
  if (choice_.rig && choice_.rig->pedals) source_of(choice_.rig->pedals->device);
  const std::size_t links = sources.size();
  for (const DeviceRole role : kDeviceRoles)
    if (!has_reports(role)) {
      logged_[Index(role)] = {static_cast<int>(sources.size()), 0};
      std::string serial = choice_.is_simulated ? SerialOf(role) : "";
      if (const auto& own = DrivenOf(role)) serial = own->device.serial;
      sources.push_back({"", "", serial, {role, {}}});
    }
  log_ = std::make_unique<DeviceLog>(choice_.log, sources);
  wishes_ = &log_->AddChannel();
  for (std::size_t i = 0; i < links; ++i)
    taps_.push_back(std::make_unique<LoggedReports>(*log_, static_cast<int>(i)));
}

void Hands::LogWish(double t, const LoggedWish& wish) noexcept {
  if (wishes_ == nullptr) return;
  LogRecord record;
  record.kind = LogKind::kWish;
  record.t_ns = static_cast<std::int64_t>(std::llround(1e9 * t));
  record.wish = wish;
  wishes_->Push(record);
}

void Hands::LogOption(double t, const LoggedOption& option) noexcept {
  if (wishes_ == nullptr) return;
  LogRecord record;
  record.kind = LogKind::kOption;
  record.t_ns = static_cast<std::int64_t>(std::llround(1e9 * t));
  record.option = option;
  wishes_->Push(record);
}

std::shared_ptr<LiveLink> Hands::LinkOf(const RigDevice& device) {
  DeviceRequest request;
  request.family = DeviceFamilyFromString(device.family).value_or(request.family);
  request.serial = device.serial;
  request.model = device.model;
  for (const Link& known : links_)
    if (known.request.family == request.family && known.request.serial == request.serial)
      return known.link;
  LiveOptions options = options_;
  if (!bus_) bus_ = MachineHidBus();
  if (log_) options.tap = taps_[links_.size()].get();
  links_.push_back({request, std::make_shared<LiveLink>(*bus_, request, options)});
  return links_.back().link;
}

void Hands::Mount(Scene& scene) const {
  scene.rig.scope = MountOf(DeviceRole::kScope, scene);
  scene.rig.instrument = MountOf(DeviceRole::kInstrument, scene);
}

DeviceRig Hands::MountOf(DeviceRole role, const Scene& scene) const {
  DeviceRig mount = role == DeviceRole::kScope ? scene.rig.scope : scene.rig.instrument;
  if (const auto& own = RigOf(role)) mount = own->mount;
  if (const auto& pivot = pivots_[Index(role)]) mount.pivot = *pivot;
  return mount;
}

double Hands::TipBeyondRod(ToolKind kind) const noexcept {
  const auto& own = RigOf(DeviceRole::kInstrument);
  for (std::size_t i = 0; own && i < std::size(kInstrumentKinds); ++i)
    if (ToolKindFromString(kInstrumentKinds[i]) == kind) return own->tip_offsets.beyond_rod[i];
  return 0;
}

void Hands::LowerLimits(SessionOptions& options) const noexcept {
  for (const DeviceRole role : kDeviceRoles)
    if (const auto& own = RigOf(role)) {
      if (own->max_force > 0)
        options.limiter.max_force = std::min(options.limiter.max_force, own->max_force);
      if (own->max_stiffness > 0)
        options.lever.max_stiffness = std::min(options.lever.max_stiffness, own->max_stiffness);
    }
}

std::shared_ptr<HeldHands> Hands::MakeHeldHands(const std::array<ScriptedDevice, 2>& by_mouse) {
  if (openhaptics_) {
    openhaptics_->OpenMissing();
    for (const DeviceRole role : kDeviceRoles)
      if (Of(role).number) roles_[Index(role)].device = DeviceOf(role);
  }
  const auto parts_of = [&](DeviceRole role) {
    HandParts parts{HandKind::kMouse, by_mouse[Index(role)], {}, {}, {}, {}, 0, kNoButtons};
    ScriptedDevice start = parts.by_mouse;
    const DeviceSample at = start.Sample(0.0);
    if (choice_.is_simulated) {
      auto plant =
          std::make_unique<PlantDevice>(PlantOptions{}, kHand, at.hip_in_device, SerialOf(role));
      parts.kind = HandKind::kSimulated;
      parts.led = &plant->plant();
      parts.device = std::move(plant);
    } else if (KindOf(role) == HandKind::kRecorded) {
      parts.kind = HandKind::kRecorded;
      parts.recorded = std::make_unique<RecordedDevice>(choice_.trace, role);
      parts.recording_begins = choice_.trace.front().sample.t;
    } else if (const auto& own = DrivenOf(role)) {
      parts.kind = HandKind::kPluggedIn;
      parts.device = DeviceOf(role);
      if (parts.device->caps().input == HandInput::kRate)
        parts.integrates = dynamic_cast<LiveDevice*>(parts.device.get());
      parts.buttons = own->buttons;
    }
    return parts;
  };
  PedalParts pedals;
  if (pedals_) {
    const RigPedals& own = *choice_.rig->pedals;
    pedals.device = std::make_unique<LiveDevice>(pedals_, own.device.hand);
    pedals.buttons = own.buttons;
  }
  auto held = std::make_shared<HeldHands>(
      std::array{parts_of(DeviceRole::kScope), parts_of(DeviceRole::kInstrument)},
      std::move(pedals));
  if (log_)
    for (const DeviceRole role : kDeviceRoles)
      held->LogTo(*log_, role, logged_[Index(role)].source, logged_[Index(role)].hand);
  held_ = held;
  return held;
}

bool Hands::Look() {
  if (!held_.expired()) return false;  // the servo of the practice reads them
  bool has_news = false;
  for (const DeviceRole role : kDeviceRoles)
    if (Role& own = roles_[Index(role)]; own.device) {
      const auto before =
          std::exchange(own.status, own.number ? openhaptics_->Look(*own.number)
                                               : StatusOfLink(*own.link, RigOf(role)->device.hand));
      has_news = has_news || !(before == own.status);
    }
  return has_news;
}

DeviceStatus Hands::StatusOf(DeviceRole role) const {
  const auto held = held_.lock();
  return held ? held->ReadReport().hand[Index(role)].status : Of(role).status;
}

// Detail beyond the state.
std::string Hands::DetailOf(DeviceRole role) const {
  const Role& own = Of(role);
  return own.number ? openhaptics_->detail(*own.number) : own.link ? own.link->detail() : "";
}

bool Hands::Leads(DeviceRole role) const {
  const auto held = held_.lock();
  return held && held->ReadReport().hand[Index(role)].is_led_by_device;
}

ForceHistory Hands::History(DeviceRole role) const {
  const auto held = held_.lock();
  return held ? held->ReadReport().hand[Index(role)].history : ForceHistory{};
}

HandKind Hands::KindOf(DeviceRole role) const {
  if (choice_.is_simulated) return HandKind::kSimulated;
  if (DrivenOf(role)) return HandKind::kPluggedIn;
  return is_recorded_[Index(role)] ? HandKind::kRecorded : HandKind::kMouse;
}

std::string Hands::WhyNotCalibrated(DeviceRole role) const {
  const HandKind kind = KindOf(role);
  if (kind == HandKind::kMouse)
    return "Mouse and keys hold this hand, and their incision is where they say.";
  if (kind != HandKind::kPluggedIn) return "";
  const DeviceCaps& caps = Of(role).device->caps();
  if (caps.input == HandInput::kRate)
    return "This device is pushed and has no rod, so it has no incision to find.";
  if (caps.sensed_dof > 0 && caps.sensed_dof < 5)
    return "This device does not say how its handle is turned, so its rod's line is not known; "
           "measure the pivot and write it into the rig file.";
  return "";
}

void Hands::Calibrate(std::optional<DeviceRole> role) {
  calibrated_ = role;
  DeviceSample old;
  while (ReadSample(old)) {
  }
}

bool Hands::ReadSample(DeviceSample& sample) {
  const auto held = held_.lock();
  return held && held->ReadSample(sample);
}

void Hands::SetPivot(DeviceRole role, const glm::dvec3& pivot_in_device) {
  pivots_[Index(role)] = pivot_in_device;
}

void Hands::SaveRig(const std::filesystem::path& file) {
  RigPivots pivots;
  if (RigOf(DeviceRole::kScope)) pivots.scope = pivots_[Index(DeviceRole::kScope)];
  if (RigOf(DeviceRole::kInstrument)) pivots.instrument = pivots_[Index(DeviceRole::kInstrument)];
  WriteRigWith(pivots, choice_.rig_file, file);
  choice_.rig_file = file;
}

HandNow Hands::Now(DeviceRole role) const {
  HandNow now;
  const auto held = held_.lock();
  const Role& own = Of(role);
  if (held || own.device) now.kind = KindOf(role);
  now.situation.kind = now.kind;
  now.situation.is_zero_force = is_zero_force_;
  now.situation.is_practising = held != nullptr;
  now.situation.is_calibrating = calibrated_.has_value();
  now.situation.status = StatusOf(role);
  now.name = ToString(now.kind);
  const Device* device = held ? held->Of(role) : own.device.get();
  if (device != nullptr && (now.kind == HandKind::kPluggedIn || now.kind == HandKind::kSimulated)) {
    now.name = device->name();
    now.serial = device->serial();
    now.situation.caps = device->caps();
    now.peak = device->caps().peak_force;
    now.sentence = DescribeStatus(now.situation.status);
  }
  if (!IsReady(now.situation.status.state))
    if (const std::string detail = DetailOf(role); !detail.empty()) now.sentence = detail;
  if (!held) return now;

  const HandsReport::Hand& report = held->ReadReport().hand[Index(role)];
  now.felt = report.felt;
  now.given = report.given;
  now.sample_age = report.age;
  now.is_led_by_device = report.is_led_by_device;
  now.situation.sample_age = report.age;
  now.situation.fault = report.fault;
  now.situation.has_force = report.felt > 0;
  now.situation.is_dead_man_held = report.is_dead_man_held;
  if (now.kind == HandKind::kRecorded)
    now.sentence = report.is_led_by_device ? "is played" : "has ended; mouse and keys hold it";
  if (report.last_fault.state != DeviceState::kAbsent)
    now.last_fault = DescribeStatus(report.last_fault);
  return now;
}

std::string Hands::Missing(DeviceRole role) const {
  const Role& own = Of(role);
  if (!own.device) return "";
  const DeviceState state = StatusOf(role).state;
  if (IsReady(state)) return "";
  const std::string& name = own.device->name();
  return state == DeviceState::kAbsent
             ? fmt::format("No {}: mouse and keys hold the {}.", name, ToString(role))
             : fmt::format("{}: {} (F4). Mouse and keys hold the {}.", name, ToString(state),
                           ToString(role));
}

void Hands::AskHome(DeviceRole role) {
  if (Of(role).link) Of(role).link->AskHome();
}

std::string Hands::End() {
  crash_.reset();
  pedals_.reset();
  roles_ = {};
  links_.clear();
  openhaptics_.reset();
  if (!log_) return "";
  log_->Close();
  const long dropped = log_->dropped();
  return dropped == 0 ? ""
                      : fmt::format("{}: {} records were dropped, since this machine was too busy",
                                    choice_.log.string(), dropped);
}

}  // namespace arthro::simulation
