// Build without the library: none of its devices exists.
#include "simulation/device/openhaptics/openhaptics_devices.h"

namespace arthro::simulation {

class OpenHapticsDevices::Line {};
struct OpenHapticsDevices::Scheduled {};

// Device that is permanently absent.
class OpenHapticsDevices::OneHand final : public Device {
 public:
  const DeviceCaps& caps() const noexcept override { return caps_; }
  const std::string& name() const noexcept override { return name_; }
  const std::string& serial() const noexcept override { return serial_; }
  DeviceSample Read(double) noexcept override { return {}; }
  void HoldDeadMan(bool) noexcept override {}
  void Command(const glm::dvec3&) noexcept override {}
  DeviceStatus status() const noexcept override { return {}; }

 private:
  DeviceCaps caps_;
  std::string name_ = kOpenHapticsName, serial_;
};

bool HasOpenHaptics() noexcept { return false; }

OpenHapticsDevices::OpenHapticsDevices(const std::vector<std::string>& names, double (*)() noexcept)
    : lines_(names.size()) {}
OpenHapticsDevices::~OpenHapticsDevices() = default;
std::size_t OpenHapticsDevices::size() const noexcept { return lines_.size(); }
void OpenHapticsDevices::OpenMissing() {}
std::unique_ptr<Device> OpenHapticsDevices::Hand(std::size_t) {
  return std::make_unique<OneHand>();
}
DeviceStatus OpenHapticsDevices::Look(std::size_t) noexcept { return {}; }
std::string OpenHapticsDevices::detail(std::size_t) const { return kNoOpenHaptics; }
bool OpenHapticsDevices::is_open(std::size_t) const noexcept { return false; }
long OpenHapticsDevices::frames(std::size_t) const noexcept { return 0; }
void OpenHapticsDevices::Release() noexcept {}
bool OpenHapticsDevices::IsReleased() const noexcept { return true; }

}  // namespace arthro::simulation
