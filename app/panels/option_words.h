// Labels of options and of their choices, where the name in the declaration is no plain English.
// The one table of the window: files and the command line keep the names of the declarations.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace arthro::app {

// "near_relief" as a person reads it: "Near relief".
std::string WordsOfField(std::string_view name);
// Label of a field by its name in Visit; its words where the table has none.
std::string LabelOfField(std::string_view name);
// Label of a choice of that field; the word of the declaration where the table has none.
std::string LabelOfChoice(std::string_view field, std::string_view word);

// Names of the table, which must be names of declarations: fields, and fields with their choices.
std::vector<std::string_view> LabelledFields();
std::vector<std::pair<std::string_view, std::string_view>> LabelledChoices();

}  // namespace arthro::app
