#include "simulation/device/codec/space_mouse.h"
#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

class SpaceMouseDriver final : public DeviceDriver {
 public:
  SpaceMouseDriver() {
    caps_.input = HandInput::kRate;
    caps_.sensed_dof = 6;
    caps_.rate = 125;
    caps_.min_hip = glm::dvec3(-0.2);
    caps_.max_hip = glm::dvec3(0.2);
    caps_.buttons = 2;
  }
  const DeviceCaps& caps() const noexcept override { return caps_; }

  ReportNews Take(ReportBytes report) noexcept override {
    switch (TakeReport(report, mouse_)) {
      case SpaceMouseNews::kRejected:
        return ReportNews::kRejected;
      case SpaceMouseNews::kIgnored:
        return ReportNews::kIgnored;
      case SpaceMouseNews::kTaken:
        break;
    }
    return ReportNews::kTaken;
  }
  HandReading Hand(int /*hand*/) const noexcept override {
    HandReading hand;
    hand.push = mouse_.push;
    hand.turn = mouse_.turn;
    hand.sample.buttons = mouse_.buttons;
    hand.sample.valid = true;
    return hand;
  }
  void Forget() noexcept override { mouse_ = {}; }

 private:
  DeviceCaps caps_;
  SpaceMouse mouse_;
};

}  // namespace

std::unique_ptr<DeviceDriver> MakeSpaceMouseDriver() {
  return std::make_unique<SpaceMouseDriver>();
}

}  // namespace arthro::simulation
