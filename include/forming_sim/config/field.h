#pragma once
// The vocabulary in which every room declares what a user may set: one
// declaration per field, and from it follow validation, YAML, messages, the
// schema and docs/scene.md.
//
// A Config is a plain struct with one static function
//
//   template <class Visitor> static void declare(Visitor&& visit) {
//     visit(FORMING_SIM_FIELD(density),
//           Field().unit("kg/m3").above(0).required().doc("mass density"));
//   }
//
// FORMING_SIM_FIELD gives the name and an accessor that works on the Config and
// on the ROS message of the same field names, so a scene has one spelling.
// Member types: double, int, bool, std::string, Vec3, std::vector of these,
// std::optional<Config> (a group that may be absent), std::vector<Config>.
//
// Messages have no "absent": there 0, "" and [] mean "not given". Therefore a
// field whose default is not zero may not have zero in its range (a test holds
// every declaration to it), bool fields default to false, and a required field
// may not have zero as a sensible value unless it says may_be_zero().
#include <limits>
#include <string>
#include <vector>

#define FORMING_SIM_FIELD(member) \
  #member, [](auto& object) -> auto& { return object.member; }

namespace forming_sim {

class Field {
 public:
  /// SI unit, "1" for a pure number, "deg" where the name says so.
  Field& unit(std::string text) { unit_ = std::move(text); return *this; }
  /// One sentence for the schema and the docs.
  Field& doc(std::string text) { doc_ = std::move(text); return *this; }
  /// Missing is a fault (only where `when` applies).
  Field& required() { required_ = true; return *this; }
  /// Of a required field: zero is a value like any other, so a message that
  /// holds zero has given it.
  Field& may_be_zero() { may_be_zero_ = true; return *this; }
  Field& above(double bound) { min_ = bound; min_open_ = true; return *this; }
  Field& at_least(double bound) { min_ = bound; min_open_ = false; return *this; }
  Field& below(double bound) { max_ = bound; max_open_ = true; return *this; }
  Field& at_most(double bound) { max_ = bound; max_open_ = false; return *this; }
  /// A string field: the words it may take.
  Field& choices(std::vector<std::string> words) { choices_ = std::move(words); return *this; }
  /// The field applies only where the sibling string field has one of these
  /// values; given elsewhere, it is a fault.
  Field& when(std::string sibling, std::vector<std::string> values) {
    when_field_ = std::move(sibling);
    when_values_ = std::move(values);
    return *this;
  }
  /// What stands in the docs where the default is not a plain number
  /// ("from the mesh and the material").
  Field& computed(std::string text) { computed_ = std::move(text); return *this; }

  const std::string& unit() const { return unit_; }
  const std::string& doc() const { return doc_; }
  bool is_required() const { return required_; }
  bool zero_is_given() const { return may_be_zero_; }
  double min() const { return min_; }
  double max() const { return max_; }
  bool min_open() const { return min_open_; }
  bool max_open() const { return max_open_; }
  const std::vector<std::string>& choices() const { return choices_; }
  const std::string& when_field() const { return when_field_; }
  const std::vector<std::string>& when_values() const { return when_values_; }
  const std::string& computed() const { return computed_; }

  bool contains(double value) const {
    return (min_open_ ? value > min_ : value >= min_) && (max_open_ ? value < max_ : value <= max_);
  }

 private:
  std::string unit_ = "1", doc_, when_field_, computed_;
  std::vector<std::string> choices_, when_values_;
  double min_ = -std::numeric_limits<double>::infinity();
  double max_ = std::numeric_limits<double>::infinity();
  bool min_open_ = false, max_open_ = false, required_ = false, may_be_zero_ = false;
};

}  // namespace forming_sim
