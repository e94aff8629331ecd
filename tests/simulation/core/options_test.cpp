#include "simulation/core/options.h"

#include <limits>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/options_json.h"
#include "simulation/core/part_visitor.h"
#include "simulation/core/same_options.h"

namespace arthro {
namespace {

enum class Law { kLinear, kInverseSquare };

struct SampleOptions {
  double depth = 0.02;
  double angle = RadiansFromDegrees(30.0);
  int passes = 3;
  bool mask = true;
  Law law = Law::kLinear;
  template <class V>
  void Visit(V&& v) {
    v("depth", depth, Range{0.001, 0.1}, "m", "How deep.");
    v("angle", angle, Range{0.0, RadiansFromDegrees(90.0)}, "rad", "How far round.");
    v("passes", passes, Range{1, 9}, "", "How often.");
    v("mask", mask, Any{}, "", "Whether to mask.");
    v("law", law, Choices<Law>{{{Law::kLinear, "linear"}, {Law::kInverseSquare, "inverse-square"}}},
      "", "Which law.");
  }
};

std::string FaultOf(const char* json) {
  try {
    OptionsFromJson<SampleOptions>(nlohmann::json::parse(json), "o.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Options, SurviveJson) {
  SampleOptions options;
  options.angle = RadiansFromDegrees(70.0);
  options.law = Law::kInverseSquare;
  const nlohmann::json json = JsonFromOptions(options);
  EXPECT_DOUBLE_EQ(json.at("angle_deg").get<double>(), 70.0);
  EXPECT_EQ(json.at("law"), "inverse-square");
  const auto back = OptionsFromJson<SampleOptions>(json);
  EXPECT_DOUBLE_EQ(back.angle, options.angle);
  EXPECT_EQ(back.law, options.law);
}

struct NestedOptions {
  int passes = 5;
  SampleOptions near, far;
  template <class V>
  void Visit(V&& v) {
    v("passes", passes, Range{1, 9}, "", "How often in all.");
    near.Visit(PartVisitor<V>{v, "near_"});
    far.Visit(PartVisitor<V>{v, "far_"});
  }
};

TEST(Options, PartsMayUseOneWord) {
  NestedOptions options;
  options.near.passes = 2;
  options.far.passes = 7;
  options.far.angle = RadiansFromDegrees(10.0);
  const nlohmann::json json = JsonFromOptions(options);
  EXPECT_EQ(json.size(), 11u);
  EXPECT_NEAR(json.at("far_angle_deg").get<double>(), 10.0, 1e-9);
  const auto back = OptionsFromJson<NestedOptions>(json);
  EXPECT_EQ(back.passes, 5);
  EXPECT_EQ(back.near.passes, 2);
  EXPECT_EQ(back.far.passes, 7);
  options.far.passes = 12;
  EXPECT_THROW(CheckOptions(options), Error);
}

TEST(Options, AreTheSameWhereEveryFieldIs) {
  SampleOptions a, b;
  EXPECT_TRUE(SameOptions(a, b));
  const auto differ = [&](auto change) {
    b = a;
    change();
    EXPECT_FALSE(SameOptions(a, b));
    EXPECT_FALSE(SameOptions(b, a));
  };
  differ([&] { b.depth += 1e-12; });
  differ([&] { b.passes = -3; });
  differ([&] { b.mask = false; });
  differ([&] { b.law = Law::kInverseSquare; });
  differ([&] { b.angle = std::numeric_limits<double>::quiet_NaN(); });
  a = b;
  EXPECT_TRUE(SameOptions(a, b)) << "what is no number too";
}

TEST(Options, RefuseWithKeyAndRemedy) {
  EXPECT_NE(FaultOf(R"({"passes": 12})").find("between 1 and 9"), std::string::npos);
  EXPECT_NE(FaultOf(R"({"law": "cubic"})").find("linear, inverse-square"), std::string::npos);
  EXPECT_NE(FaultOf(R"({"angle": 1})").find("\"angle\" is not known"), std::string::npos);
  EXPECT_NE(FaultOf(R"({"passes": 2.5})").find("a whole number"), std::string::npos);
  EXPECT_NE(FaultOf(R"({"mask": 1})").find("true or false"), std::string::npos);
  EXPECT_NE(FaultOf(R"({"depth": null})").find("o.json"), std::string::npos);
}

struct SeededOptions {
  int seed = 0;
  template <class V>
  void Visit(V&& v) {
    v("seed", seed, Any{}, "", "Start of the random sequence.");
  }
};

TEST(Options, RefuseAWholeNumberThatNoIntHolds) {
  SeededOptions options;
  ReadOptionsText(R"({"seed": -2147483648})", {}, options);
  EXPECT_EQ(options.seed, std::numeric_limits<int>::min());
  for (const char* text : {R"({"seed": 2147483648})", R"({"seed": 18446744073709551615})"})
    EXPECT_THROW(ReadOptionsText(text, {}, options), Error) << text;
  EXPECT_EQ(OptionsText(options), R"({"seed":-2147483648})");
}

TEST(Options, CheckNamesTheFieldAsAPersonSeesIt) {
  SampleOptions options;
  options.depth = 0.5;
  try {
    CheckOptions(options);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("depth_mm is 500"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace arthro
