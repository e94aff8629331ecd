#include "simulation/device/trace_io.h"

#include <bit>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

const std::string kHeader = "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n";

// Message of ParseTrace; empty where it accepts the text.
std::string Refusal(const std::string& text) {
  try {
    ParseTrace(text, "trace.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    return error.what();
  }
  return "";
}

bool SameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(Trace, ReadsRows) {
  const auto rows = ParseTrace(kHeader +
                               "0,scope,0.1,-0.2,3e-3,1,0,0,0,0\n"
                               "0,instrument,0,0,0,0,0.6,0.8,0,4294967295\r\n"
                               "0.001,scope,0,0,0,1,0,0,0,2\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].device, DeviceRole::kScope);
  EXPECT_EQ(rows[0].sample.hip_in_device, glm::dvec3(0.1, -0.2, 0.003));
  EXPECT_EQ(rows[1].device, DeviceRole::kInstrument);
  EXPECT_EQ(rows[1].sample.handle_in_device, glm::dquat(0, 0.6, 0.8, 0));
  EXPECT_EQ(rows[1].sample.buttons, 4294967295u);
  EXPECT_EQ(rows[2].sample.t, 0.001);
  EXPECT_TRUE(rows[2].sample.valid);
}

TEST(Trace, RoundTripsBitForBit) {
  std::mt19937_64 random(1);
  std::vector<TraceRow> rows;
  double t = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&] {  // any finite bit pattern, including denormals and -0
      for (;;)
        if (const double x = std::bit_cast<double>(random()); std::isfinite(x)) return x;
    };
    const double turn = 1e-3 * static_cast<double>(random() % 6283);
    t += 1e-3 / 3.0;
    rows.push_back({i % 2 ? DeviceRole::kInstrument : DeviceRole::kScope,
                    {t,
                     {any(), any(), i % 100 ? any() : -0.0},
                     glm::dquat(std::cos(turn), std::sin(turn), 0, -0.0),
                     static_cast<std::uint32_t>(random()),
                     true}});
  }
  test::TempFolder folder;
  WriteTrace(folder / "trace.csv", rows);
  const auto back = ReadTrace(folder / "trace.csv");
  ASSERT_EQ(back.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DeviceSample &a = rows[i].sample, &b = back[i].sample;
    EXPECT_EQ(rows[i].device, back[i].device);
    EXPECT_TRUE(SameBits(a.t, b.t));
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(SameBits(a.hip_in_device[k], b.hip_in_device[k]));
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(SameBits(a.handle_in_device[k], b.handle_in_device[k]));
    EXPECT_EQ(a.buttons, b.buttons);
  }
  EXPECT_EQ(TraceText(back), TraceText(rows));
}

TEST(Trace, RefusesWithTheLineAndTheReason) {
  const std::string good = "0,scope,0,0,0,1,0,0,0,0\n";
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"", {"line 1", "first line"}},
      {"t,device\n", {"line 1", "first line"}},
      {kHeader, {"no rows"}},
      {kHeader + good + "0,scope,0,0,0,1,0,0,0\n", {"line 3", "9 columns"}},
      {kHeader + good + "0,scope,0,0,0,1,0,0,0,0,\n", {"line 3", "11 columns"}},
      {kHeader + good + "\n" + good, {"line 3", "1 columns"}},
      {kHeader + "0,Scope,0,0,0,1,0,0,0,0\n", {"line 2", "\"Scope\"", "scope or instrument"}},
      {kHeader + "0,scope,nan,0,0,1,0,0,0,0\n", {"line 2", "hip_x", "finite"}},
      {kHeader + "0,scope,0,-inf,0,1,0,0,0,0\n", {"line 2", "hip_y", "finite"}},
      {kHeader + "inf,scope,0,0,0,1,0,0,0,0\n", {"line 2", "t is", "finite"}},
      {kHeader + "0,scope,0,0,1e999,1,0,0,0,0\n", {"line 2", "hip_z"}},
      {kHeader + "0,scope,0,0,0.1m,1,0,0,0,0\n", {"line 2", "\"0.1m\"", "not a number"}},
      {kHeader + "0,scope,0,,0,1,0,0,0,0\n", {"line 2", "hip_y", "not a number"}},
      {kHeader + "0,scope,0, 1,0,1,0,0,0,0\n", {"line 2", "not a number"}},
      {kHeader + "0,scope,0,0,0,0,0,0,0,0\n", {"line 2", "quaternion", "length 0"}},
      {kHeader + "0,scope,0,0,0,1,1,0,0,0\n", {"line 2", "quaternion"}},
      {kHeader + "0,scope,0,0,0,1,0,0,0,-1\n", {"line 2", "buttons"}},
      {kHeader + "0,scope,0,0,0,1,0,0,0,1.5\n", {"line 2", "buttons"}},
      {kHeader + "1,scope,0,0,0,1,0,0,0,0\n" + good, {"line 3", "backwards"}},
      {kHeader + good + "61,scope,0,0,0,1,0,0,0,0\n", {"line 3", "leaps", "60 s"}},
  };
  for (const auto& [text, parts] : cases) {
    const std::string said = Refusal(text);
    EXPECT_NE(said, "") << text;
    EXPECT_NE(said.find("trace.csv"), std::string::npos) << said;
    for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << said;
  }
}

// Any truncation of a valid file is read or refused with an error.
TEST(Trace, TruncatedTextIsReadOrRefused) {
  const std::string text =
      kHeader + "0,scope,0.125,0,0,1,0,0,0,0\n0.5,instrument,0,0,0,1,0,0,0,3\n";
  int refused = 0;
  for (std::size_t length = 0; length <= text.size(); ++length)
    refused += !Refusal(text.substr(0, length)).empty();
  EXPECT_GT(refused, 50);
  EXPECT_EQ(Refusal(text), "");
}

}  // namespace
}  // namespace arthro::simulation
