// Calls of hidapi, tested with a scripted library.
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "simulation/device/hid/hid_link.h"
#include "tests/support/fake_hidapi.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

using test::Bytes;
using test::FakeHid;
using test::FakeUsb;

std::unique_ptr<HidLink> OpenFirst(HidBus& bus) {
  OpenFault fault;
  const auto nodes = bus.List();
  return nodes.empty() ? nullptr : bus.Open(nodes.front(), fault);
}

TEST(HidapiLink, ListsPluggedInDevices) {
  FakeUsb usb;
  usb.Plug({0x256f, 0xc635, 1, 8, 2, true, L"Sé\u20ac\U0001F600\xd800\n7", L"Space", "/dev/fake7"});
  const auto nodes = MachineHidBus()->List();
  ASSERT_EQ(nodes.size(), 1u);
  EXPECT_EQ(nodes[0].vendor, 0x256f);
  EXPECT_EQ(nodes[0].product, 0xc635);
  EXPECT_EQ(nodes[0].usage_page, 1);
  EXPECT_EQ(nodes[0].usage, 8);
  EXPECT_EQ(nodes[0].interface_number, 2);
  EXPECT_TRUE(nodes[0].is_bluetooth);
  EXPECT_EQ(nodes[0].serial, "Sé€😀?7") << "what is no letter is asked about, control characters go";
  EXPECT_EQ(nodes[0].product_name, "Space");
  EXPECT_EQ(nodes[0].path, "/dev/fake7");
}

TEST(HidapiLink, ReadsWritesAndCloses) {
  FakeUsb usb;
  usb.Plug({});
  const auto bus = MachineHidBus();
  auto link = OpenFirst(*bus);
  ASSERT_TRUE(link);
  std::array<std::uint8_t, kReportRoom> report{};
  EXPECT_EQ(link->Read(report, 0), 0) << "nothing there";
  usb.Send("/dev/fake0", {1, 2, 3});
  EXPECT_EQ(link->Read(report, 0), 3);
  EXPECT_EQ(report[2], 3);
  EXPECT_EQ(link->Write(Bytes{0, 9}), 2);
  EXPECT_EQ(link->SendFeature(Bytes{0, 8, 7}), 3);
  EXPECT_EQ(usb.Written("/dev/fake0"), (std::vector<Bytes>{{0, 9}}));
  EXPECT_EQ(usb.Features("/dev/fake0"), (std::vector<Bytes>{{0, 8, 7}}));
  EXPECT_EQ(link->GetFeature(report), kLinkIsDead);
  EXPECT_EQ(usb.opened("/dev/fake0"), 1);
  link.reset();
  EXPECT_EQ(usb.opened("/dev/fake0"), 0);
  EXPECT_EQ(usb.misuses(), 0);
}

TEST(HidapiLink, EveryErrorIsADeadLink) {
  FakeUsb usb;
  usb.Plug({});
  const auto bus = MachineHidBus();
  const auto link = OpenFirst(*bus);
  std::array<std::uint8_t, kReportRoom> report{};
  for (const int result : {-1, -7}) {
    usb.SetReadResult("/dev/fake0", result);
    usb.SetWriteResult("/dev/fake0", result);
    EXPECT_EQ(link->Read(report, 0), kLinkIsDead);
    EXPECT_EQ(link->Write(Bytes{0}), kLinkIsDead);
  }
  usb.SetReadResult("/dev/fake0", 1);
  usb.SetWriteResult("/dev/fake0", 0);
  usb.Unplug("/dev/fake0");
  EXPECT_EQ(link->Read(report, 20), kLinkIsDead);
  EXPECT_EQ(link->Write(Bytes{0}), kLinkIsDead);
  EXPECT_EQ(link->SendFeature(Bytes{0}), kLinkIsDead);
  usb.Plug({});
  EXPECT_EQ(link->Read(report, 0), kLinkIsDead) << "plugged in again it is another link";
}

TEST(HidapiLink, DistinguishesAbsentFromRefused) {
  FakeUsb usb;
  const auto bus = MachineHidBus();
  OpenFault fault = OpenFault::kNone;
  HidNode node;
  node.path = "/dev/not_there";
  EXPECT_FALSE(bus->Open(node, fault));
  EXPECT_EQ(fault, OpenFault::kGone);
  test::TempFolder folder;
  node.path = (folder / "node").string();
  std::ofstream(node.path) << "x";
  EXPECT_FALSE(bus->Open(node, fault));
  EXPECT_EQ(fault, OpenFault::kRefused) << "it may be opened, and is not";
}

TEST(HidapiLinkDeathTest, DistinguishesAMissingPermissionFromAnAbsentDevice) {
  FakeUsb usb;
  const auto bus = MachineHidBus();
  const auto node_path = std::filesystem::temp_directory_path() / "arthroscene_hidapi_link_node";
  std::ofstream(node_path) << "x";
  std::filesystem::permissions(node_path, std::filesystem::perms::none);
  EXPECT_EXIT(
      {
        // The superuser may open everything, so this runs as user nobody.
        if (getuid() == 0 && setresuid(65534, 65534, 65534) != 0) _exit(3);
        HidNode node;
        node.path = node_path.string();
        OpenFault fault = OpenFault::kNone;
        _exit(!bus->Open(node, fault) && fault == OpenFault::kNoPermission ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
  std::filesystem::remove(node_path);
}

TEST(HidapiLink, OneThreadReadsWhileAnotherWrites) {
  FakeUsb usb;
  usb.Plug({});
  const auto bus = MachineHidBus();
  auto link = OpenFirst(*bus);
  std::atomic<int> read = 0;
  std::atomic<bool> is_over = false;
  std::thread reader([&] {
    std::array<std::uint8_t, kReportRoom> report{};
    while (!is_over) read += link->Read(report, 20) > 0;
  });
  usb.OnWrite("/dev/fake0", [&](const Bytes& report) { usb.Send("/dev/fake0", report); });
  int written = 0;
  for (int i = 0; i < 50; ++i) written += link->Write(Bytes{0, 1}) == 2;
  for (int i = 0; i < 300000 && read < 50; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  is_over = true;
  reader.join();
  link.reset();
  EXPECT_EQ(written, 50);
  EXPECT_EQ(read, 50);
  EXPECT_EQ(usb.misuses(), 0);
}

}  // namespace
}  // namespace arthro::simulation
