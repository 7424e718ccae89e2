// A function that is called by reference, so that the code around the call exists once for all functions.
#pragma once

#include <type_traits>

namespace mandoline::detail {

template <class Signature>
class FunctionRef;

/// Refers to a function object, which must outlive it.
template <class Result, class... Args>
class FunctionRef<Result(Args...)> {
 public:
  template <class F, class = std::enable_if_t<!std::is_same_v<F, FunctionRef>>>
  FunctionRef(const F& f)
      : object_(&f), call_([](const void* object, Args... args) -> Result { return (*static_cast<const F*>(object))(args...); }) {}

  Result operator()(Args... args) const { return call_(object_, args...); }

 private:
  const void* object_;
  Result (*call_)(const void*, Args...);
};

}  // namespace mandoline::detail
