// The first hour with a force device as a conversation on the terminal [safety.md, First hour], and
// its record, a page of text to print and sign.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulation/practice/first_hour/first_hour.h"

namespace arthro::app {

// The person at the device. An answer of "stop", or the end of the input, ends the conversation.
struct Person {
  std::function<void(const std::string& line)> tell;
  std::function<std::string(const std::string& question)> ask;
};

// How a live device is ticked; `is_held` of each trial comes from the person's choice.
struct HourTicks {
  std::function<double()> next;  // see TrialTicks
  std::function<bool()> stops;
};

struct HourRow {
  simulation::HourStep step = simulation::HourStep::kZero;
  simulation::HourVerdict verdict;
};

// Rows of the steps that were carried out, in their order. `device` has a force.
std::vector<HourRow> TakeFirstHour(simulation::Device& device, const HourTicks& ticks,
                                   const Person& person);

bool HasPassed(const std::vector<HourRow>& rows);  // all six

// `date`: as it shall stand on the page.
std::string RecordText(const std::vector<HourRow>& rows, const simulation::Device& device,
                       const std::string& date, const std::string& version);

}  // namespace arthro::app
