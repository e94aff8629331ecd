#include "simulation/practice/replay/option_numbers.h"

#include <algorithm>
#include <string_view>
#include <type_traits>

namespace arthro::simulation {
namespace {

struct NumberLister {
  OptionNumbers& numbers;
  template <class T, class Rule>
  void operator()(std::string_view name, T& field, const Rule&, const char*, const char*) {
    static_assert(std::is_arithmetic_v<T>, "an option of a session is a number");
    if (numbers.count == OptionNumbers::kMost) return;
    LoggedOption& option = numbers.option[static_cast<std::size_t>(numbers.count++)];
    std::copy_n(name.begin(), std::min(name.size(), option.name.size() - 1), option.name.begin());
    option.value = static_cast<double>(field);
  }
};

struct NumberSetter {
  const LoggedOption& option;
  bool is_found = false;
  template <class T, class Rule>
  void operator()(std::string_view name, T& field, const Rule&, const char*, const char*) {
    if (name != option.name.data()) return;
    field = static_cast<T>(option.value);
    is_found = true;
  }
};

}  // namespace

OptionNumbers NumbersOf(SessionOptions options) noexcept {
  OptionNumbers numbers;
  options.Visit(NumberLister{numbers});
  return numbers;
}

bool SetOption(const LoggedOption& option, SessionOptions& options) noexcept {
  NumberSetter setter{option};
  options.Visit(setter);
  return setter.is_found;
}

}  // namespace arthro::simulation
