// A value whose type only some files know: a step's state, the practice that runs. Unlike
// std::unique_ptr it can be destroyed where T is only declared, and it is const where it is seen as
// const. Empty until emplace().
#pragma once

#include <memory>
#include <utility>

namespace arthro::app {

template <class T>
class Owned {
 public:
  Owned() = default;

  template <class... Arguments>
  T& emplace(Arguments&&... arguments) {
    object_ = {new T(std::forward<Arguments>(arguments)...), [](T* object) { delete object; }};
    return *object_;
  }
  void reset() { object_.reset(); }

  bool has_value() const { return object_ != nullptr; }
  explicit operator bool() const { return has_value(); }
  T* operator->() { return object_.get(); }
  const T* operator->() const { return object_.get(); }
  T& operator*() { return *object_; }
  const T& operator*() const { return *object_; }

 private:
  std::unique_ptr<T, void (*)(T*)> object_{nullptr, nullptr};
};

}  // namespace arthro::app
