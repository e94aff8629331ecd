// Random bytes of random lengths in every driver: nothing crashes, results are finite, rejected
// reports change nothing, and nothing is allocated.
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"
#include "simulation/device/driver/drivers.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

bool IsSame(const HandReading& a, const HandReading& b) {
  return a.sample.hip_in_device == b.sample.hip_in_device &&
         a.sample.handle_in_device == b.sample.handle_in_device &&
         a.sample.buttons == b.sample.buttons && a.push == b.push && a.turn == b.turn &&
         a.joints == b.joints && a.is_homed == b.is_homed;
}

class FuzzedDriver : public testing::TestWithParam<DeviceFamily> {};

TEST_P(FuzzedDriver, HardCase04RejectsInvalidReportsAndStaysFinite) {
  KnownDevice device;
  device.family = GetParam();
  std::string refusal;
  const auto driver = MakeDriver(device, "polhem_v1", refusal);
  driver->Forget();
  Random random(4);
  int taken = 0, rejected = 0;
  std::vector<std::uint8_t> report;
  report.reserve(100);
  const std::vector<std::size_t> lengths{0, 1, 2, 7, 10, 13, 14, 15, 50, 52, 63, 64, 65, 78, 91};
  const std::vector<std::uint8_t> ids{0x01, 0x02, 0x03, 0x11, 0x17, 0x31};
  const long before = test::Allocations();
  for (int i = 0; i < 100000; ++i) {
    report.resize(lengths[random.Below(lengths.size())]);
    for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random.Below(256));
    if (!report.empty() && i % 2) report[0] = ids[random.Below(ids.size())];
    // Small counters, so that an arm accepts some.
    if (i % 4 == 0)
      for (std::size_t k = 0; k < report.size(); ++k) report[k] = k % 2 ? 0 : report[k] & 0x3f;
    // A valid quaternion, so that the Hydra accepts some.
    for (const std::size_t at : {14u, 36u})
      if (report.size() >= 52 && i % 3) {
        for (std::size_t k = 0; k < 8; ++k) report[at + k] = 0;
        report[at + 1] = 0x7f;
      }
    const HandReading was = driver->Hand(driver->hands() - 1);
    const ReportNews news = driver->Take(report);
    taken += news == ReportNews::kTaken;
    rejected += news == ReportNews::kRejected;
    for (int hand = 0; hand < driver->hands(); ++hand) {
      const HandReading now = driver->Hand(hand);
      ASSERT_TRUE(std::isfinite(glm::length(now.sample.hip_in_device)));
      ASSERT_NEAR(glm::length(now.sample.handle_in_device), 1, 1e-9);
      ASSERT_LE(glm::length(now.push) + glm::length(now.turn), 2 * std::sqrt(3.0));
      const OutputReport output = driver->ForceReport({1, -2, 3}, now.joints);
      ASSERT_LE(output.size, output.bytes.size());
    }
    if (news != ReportNews::kTaken) {
      ASSERT_TRUE(IsSame(was, driver->Hand(driver->hands() - 1)));
    }
  }
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_GT(taken, 100);
  EXPECT_GT(rejected, 10000);
}

INSTANTIATE_TEST_SUITE_P(Families, FuzzedDriver,
                         testing::ValuesIn(AllFamilies().begin(), AllFamilies().end()),
                         [](const auto& family) { return std::string(ToString(family.param)); });

}  // namespace
}  // namespace arthro::simulation
