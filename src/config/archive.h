#pragma once
// Plain values to bytes and back.
#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "forming_sim/config/fault.h"

namespace forming_sim {

/// Whether all bytes of a T are its value: numbers, vectors of fixed size, and what has no padding, whose bytes nobody would have written.
template <class T, class = void> struct Whole : std::bool_constant<std::is_arithmetic_v<T> || std::has_unique_object_representations_v<T>> {};
template <class T> struct Whole<T, std::void_t<typename T::Scalar>> : std::bool_constant<sizeof(T) == T::SizeAtCompileTime * sizeof(typename T::Scalar)> {};

class Writer {
 public:
  template <class T> void raw(const T& value) {
    static_assert(Whole<T>::value, "only plain values without padding");
    append(&value, sizeof(T));
  }
  template <class T> void number(const T& value) { raw(value); }
  void numbers(const double* values, std::size_t count) { append(values, count * sizeof(double)); }
  template <class T> void list(const std::vector<T>& values) {
    static_assert(Whole<T>::value, "only plain values without padding");
    number(values.size());
    append(values.data(), values.size() * sizeof(T));
  }
  /// Values that are exchanged part by part.
  template <class T, class Exchange> void each(std::vector<T>& values, Exchange&& exchange) {
    number(values.size());
    for (T& value : values) exchange(value);
  }
  template <class T> void lists(const std::map<std::string, std::vector<T>>& named) {
    number(named.size());
    for (const auto& [name, values] : named) {
      text(name);
      list(values);
    }
  }
  void text(const std::string& value) { list(std::vector<char>(value.begin(), value.end())); }
  std::vector<char> take() { return std::move(data_); }

 private:
  void append(const void* from, std::size_t bytes) {
    const char* p = static_cast<const char*>(from);
    data_.insert(data_.end(), p, p + bytes);
  }
  std::vector<char> data_;
};

/// Throws Error(resume_error) where the data ends too early.
class Reader {
 public:
  explicit Reader(const std::vector<char>& data) : data_(data) {}
  template <class T> void raw(T& value) {
    static_assert(Whole<T>::value, "only plain values without padding");
    take(&value, sizeof(T));
  }
  template <class T> void number(T& value) { raw(value); }
  void numbers(double* values, std::size_t count) { take(values, count * sizeof(double)); }
  template <class T> void list(std::vector<T>& values) {
    static_assert(Whole<T>::value, "only plain values without padding");
    std::size_t count = 0;
    number(count);
    if (count > (data_.size() - at_) / sizeof(T)) fail();
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }
  template <class T, class Exchange> void each(std::vector<T>& values, Exchange&& exchange) {
    std::size_t count = 0;
    number(count);
    if (count > data_.size() - at_) fail();
    values.resize(count);
    for (T& value : values) exchange(value);
  }
  template <class T> void lists(std::map<std::string, std::vector<T>>& named) {
    std::size_t count = 0;
    number(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::string name;
      text(name);
      list(named[name]);
    }
  }
  void text(std::string& value) {
    std::vector<char> letters;
    list(letters);
    value.assign(letters.begin(), letters.end());
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(Code::resume_error, "the checkpoint ends at byte " + std::to_string(data_.size()) +
                                        ", in the middle of its data; it is damaged");
  }
  void take(void* to, std::size_t bytes) {
    if (bytes > data_.size() - at_) fail();
    if (bytes > 0) std::memcpy(to, data_.data() + at_, bytes);
    at_ += bytes;
  }
  const std::vector<char>& data_;
  std::size_t at_ = 0;
};

}  // namespace forming_sim
