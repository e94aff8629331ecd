#include "simulation/device/hid/hid_node.h"

#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "tests/support/build_paths.h"

namespace arthro::simulation {
namespace {

using enum DeviceFamily;

HidNode Node(std::uint16_t vendor, std::uint16_t product, std::uint16_t page, std::uint16_t usage,
             int interface_number = 0, std::string product_name = "") {
  HidNode node;
  node.vendor = vendor, node.product = product, node.usage_page = page, node.usage = usage;
  node.interface_number = interface_number;
  node.product_name = std::move(product_name);
  return node;
}

TEST(HidNode, IdentifiesFamiliesByNumbersAndUsage) {
  EXPECT_EQ(FamilyOf(Node(0x1234, 0x0006, 0xff00, 1)), kWoodenHaptics);
  EXPECT_EQ(FamilyOf(Node(0x16c0, 0x0486, 0xffab, 0x200, 0, "Polhem v1")), kWoodenHaptics);
  EXPECT_EQ(FamilyOf(Node(0x256f, 0xc635, 1, 8)), kSpaceMouse);
  EXPECT_EQ(FamilyOf(Node(0x046d, 0xc626, 1, 8)), kSpaceMouse);
  EXPECT_EQ(FamilyOf(Node(0x1532, 0x0300, 0, 0, 0)), kHydra);
  EXPECT_EQ(FamilyOf(Node(0x054c, 0x0ce6, 1, 5, 3)), kDualSense);
  EXPECT_EQ(FamilyOf(Node(0x054c, 0x09cc, 1, 5, 3)), kDualShock4);
}

TEST(HidNode, IgnoresMiceKeyboardsAndForeignBoards) {
  EXPECT_FALSE(FamilyOf(Node(0x256f, 0xc650, 1, 2))) << "CadMouse";
  EXPECT_FALSE(FamilyOf(Node(0x046d, 0xc626, 1, 6))) << "a keyboard part";
  EXPECT_FALSE(FamilyOf(Node(0x256f, 0xc635, 1, 2))) << "a mouse part";
  EXPECT_FALSE(FamilyOf(Node(0x16c0, 0x0486, 0xffab, 0x200, 0, "somebody's RawHID board")));
  EXPECT_FALSE(FamilyOf(Node(0x16c0, 0x0486, 1, 6, 0, "Polhem v1"))) << "its keyboard part";
  EXPECT_FALSE(FamilyOf(Node(0x1532, 0x0300, 0, 0, 1))) << "the second interface";
  EXPECT_FALSE(FamilyOf(Node(0x054c, 0x0ce6, 0xff00, 1)));
  EXPECT_FALSE(FamilyOf(Node(0, 0, 0, 0)));
}

TEST(HidNode, ListsADeviceOnceInAFixedOrder) {
  HidNode mouse = Node(0x256f, 0xc635, 1, 8);
  mouse.path = "/dev/hidraw3", mouse.serial = "B";
  HidNode other = mouse, again = mouse, wooden = Node(0x1234, 6, 0xff00, 1);
  other.path = "/dev/hidraw1", other.serial = "A", wooden.path = "/dev/hidraw9";
  const std::vector<HidNode> one{mouse, other, again, wooden}, two{wooden, again, other};
  for (const auto& nodes : {one, two}) {
    const auto known = KnownAmong(nodes);
    ASSERT_EQ(known.size(), 3u);
    EXPECT_EQ(known[0].family, kWoodenHaptics);
    EXPECT_EQ(known[1].node.serial, "A");
    EXPECT_EQ(known[2].node.serial, "B");
  }
}

TEST(HidNode, FamiliesRoundTripThroughText) {
  std::set<std::string> names;
  for (const DeviceFamily family : AllFamilies()) {
    EXPECT_EQ(DeviceFamilyFromString(ToString(family)), family);
    names.insert(Name(family));
  }
  EXPECT_EQ(names.size(), AllFamilies().size());
  EXPECT_FALSE(DeviceFamilyFromString("touch"));
}

TEST(UdevRule, NamesExactlyTheKnownDevices) {
  const std::string rule =
      ReadWholeFile(std::string(ARTHRO_SOURCE_DIR) + "/packaging/70-arthroscene.rules");
  std::size_t count = 0;
  for (std::size_t at = 0; (at = rule.find("KERNELS==", at)) != std::string::npos; ++at) ++count;
  EXPECT_EQ(count, KnownNumbers().size());
  for (const HidNumber& known : KnownNumbers())
    EXPECT_NE(rule.find(fmt::format("KERNELS==\"*:{:04X}:{:04X}.*\", TAG+=\"uaccess\"",
                                    known.vendor, known.product)),
              std::string::npos)
        << std::hex << known.vendor << ":" << known.product;
}

}  // namespace
}  // namespace arthro::simulation
