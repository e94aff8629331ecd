// Labels of options: plain words, and none for an option that is no longer there.
#include "app/panels/option_words.h"

#include <algorithm>
#include <set>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "app/state/settings/window_settings.h"
#include "authoring/depth/depth_options.h"
#include "authoring/panorama/clip/panorama_options.h"
#include "simulation/practice/session_options.h"

namespace arthro::app {
namespace {

struct Names {
  std::set<std::string> fields;
  std::set<std::pair<std::string, std::string>> choices;
  template <class T, class R>
  void operator()(const char* name, T&, const R& range, const char*, const char*) {
    fields.insert(name);
    if constexpr (std::is_enum_v<T>)
      for (const auto& [value, word] : range.words) choices.emplace(name, word);
  }
};

// Names of every options struct that a page shows as a whole.
Names ShownNames() {
  Names names;
  authoring::DepthOptions().Visit(names);
  authoring::PanoramaOptions().Visit(names);
  simulation::SessionOptions().Visit(names);
  WindowSettings().Visit(names);
  return names;
}

TEST(OptionWords, EveryLabelIsThatOfAnOption) {
  const Names names = ShownNames();
  ASSERT_GT(names.fields.size(), 100u);
  for (const std::string_view field : LabelledFields())
    EXPECT_TRUE(names.fields.contains(std::string(field))) << field;
  for (const auto& [field, word] : LabelledChoices())
    EXPECT_TRUE(names.choices.contains({std::string(field), std::string(word)}))
        << field << " " << word;
}

TEST(OptionWords, NoLabelIsThatOfTwoOptions) {
  std::set<std::string> labels;
  for (const std::string& field : ShownNames().fields)
    EXPECT_TRUE(labels.insert(LabelOfField(field)).second) << field;
}

// One word, an abbreviation or a name of a stage tells nobody what an option does.
TEST(OptionWords, OptionsAndChoicesHavePlainNames) {
  EXPECT_EQ(LabelOfField("every"), "Use every n-th frame");
  EXPECT_EQ(LabelOfField("near_relief"), "Near relief");
  EXPECT_EQ(LabelOfChoice("detector", "surf"), "SURF");
  EXPECT_EQ(LabelOfChoice("estimator", "shading"), "shading");
  const Names names = ShownNames();
  for (const std::string& field : names.fields) {
    const std::string label = LabelOfField(field);
    for (const char* word : {" px", "Max ", "Least piece", "Law", "Ratio", "Quantised", "Direct ",
                             "Graph ", "Refine ", "Compose ", "Prepare ", "Rectify ", "Cycles "})
      EXPECT_EQ((label + " ").find(word), std::string::npos) << field << ": " << label;
  }
  for (const auto& [field, word] : names.choices) {
    const std::string label = LabelOfChoice(field, word);
    EXPECT_EQ(label.find('_'), std::string::npos) << field << ": " << label;
    for (const char* jargon : {"paper", "direct", "surf", "auto"})
      EXPECT_NE(label, jargon) << field;
  }
}

}  // namespace
}  // namespace arthro::app
