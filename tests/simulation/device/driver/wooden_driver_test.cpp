#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/device/driver/drivers.h"

namespace arthro::simulation {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes Report(const std::array<int, 6>& encoder, int info = 0, std::size_t size = 14) {
  Bytes report(size);
  for (std::size_t i = 0; i < 6; ++i)
    PutSigned(report, 2 * i, static_cast<std::int16_t>(encoder[i]));
  PutSigned(report, 12, static_cast<std::int16_t>(info));
  return report;
}

std::unique_ptr<DeviceDriver> Make(const char* model, bool is_padded = false) {
  auto driver = MakeWoodenDriver(*FindWoodenModel(model), is_padded);
  driver->Forget();
  return driver;
}

// Homes the arm: presses its button in the rest and sets its counters.
void Home(DeviceDriver& driver, const std::array<int, 6>& home) {
  driver.Take(Report({1, 2, 3, 0, 0, 0}, 1));
  driver.Take(Report(home));
}

TEST(WoodenDriver, IsHomedByItsButton) {
  const auto driver = Make("woodenhaptics_2015");
  EXPECT_EQ(driver->Take(Report({0, 0, 6000, 0, 0, 0})), ReportNews::kTaken);
  EXPECT_FALSE(driver->Hand(0).is_homed) << "by chance there, but nobody said so";
  EXPECT_FALSE(driver->WantsHome());
  driver->Take(Report({10, 20, 6000, 0, 0, 0}, 1));
  EXPECT_TRUE(driver->WantsHome());
  EXPECT_FALSE(driver->Hand(0).is_homed);
  const OutputReport set = driver->HomeReport();
  EXPECT_EQ(Bytes(set.span().begin(), set.span().end()),
            (Bytes{0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0x70, 0x17}));
  driver->Take(Report({10, 20, 300, 0, 0, 0}));
  EXPECT_TRUE(driver->WantsHome()) << "the counters are not set yet";
  driver->Take(Report({1, -1, 5999, 0, 0, 0}));
  EXPECT_FALSE(driver->WantsHome());
  EXPECT_TRUE(driver->Hand(0).is_homed);
  // Upper link up, lower link level: 245 mm from the column minus 220, 285 mm up minus 80.
  const glm::dvec3 hip = driver->Hand(0).sample.hip_in_device;
  EXPECT_LT(glm::distance(hip, glm::dvec3(0.025, 0, 0.205)), 3e-4) << "m, within some counts";
  driver->Forget();
  EXPECT_FALSE(driver->Hand(0).is_homed);
}

TEST(WoodenDriver, IsHomedByARequest) {
  const auto driver = Make("woodenhaptics_2015");
  driver->AskHome();
  EXPECT_TRUE(driver->WantsHome());
  driver->Take(Report({0, 0, 6000, 0, 0, 0}));
  EXPECT_TRUE(driver->Hand(0).is_homed);
}

TEST(WoodenDriver, PushesInTheDirectionOfTheForce) {
  for (const WoodenModel& model : WoodenModels()) {
    const auto driver = Make(model.word);
    std::array<int, 6> home{};
    for (std::size_t i = 0; i < 6; ++i) home[i] = model.home[i];
    Home(*driver, home);
    const glm::dvec3 joints = driver->Hand(0).joints;
    const glm::dvec3 way = glm::normalize(glm::dvec3(0.4, -0.7, 0.5));
    for (const double newton : {0.5, 3.0, 1e6}) {
      const OutputReport report = driver->ForceReport(newton * way, joints);
      ASSERT_EQ(report.size, 15u);
      glm::dvec3 amperes;
      for (int i = 0; i < 3; ++i)
        amperes[i] = 1e-3 * SignedAt(report.span(), static_cast<std::size_t>(1 + 2 * i));
      const glm::dvec3 torque =
          amperes * model.arm.sign * model.arm.torque_constant / model.arm.transmission;
      const glm::dvec3 force =
          glm::inverse(glm::transpose(WoodenJacobian(model.arm, joints))) * torque;
      // Rounding by 1 mA in some hundred is below 0.5°.
      EXPECT_GT(glm::dot(glm::normalize(force), way), 1 - 4e-5) << model.word << " " << newton;
      if (newton < 1) {
        EXPECT_NEAR(glm::length(force), newton, 0.005);
      }
    }
  }
}

TEST(WoodenDriver, Writes65BytesToARawHidBoard) {
  const auto driver = Make("polhem_v1", true);
  EXPECT_EQ(driver->ForceReport(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 1)).size, 65u);
  EXPECT_EQ(driver->HomeReport().size, 65u);
  EXPECT_EQ(driver->Take(Report({0, 0, 0, 0, 0, 0}, 0, 64)), ReportNews::kTaken);
}

