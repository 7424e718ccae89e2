// Structs of the library as plain data, and plain data as structs, by their fields().
#pragma once

#include <functional>

#include "mandoline/cut_mesh.h"
#include "mandoline/fields.h"
#include "values.h"

namespace mandoline::wasm {

/// The JavaScript callback, if there is one.
std::function<bool(const Progress&)> progressOf(const val& options);
/// The same that tells the progress of some stages of the call, which others come before and after.
std::function<bool(const Progress&)> progressBetween(const val& options, size_t before, int after);
RunOptions runOptions(const val& options);

/// `copy`: as in toArray().
template <class Struct>
val toObject(const Struct& value, const val& copy);
template <class Struct>
val toObject(const Struct& value);
template <>
val toObject(const Grid& grid);
/// Its text.
template <>
val toObject(const Fingerprint& fingerprint);

/// Sets what there is; members that can't be read back, words and lists of structs, are left as they are.
template <class Struct>
void read(const val& object, Struct& value);
template <>
void read(const val& object, Grid& grid);
template <>
void read(const val& text, Fingerprint& fingerprint);

template <class Struct>
Struct fromObject(const val& object) {
  Struct result;
  read(object, result);
  return result;
}

/// What a member is called.
struct MemberName {
  MemberName(const char* name) : text(name) {}
  MemberName(const ArrayInfo& info) : text(info.name) {}

  const char* text;
};

/// What is visited becomes a member of an object. The functions that do it are few, and no templates, for the module's size.
class ObjectWriter {
 public:
  explicit ObjectWriter(val& object, const val& copy) : object_(object), copy_(copy) {}

  template <class Field>
  void operator()(MemberName member, const Field& field) const {
    const char* key = member.text;
    if constexpr (requires { field.isPresent(); }) {
      field.isPresent() ? (*this)(member, field.items) : set(key, val::null());
    } else if constexpr (detail::isVector<Field>) {
      setItems(key, field);
    } else if constexpr (std::is_same_v<Field, bool>) {
      set(key, val(field));
    } else if constexpr (std::is_arithmetic_v<Field>) {
      setNumber(key, double(field));
    } else if constexpr (std::is_enum_v<Field>) {
      setText(key, name(field));
    } else if constexpr (std::is_convertible_v<Field, std::string>) {
      setText(key, field);
    } else if constexpr (requires { std::tuple_size<Field>::value; }) {
      set(key, toTriple(field));
    } else if constexpr (requires { Field::fields(field, *this); }) {
      set(key, toObject(field, copy_));
    } else {
      set(key, toObject(field));
    }
  }

 private:
  template <class Item>
  void setItems(const char* key, const std::vector<Item>& items) const {
    if constexpr (std::is_same_v<Item, int64_t>) {
      setItems(key, std::vector<double>(items.begin(), items.end()));
    } else if constexpr (std::is_arithmetic_v<Item> || std::is_enum_v<Item>) {
      setArray(key, arrayType<Item>(), items.data(), items.size());
    } else {
      val list = val::array();
      for (const Item& item : items) {
        if constexpr (std::is_convertible_v<Item, std::string>)
          list.call<void>("push", item);
        else
          list.call<void>("push", toObject(item));
      }
      set(key, list);
    }
  }

  void set(const char* key, const val& value) const;
  void setNumber(const char* key, double value) const;
  void setText(const char* key, const std::string& value) const;
  void setArray(const char* key, const char* type, const void* numbers, size_t count) const;

  val& object_;
  const val& copy_;
};

/// What is visited is taken from a member of an object.
class ObjectReader {
 public:
  explicit ObjectReader(const val& object) : object_(object) {}

  template <class Field>
  void operator()(MemberName name, Field&& field) const {
    using Value = std::remove_cvref_t<Field>;
    const val member = object_[name.text];
    if constexpr (requires { field.isPresent(); }) {
      field.setPresent(isThere(member));
      if (isThere(member)) readArray(member, field.items);
    } else if (isThere(member)) {
      if constexpr (detail::isVector<Value>)
        readItems(member, field);
      else if constexpr (std::is_arithmetic_v<Value>)
        field = Value(member.as<double>());
      else if constexpr (requires { std::tuple_size<Value>::value; })
        field = readTriple<typename Value::value_type>(member);
      else if constexpr (std::is_class_v<Value> && !std::is_convertible_v<Value, std::string>)
        read(member, field);
    }
  }

 private:
  static bool isThere(const val& member) { return !member.isNull() && !member.isUndefined(); }

  template <class Item>
  static void readItems(const val& member, std::vector<Item>& items) {
    if constexpr (std::is_arithmetic_v<Item> || std::is_enum_v<Item>)
      readArray(member, items);
    else if constexpr (std::is_same_v<Item, std::string>)
      items = emscripten::vecFromJSArray<std::string>(member);
  }

  const val& object_;
};

template <class Struct>
val toObject(const Struct& value, const val& copy) {
  val result = val::object();
  Struct::fields(value, ObjectWriter(result, copy));
  return result;
}
template <class Struct>
val toObject(const Struct& value) {
  return toObject(value, val::undefined());
}

template <class Struct>
void read(const val& object, Struct& value) {
  Struct::fields(value, ObjectReader(object));
}

/// The size of the arrays of a struct.
template <class Struct>
double bytesOf(const Struct& value) {
  double sum = 0;
  forEachArray(value, [&](const auto&, const auto& array) { sum += double(array.size() * sizeof array[0]); });
  return sum;
}

}  // namespace mandoline::wasm
