// A number as a uniform of a shader takes it.
#pragma once

namespace arthro::app {

constexpr float Float(double value) { return static_cast<float>(value); }

}  // namespace arthro::app
