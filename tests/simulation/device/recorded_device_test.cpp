#include "simulation/device/recorded_device.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TraceRow Row(double t, double x, DeviceRole device = DeviceRole::kScope) {
  TraceRow row;
  row.device = device;
  row.sample.t = t;
  row.sample.hip_in_device = {x, 0, 0};
  row.sample.handle_in_device = glm::angleAxis(x, glm::dvec3(0, 0, 1));
  row.sample.buttons = static_cast<std::uint32_t>(10 * x);
  row.sample.valid = true;
  return row;
}

TEST(RecordedDevice, IsARowAtItsTimeAndInterpolatesBetweenRows) {
  const std::vector<TraceRow> rows{Row(1, 0.1), Row(1, 0.7, DeviceRole::kInstrument), Row(2, 0.3)};
  RecordedDevice scope(rows, DeviceRole::kScope);
  EXPECT_FALSE(scope.At(0.5).valid) << "before its first row there is no device";
  EXPECT_EQ(scope.At(1).hip_in_device.x, 0.1);
  const DeviceSample between = scope.At(1.5);
  EXPECT_TRUE(between.valid);
  EXPECT_EQ(between.t, 1.5);
  EXPECT_NEAR(between.hip_in_device.x, 0.2, 1e-15);
  EXPECT_NEAR(glm::angle(between.handle_in_device), 0.2, 1e-12);
  EXPECT_EQ(between.buttons, 1u) << "a button holds until the next row";
  EXPECT_EQ(scope.At(2).hip_in_device.x, 0.3);
  EXPECT_FALSE(scope.At(2.001).valid) << "after its last row it is gone";
}

TEST(RecordedDevice, TheLastOfEqualTimesCounts) {
  const std::vector<TraceRow> rows{Row(1, 0.1), Row(1, 0.2), Row(2, 0.4)};
  RecordedDevice scope(rows, DeviceRole::kScope);
  EXPECT_EQ(scope.At(1).hip_in_device.x, 0.2);
  EXPECT_NEAR(scope.At(1.5).hip_in_device.x, 0.3, 1e-15);
}

TEST(RecordedDevice, ARoleWithoutRowsIsAbsent) {
  const std::vector<TraceRow> rows{Row(1, 0.1)};
  RecordedDevice instrument(rows, DeviceRole::kInstrument);
  EXPECT_TRUE(instrument.empty());
  EXPECT_FALSE(instrument.At(1).valid);
}

}  // namespace
}  // namespace arthro::simulation
