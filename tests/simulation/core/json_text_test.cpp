#include "simulation/core/json_text.h"

#include <string>

#include <gtest/gtest.h>

namespace arthro {
namespace {

std::string Nested(int depth, const std::string& open, const std::string& close) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += open;
  text += "1";
  for (int i = 0; i < depth; ++i) text += close;
  return text;
}

std::string FaultOf(const std::string& text) {
  try {
    ParseJson(text, Code::kBadData, "f.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ParseJson, ReadsUpToItsDepthAndRefusesOneMore) {
  for (const auto& [open, close] : {std::pair{"[", "]"}, std::pair{"{\"a\":", "}"}}) {
    EXPECT_EQ(FaultOf(Nested(kDeepestJson, open, close)), "");
    EXPECT_NE(FaultOf(Nested(kDeepestJson + 1, open, close)).find("nested more than 64 deep"),
              std::string::npos);
  }
}

// Neither read, copied nor destroyed: each would recurse.
TEST(ParseJson, AMillionLevelsAreRefusedWithoutAStackOverflow) {
  for (const auto& [open, close] : {std::pair{"[", "]"}, std::pair{"{\"a\":", "}"}})
    for (const std::string& end : std::vector<std::string>{"", close}) {
      const std::string fault = FaultOf(Nested(1'000'000, open, end));
      EXPECT_NE(fault.find("f.json: this JSON is nested"), std::string::npos) << fault;
    }
  EXPECT_THROW(ParseOrderedJson(Nested(1'000'000, "[", "]"), Code::kBadData), Error);
}

TEST(ParseJson, TellsWhereItIsBroken) {
  EXPECT_NE(FaultOf("{\"a\": 1,\n  b}").find("line 2, column 3"), std::string::npos)
      << FaultOf("{\"a\": 1,\n  b}");
  EXPECT_NE(FaultOf("{\"a\": 1e999}").find("number 1e999 at line 1, column 7"), std::string::npos)
      << FaultOf("{\"a\": 1e999}");
  EXPECT_NE(FaultOf("{\"a\": 1, \"a\": 2}").find("key \"a\" comes twice"), std::string::npos);
  EXPECT_NE(FaultOf("").find("not JSON"), std::string::npos);
}

TEST(ParseOrderedJson, KeepsTheOrderOfTheText) {
  EXPECT_EQ(ParseOrderedJson("{\"b\": 1, \"a\": [2]}", Code::kBadData).dump(),
            "{\"b\":1,\"a\":[2]}");
}

TEST(LineOfKey, FollowsMembersAndElements) {
  const std::string text =
      "{\n"
      "  \"a.b\": \"{[\\\"\", \"a\": [1, {\"b\": 2},\n"
      "    {\"b\": [3,\n"
      "      4], \"c\":\n 5}],\n"
      "  \"d\": {}\n}";
  EXPECT_EQ(LineOfKey(text, ""), 1);
  EXPECT_EQ(LineOfKey(text, "a"), 2);
  EXPECT_EQ(LineOfKey(text, "a[1].b"), 2);
  EXPECT_EQ(LineOfKey(text, "a[2]"), 3);
  EXPECT_EQ(LineOfKey(text, "a[2].b[1]"), 4);
  EXPECT_EQ(LineOfKey(text, "a[2].c"), 4);
  EXPECT_EQ(LineOfKey(text, "d"), 6);
}

TEST(LineOfKey, OfAMissingKeyIsThatOfItsOwner) {
  const std::string text = "{\n\"a\": {\n\"b\": 1},\n\"c\": [2]}";
  EXPECT_EQ(LineOfKey(text, "a.x"), 2);
  EXPECT_EQ(LineOfKey(text, "a.b.x"), 3);
  EXPECT_EQ(LineOfKey(text, "c[7].x"), 4);
  EXPECT_EQ(LineOfKey(text, "x.y"), 1);
  EXPECT_EQ(LineOfKey(text, "c[x"), 4);
}

}  // namespace
}  // namespace arthro