TEST(WoodenDriver, ReadsButtonAndGimbalOfAPolhem) {
  const auto driver = Make("polhem_v1");
  Home(*driver, {0, 0, -5000, 0, 0, 0});
  ASSERT_TRUE(driver->Hand(0).is_homed);
  EXPECT_EQ(driver->Hand(0).sample.buttons, 0u);
  EXPECT_LT(glm::distance(driver->Hand(0).sample.hip_in_device, glm::dvec3(-0.007, 0, 0.132)),
            1e-4);
  // Encoder f turns first (−, about x), e next (+, about y), d last.
  for (int e = 0; e <= 256; e += 16) driver->Take(Report({0, 0, -5000, 0, e, 0}));
  EXPECT_LT(glm::distance(driver->Hand(0).sample.handle_in_device * glm::dvec3(0, 0, 1),
                          glm::dvec3(1, 0, 0)),
            1e-9)
      << "a quarter about y";
  for (int f = 0; f <= 256; f += 16) driver->Take(Report({0, 0, -5000, 0, 256, f}));
  EXPECT_LT(glm::distance(driver->Hand(0).sample.handle_in_device * glm::dvec3(1, 0, 0),
                          glm::dvec3(0, -1, 0)),
            1e-9)
      << "then one the other way about the arm's x";
  driver->Take(Report({0, 0, -5000, 10000, 256, 256}));
  EXPECT_EQ(driver->Hand(0).sample.buttons, 1u) << "its button is in encoder d";
}

TEST(WoodenDriver, HardCase05AWrapIsUnwrappedAndAFlippedBitRejected) {
  const auto driver = Make("woodenhaptics_2015");
  Home(*driver, {0, 0, 6000, 0, 0, 0});
  glm::dvec3 last = driver->Hand(0).sample.hip_in_device;
  double largest = 0;
  // The base turns past 32767 counts, more than one turn, without a step of the hand.
  for (int count = 0; count < 40000; count += 60) {
    const int wrapped = count > 32767 ? count - 65536 : count;
    ASSERT_EQ(driver->Take(Report({wrapped, 0, 6000, 0, 0, 0})), ReportNews::kTaken) << count;
    const glm::dvec3 hip = driver->Hand(0).sample.hip_in_device;
    largest = std::max(largest, glm::distance(hip, last));
    last = hip;
  }
  EXPECT_LT(largest, 0.005) << "m in a report";
  EXPECT_EQ(driver->Take(Report({39960 - 65536, 0, 6000, 0, 0, 0})), ReportNews::kTaken);
  for (int bit = 7; bit < 16; ++bit) {
    const int flipped = static_cast<std::int16_t>(6000 ^ (1 << bit));
    EXPECT_EQ(driver->Take(Report({39960 - 65536, 0, flipped, 0, 0, 0})), ReportNews::kRejected);
    EXPECT_EQ(driver->Take(Report({39960 - 65536, 0, 6000, 0, 0, 0})), ReportNews::kTaken);
  }
  EXPECT_LT(glm::distance(driver->Hand(0).sample.hip_in_device, last), 1e-12);
}

TEST(WoodenDriver, RefusesAnUnknownGeometry) {
  KnownDevice device;
  device.family = DeviceFamily::kWoodenHaptics;
  std::string refusal;
  for (const char* word : {"polhem_v2", "polhem_v3"}) {
    EXPECT_FALSE(MakeDriver(device, word, refusal));
    EXPECT_NE(refusal.find("not published"), std::string::npos) << refusal;
  }
  EXPECT_FALSE(MakeDriver(device, "", refusal));
  EXPECT_NE(refusal.find("woodenhaptics_2015 or polhem_v1"), std::string::npos) << refusal;
  EXPECT_FALSE(MakeDriver(device, "omni", refusal));
  EXPECT_NE(refusal.find("no model omni"), std::string::npos) << refusal;
  EXPECT_TRUE(MakeDriver(device, "polhem_v1", refusal));
}

TEST(WoodenDriver, CapabilitiesMatchTheArm) {
  const DeviceCaps polhem = Make("polhem_v1")->caps(), wooden = Make("woodenhaptics_2015")->caps();
  EXPECT_EQ(polhem.sensed_dof, 6);
  EXPECT_EQ(wooden.sensed_dof, 3);
  EXPECT_TRUE(HasForce(polhem) && HasForce(wooden));
  // One count at the upper link: 205 mm 2 pi / 2000 x 10 / 120 is 0.054 mm; at the lower 0.064.
  EXPECT_NEAR(wooden.position_quantum, 6.41e-5, 1e-7);
  EXPECT_NEAR(polhem.position_quantum, 5.47e-5, 1e-7);
  EXPECT_NEAR(polhem.gimbal_sigma, 2 * std::numbers::pi / 1024 / std::sqrt(12.0), 1e-15);
  EXPECT_EQ(wooden.gimbal_sigma, 0);
}

}  // namespace
}  // namespace arthro::simulation
