#pragma once

#include "pbf/core/error.hpp"
#include "pbf/core/types.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

/// Parameter structs describe themselves: one table per struct names each field with its unit, its
/// range and what it does. Validation, the Python classes and the scene schema are all read from
/// that table; a default stands in one place only, the struct's own member initialiser.
///
///     struct Params {
///       Real spacing = 0.02F;
///       static constexpr const char* kName = "Params";
///       static auto fields() {
///         return std::tuple{Field{"spacing", &Params::spacing, "m", above(0), "Particle distance
///         at rest."}};
///       }
///       void check_together(Faults& faults) const;   // optional: rules that span fields
///     };
namespace pbf {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Allowed values of a number; for vectors, of each component.
struct Range {
  double least = -kInfinity;
  double most = kInfinity;
  bool least_excluded = false;
  bool most_excluded = false;
  bool finite = true;

  [[nodiscard]] bool contains(double value) const {
    if (std::isnan(value) || (finite && std::isinf(value))) return false;
    return (least_excluded ? value > least : value >= least) &&
           (most_excluded ? value < most : value <= most);
  }
  [[nodiscard]] std::string text() const;
};

inline constexpr Range anything() { return {}; }
inline constexpr Range above(double least) { return {.least = least, .least_excluded = true}; }
inline constexpr Range at_least(double least) { return {.least = least}; }
inline constexpr Range between(double least, double most) { return {.least = least, .most = most}; }
/// (least, most): both ends excluded.
inline constexpr Range inside(double least, double most) {
  return {.least = least, .most = most, .least_excluded = true, .most_excluded = true};
}
/// [-inf, most]: minus infinity is a value like any other.
inline constexpr Range at_most_or_minus_infinity(double most) {
  return {.most = most, .finite = false};
}

template <class Owner, class T>
struct Field {
  const char* name;
  T Owner::*member;
  const char* unit;  ///< "" for a pure number
  Range range;
  const char*
      doc;  ///< one sentence or two: what it is and what it does to the motion or the picture
};
template <class Owner, class T>
Field(const char*, T Owner::*, const char*, Range, const char*) -> Field<Owner, T>;

/// Names of an enumeration's values in order, by specialisation: `static constexpr std::array
/// names{"a", "b"};`
template <class Enum>
struct Choices;

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};

template <class T>
concept VectorField = requires(const T& v) {
  {v.size()};
  {v[0]};
}
&&!std::is_same_v<T, std::string>;

template <class T>
std::string to_text(const T& value) {
  std::ostringstream out;
  if constexpr (is_optional<T>::value) {
    return value ? to_text(*value) : "none";
  } else if constexpr (std::is_same_v<T, bool>) {
    out << (value ? "true" : "false");
  } else if constexpr (std::is_enum_v<T>) {
    out << '"' << Choices<T>::names.at(static_cast<std::size_t>(value)) << '"';
  } else if constexpr (std::is_same_v<T, std::string>) {
    out << '"' << value << '"';
  } else if constexpr (VectorField<T>) {
    out << '(';
    for (int k = 0; k < static_cast<int>(value.size()); ++k)
      out << (k > 0 ? ", " : "") << to_text(value[k]);
    out << ')';
  } else {
    out << value;
  }
  return out.str();
}

/// Whether two structs agree in every field.
template <class Params>
bool same(const Params& a, const Params& b) {
  return std::apply(
      [&](const auto&... field) { return ((a.*(field.member) == b.*(field.member)) && ...); },
      Params::fields());
}

/// Every broken rule of one struct, so that a user mends them in one go.
class Faults {
 public:
  explicit Faults(std::string owner) : owner_(std::move(owner)) {}

  template <class T>
  void add(const char* field, const T& value, const char* unit, const std::string& rule) {
    faults_.push_back(owner_ + "." + field + " = " + to_text(value) + (*unit != '\0' ? " " : "") +
                      unit + ": " + rule);
  }
  void throw_if_any() const;

 private:
  std::string owner_;
  std::vector<std::string> faults_;
};

template <class T>
bool field_is_valid(const T& value, const Range& range) {
  if constexpr (is_optional<T>::value) {
    return !value || field_is_valid(*value, range);
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<std::size_t>(value) < Choices<T>::names.size();
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    return true;
  } else if constexpr (VectorField<T>) {
    for (int k = 0; k < static_cast<int>(value.size()); ++k) {
      if (!range.contains(static_cast<double>(value[k]))) return false;
    }
    return true;
  } else {
    return range.contains(static_cast<double>(value));
  }
}

/// Throws InvalidParameter with a line for each field whose value breaks its rule.
template <class Params>
void validate(const Params& params) {
  Faults faults(Params::kName);
  const auto check = [&](const auto& field) {
    const auto& value = params.*field.member;
    if (!field_is_valid(value, field.range))
      faults.add(field.name, value, field.unit, field.range.text());
  };
  std::apply([&](const auto&... field) { (check(field), ...); }, Params::fields());
  faults.throw_if_any();
  if constexpr (requires { params.check_together(faults); }) {
    params.check_together(faults);
    faults.throw_if_any();
  }
}

}  // namespace pbf
