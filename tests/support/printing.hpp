#pragma once

// How doctest prints what the tests compare: (0.1, 0.2, 0.3).

#include <doctest/doctest.h>

#include <optional>
#include <sstream>
#include <string>

#include "common/math/vector.hpp"

namespace lightwalk::tests {

/// Six digits, the precision of a float, without trailing zeros.
inline std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

inline std::string text_of(const Vec3& v) {
  std::ostringstream text;
  // Prints -0 as 0.
  text << '(' << v.x + 0 << ", " << v.y + 0 << ", " << v.z + 0 << ')';
  return text.str();
}

/// "1 bounce", "2 bounces".
inline std::string bounces_in_words(int count) {
  return std::to_string(count) + (count == 1 ? " bounce" : " bounces");
}

}  // namespace lightwalk::tests

namespace doctest {

/// doctest would print its address.
template <>
struct StringMaker<const char*> {
  static String convert(const char* text) { return text; }
};

template <>
struct StringMaker<lightwalk::Vec2> {
  static String convert(const lightwalk::Vec2& v) {
    const std::string x = lightwalk::tests::text_of(double(v.x));
    return ("(" + x + ", " + lightwalk::tests::text_of(double(v.y)) + ")")
        .c_str();
  }
};

template <>
struct StringMaker<lightwalk::Vec3> {
  static String convert(const lightwalk::Vec3& v) {
    return lightwalk::tests::text_of(v).c_str();
  }
};

template <>
struct StringMaker<lightwalk::DoubleVec3> {
  static String convert(const lightwalk::DoubleVec3& v) {
    return lightwalk::tests::text_of(lightwalk::Vec3(v)).c_str();
  }
};

template <class T>
struct StringMaker<std::optional<T>> {
  static String convert(const std::optional<T>& value) {
    return value ? toString(*value) : "nothing";
  }
};

template <>
struct StringMaker<std::nullopt_t> {
  static String convert(std::nullopt_t) { return "nothing"; }
};

}  // namespace doctest
