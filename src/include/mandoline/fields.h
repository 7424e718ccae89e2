// What the plain structs of results have, so that all that writes, reads, copies or describes them follows from one list.
//
// Such a struct has a static function fields(self, f), where self is one of it, const or not: it calls f(name, self.member) for each member
// in order. The arrays of a cut-mesh have an ArrayInfo in place of the name.
#pragma once

#include <type_traits>
#include <vector>

#include "mandoline/api.h"

namespace MANDOLINE_API mandoline {

/// An array that a struct may be without. Then it is empty; where there is a flag, that tells an empty array from none.
template <class Items, class Flag = const bool>
class Optional {
 public:
  explicit Optional(Items& items_, Flag* flag = nullptr) : items(items_), flag_(flag) {}
  bool isPresent() const { return flag_ ? *flag_ : !items.empty(); }
  /// For structs that are made.
  void setPresent(bool present) const {
    if constexpr (!std::is_const_v<Flag>)
      if (flag_) *flag_ = present;
  }

  Items& items;

 private:
  Flag* flag_;
};

namespace detail {
template <class Field>
inline constexpr bool isVector = false;
template <class Item>
inline constexpr bool isVector<std::vector<Item>> = true;
}  // namespace detail

/// The arrays among the fields of a struct, in order: f(name, vector).
template <class Struct, class F>
void forEachArray(Struct& object, const F& f) {
  Struct::fields(object, [&](auto name, auto&& field) {
    if constexpr (requires { field.isPresent(); }) {
      f(name, field.items);
    } else if constexpr (detail::isVector<std::remove_cvref_t<decltype(field)>>) {
      f(name, field);
    }
  });
}

}  // namespace mandoline
