// All options of a practice session, in one list.
#pragma once

namespace arthro::simulation {

struct SessionOptions {
  template <class V>
  void Visit(V&&) {}
};

}  // namespace arthro::simulation
