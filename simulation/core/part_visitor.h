// Options inside options: a visitor (options.h) that gives the fields of one part of a struct as
// `part_field`, so that two parts may use one word: other.Visit(PartVisitor<V>{v, "other_"}).
#pragma once

#include <string>

namespace arthro {

template <class V>
struct PartVisitor {
  V& visitor;
  const char* prefix;

  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char* help) {
    visitor((std::string(prefix) + name).c_str(), field, range, unit, help);
  }
};

}  // namespace arthro
