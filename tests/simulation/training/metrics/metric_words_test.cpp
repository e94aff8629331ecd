// Metrics as an educator reads them: names, units and rounded numbers.
#include "simulation/training/metrics/metric_words.h"

#include <cctype>
#include <set>

#include <gtest/gtest.h>

#include "simulation/training/metrics/metrics.h"

namespace arthro::simulation {
namespace {

TEST(MetricWords, EachMetricHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const Metric& metric : EveryMetric()) {
    const std::string name = MetricWords(std::string(metric.id), "both");
    EXPECT_EQ(name.find('_'), std::string::npos) << name;
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(name.at(0)))) << name;
    EXPECT_TRUE(names.insert(name).second) << name;
  }
  EXPECT_EQ(MetricWords("peak_force", "instrument"), "Peak force (instrument)");
  EXPECT_EQ(MetricWords("of_another_program", ""), "of another program");
}

TEST(MetricWords, ValuesHaveThreeDigitsAndTheUnitOfAReader) {
  EXPECT_EQ(ValueWords(0.2518, "m"), "252 mm");
  EXPECT_EQ(ValueWords(9.3061, "N"), "9.31 N");
  EXPECT_EQ(ValueWords(3.14159265, "rad"), "180 °");
  EXPECT_EQ(ValueWords(1e-5, "m2"), "10 mm²");
  EXPECT_EQ(ValueWords(23.7, "1/min"), "23.7 per min");
  EXPECT_EQ(ValueWords(999.7, "s"), "1000 s");
  EXPECT_EQ(ValueWords(12345.6, "s"), "12346 s");
  EXPECT_EQ(ValueWords(6.852e-17, "m"), "0 mm");
  EXPECT_EQ(ValueWords({}, "m"), "not measured");
}

TEST(MetricWords, ARoundedValueStaysOnItsSideOfTheLimit) {
  EXPECT_EQ(ValueWords(8.5004, "N", {{}, 8.5}), "8.5004 N");
  EXPECT_EQ(ValueWords(8.4999, "N", {{}, 8.5}), "8.5 N") << "it is kept, and seems so";
  EXPECT_EQ(ValueWords(0.8996, "", {0.9, {}}), "0.8996");
  EXPECT_EQ(ValueWords(120.04, "s", {{}, 120.0}), "120.04 s");
}

TEST(MetricWords, LimitsAreAsTheyWereWritten) {
  EXPECT_EQ(LimitWords({0.5, 3.0}, "N"), "between 0.5 and 3 N");
  EXPECT_EQ(LimitWords({{}, 0.01101}, "m"), "at most 11.01 mm");
  EXPECT_EQ(LimitWords({0.9, {}}, ""), "at least 0.9");
  EXPECT_EQ(LimitWords({}, "N"), "");
}

}  // namespace
}  // namespace arthro::simulation
