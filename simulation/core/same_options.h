// Whether two sets of options (options.h) say the same, field by field and bit by bit, so that what
// is no number equals itself. Cheap enough to be asked in every frame.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace arthro {

namespace internal {

struct OptionBits {
  std::array<std::uint64_t, 64> fields{};
  std::size_t count = 0;

  template <class T, class R>
  void operator()(const char*, const T& field, const R&, const char*, const char*) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "compare text by its own");
    if constexpr (std::is_same_v<T, double>)
      fields.at(count++) = std::bit_cast<std::uint64_t>(field);
    else
      fields.at(count++) = static_cast<std::uint64_t>(field);
  }
};

}  // namespace internal

template <class Options>
bool SameOptions(Options a, Options b) {
  internal::OptionBits of_a, of_b;
  a.Visit(of_a);
  b.Visit(of_b);
  return of_a.fields == of_b.fields;
}

}  // namespace arthro
