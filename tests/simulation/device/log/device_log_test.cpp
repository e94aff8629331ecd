#include "simulation/device/log/device_log.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_format.h"
#include "simulation/device/log/logged_device.h"
#include "simulation/device/plant_device.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

const std::vector<LogSource> kPlant = {{"", "", "1", {DeviceRole::kScope, std::nullopt}}};

std::unique_ptr<PlantDevice> Plant() {
  return std::make_unique<PlantDevice>(PlantOptions{}, HandModel{}, glm::dvec3(0.01, 0.02, 0.03));
}

TEST(DeviceLog, ReadsBackEachTick) {
  test::TempFolder folder;
  const auto plain = Plant();
  std::vector<DeviceSample> samples;
  {
    DeviceLog log(folder / "a.log", kPlant);
    LoggedDevice device(Plant(), log, 0);
    EXPECT_EQ(device.name(), plain->name());
    EXPECT_EQ(device.serial(), plain->serial());
    EXPECT_EQ(device.caps().peak_force, plain->caps().peak_force);
    for (int i = 1; i <= 1000; ++i) {
      const double now = 1e-3 * i;
      const glm::dvec3 force(0, 0, 1e-3 * (i % 300));
      const DeviceSample sample = device.Read(now), expected = plain->Read(now);
      EXPECT_EQ(sample.hip_in_device, expected.hip_in_device) << "a log changes nothing";
      device.HoldDeadMan(i > 100);
      plain->HoldDeadMan(i > 100);
      device.Command(force);
      plain->Command(force);
      EXPECT_EQ(device.status(), plain->status());
      samples.push_back(sample);
    }
    log.Close();
    EXPECT_EQ(log.dropped(), 0);
  }
  const DeviceLogContent log = ReadDeviceLog(folder / "a.log");
  EXPECT_EQ(log.sources, kPlant);
  EXPECT_EQ(log.missing, 0);
  EXPECT_TRUE(log.torn.empty());
  ASSERT_EQ(log.records.size(), samples.size());
  bool was_armed = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const LogRecord& record = log.records[i];
    ASSERT_EQ(record.number, i);
    EXPECT_EQ(record.t_ns, static_cast<std::int64_t>(1'000'000 * (i + 1)));
    EXPECT_EQ(record.sample.t, samples[i].t);
    EXPECT_EQ(record.sample.hip_in_device, samples[i].hip_in_device);
    EXPECT_EQ(record.sample.valid, samples[i].valid);
    EXPECT_EQ(record.command.z, 1e-3 * static_cast<double>((i + 1) % 300));
    EXPECT_EQ(record.is_dead_man_held, i + 1 > 100);
    was_armed = was_armed || record.status.state == DeviceState::kArmed;
  }
  EXPECT_TRUE(was_armed);
}

TEST(DeviceLog, PushNeitherAllocatesNorWaitsAndCountsDroppedRecords) {
  test::TempFolder folder;
  constexpr int kTicks = 1000;
  DeviceLogOptions options;
  options.ring = 64;
  options.write_every = 3600;  // the thread of the log does not write
  {
    DeviceLog log(folder / "a.log", kPlant, options);
    LoggedDevice device(Plant(), log, 0);
    const long before = test::Allocations();
    for (int i = 1; i <= kTicks; ++i) {
      device.Read(1e-3 * i);
      device.Command(glm::dvec3(0.0));
    }
    EXPECT_EQ(test::Allocations(), before);
    EXPECT_EQ(log.dropped(), kTicks - 64);
    log.Close();
  }
  DeviceLogContent log = ReadDeviceLog(folder / "a.log");
  EXPECT_EQ(log.records.size(), 64u);
  EXPECT_EQ(log.missing, kTicks - 64) << "those after the last that was kept, too";
}

TEST(DeviceLog, DropsNothingAtAModerateRate) {
  test::TempFolder folder;
  DeviceLogOptions options;
  options.ring = 256;
  options.write_every = 0.001;
  DeviceLog log(folder / "a.log", kPlant, options);
  LogChannel& channel = log.AddChannel();
  LogRecord record;
  for (int i = 0; i < 20000; ++i) {
    record.t_ns = i;
    channel.Push(record);
    if (i % 128 == 127) {
      // Gives the log time to write.
      const auto size = std::filesystem::file_size(folder / "a.log");
      for (int j = 0; j < 300000 && std::filesystem::file_size(folder / "a.log") == size; ++j)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  EXPECT_EQ(log.dropped(), 0);
  const DeviceLogContent unfinished = ReadDeviceLog(folder / "a.log");
  EXPECT_GT(unfinished.records.size(), 19000u) << "a program that dies loses little";
  EXPECT_NE(unfinished.torn.find("has no end"), std::string::npos) << unfinished.torn;
  log.Close();
  const DeviceLogContent whole = ReadDeviceLog(folder / "a.log");
  ASSERT_EQ(whole.records.size(), 20000u);
  for (std::size_t i = 0; i < whole.records.size(); ++i) ASSERT_EQ(whole.records[i].number, i);
  EXPECT_EQ(whole.torn, "");
}

// Message: one sentence with the cause, the file and what to do.
void ExpectRefused(const std::filesystem::path& file, const std::string& why) {
  try {
    DeviceLog log(file, kPlant);
    ADD_FAILURE() << "it was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kFile);
    EXPECT_EQ(error.file(), file);
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(DeviceLog, RefusesAFullDisk) {
  ExpectRefused("/dev/full", "the disk is full; free some space");
}

TEST(DeviceLog, KeepsAFileWithContent) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.log", "a scene");
  ExpectRefused(folder / "a.log", "exists");
  EXPECT_EQ(ReadWholeFile(folder / "a.log"), "a scene");
  std::filesystem::resize_file(folder / "a.log", 0);
  { DeviceLog log(folder / "a.log", kPlant); }
  EXPECT_EQ(ReadDeviceLog(folder / "a.log").torn, "");
}

TEST(DeviceLog, ReportsAFileSizeLimit) {
  test::TempFolder folder;
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  DeviceLog log(folder / "a.log", kPlant);
  LogChannel& channel = log.AddChannel();
  for (int i = 0; i < 1000; ++i) channel.Push({});
  const rlimit small{1024, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(log.Close(), Error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  EXPECT_FALSE(ReadDeviceLog(folder / "a.log").torn.empty());
}

TEST(DeviceLog, IsReadableByItsOwnerOnly) {
  test::TempFolder folder;
  const mode_t before = ::umask(0);
  { DeviceLog log(folder / "a.log", kPlant); }
  ::umask(before);
  struct stat found {};
  ASSERT_EQ(::stat((folder / "a.log").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777, 0600u);
}

TEST(DeviceLog, RefusesAMissingFolder) {
  test::TempFolder folder;
  ExpectRefused(folder / "no/a.log", "No such file or directory");
}

}  // namespace
}  // namespace arthro::simulation
