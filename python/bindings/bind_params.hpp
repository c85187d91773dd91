#pragma once

#include "pbf/core/fields.hpp"

#include <pybind11/stl.h>

#include "common.hpp"
#include <array>
#include <charconv>
#include <string>

/// Makes a Python class from a self-describing parameter struct (core/fields.hpp): defaults, ranges
/// and texts are read from the struct, never repeated here.
namespace pbf {

/// The double whose decimal text is that of the float: 0.02F shows as 0.02 in Python, not
/// 0.019999999552965164, and turns into the same float again.
inline double shortest_double(Real value) {
  if (!std::isfinite(value)) return static_cast<double>(value);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double result = 0.0;
  std::from_chars(text.data(), end, result);
  return result;
}

/// How a field's type looks from Python.
template <class T>
struct PythonForm {
  using type = T;
  static constexpr const char* kind = std::is_same_v<T, bool> ? "bool"
                                      : std::is_integral_v<T> ? "int"
                                                              : "float";
  static constexpr const char* expected = std::is_same_v<T, bool> ? "true or false"
                                          : std::is_integral_v<T> ? "a whole number"
                                                                  : "a number";
  static constexpr const char* annotation = std::is_same_v<T, bool> ? "bool"
                                            : std::is_integral_v<T> ? "int"
                                                                    : "float";
  static type out(const T& value) { return value; }
  static T in(const type& value) { return value; }
};
template <>
struct PythonForm<Real> : PythonForm<double> {
  static double out(Real value) { return shortest_double(value); }
  static Real in(double value) { return static_cast<Real>(value); }
};
template <>
struct PythonForm<std::string> {
  using type = std::string;
  static constexpr const char* kind = "string";
  static constexpr const char* expected = "a string";
  static constexpr const char* annotation = "str";
  static type out(const std::string& value) { return value; }
  static std::string in(const type& value) { return value; }
};
template <class T>
requires std::is_enum_v<T>
struct PythonForm<T> {
  using type = std::string;
  static constexpr const char* kind = "choice";
  static constexpr const char* expected = "a string";
  static constexpr const char* annotation = "str";
  static type out(T value) { return Choices<T>::names.at(static_cast<std::size_t>(value)); }
  static T in(const type& value) {
    std::string rule;
    for (std::size_t k = 0; k < Choices<T>::names.size(); ++k) {
      if (value == Choices<T>::names[k]) return static_cast<T>(k);
      rule += (k > 0 ? ", \"" : "\"") + std::string(Choices<T>::names[k]) + "\"";
    }
    throw InvalidParameter(to_text(value) + ": must be one of " + rule);
  }
};
template <VectorField T>
struct PythonForm<T> {
  using type = std::tuple<double, double, double>;
  static constexpr const char* kind = "vec3";
  static constexpr const char* expected = "three numbers";
  static constexpr const char* annotation = "collections.abc.Sequence[float]";
  static type out(const T& v) {
    return {shortest_double(v[0]), shortest_double(v[1]), shortest_double(v[2])};
  }
  static T in(const type& v) {
    T result;
    result[0] = static_cast<Real>(std::get<0>(v));
    result[1] = static_cast<Real>(std::get<1>(v));
    result[2] = static_cast<Real>(std::get<2>(v));
    return result;
  }
};
template <>
struct PythonForm<std::array<bool, 3>> {
  using type = std::tuple<bool, bool, bool>;
  static constexpr const char* kind = "bool3";
  static constexpr const char* expected = "true or false three times";
  static constexpr const char* annotation = "collections.abc.Sequence[bool]";
  static type out(const std::array<bool, 3>& v) { return {v[0], v[1], v[2]}; }
  static std::array<bool, 3> in(const type& v) {
    return {std::get<0>(v), std::get<1>(v), std::get<2>(v)};
  }
};
template <>
struct PythonForm<std::array<Real, 2>> {
  using type = std::tuple<double, double>;
  static constexpr const char* kind = "vec2";
  static constexpr const char* expected = "two numbers";
  static constexpr const char* annotation = "collections.abc.Sequence[float]";
  static type out(const std::array<Real, 2>& v) {
    return {shortest_double(v[0]), shortest_double(v[1])};
  }
  static std::array<Real, 2> in(const type& v) {
    return {static_cast<Real>(std::get<0>(v)), static_cast<Real>(std::get<1>(v))};
  }
};
template <class T>
struct PythonForm<std::optional<T>> {
  using type = std::optional<typename PythonForm<T>::type>;
  static constexpr const char* kind = PythonForm<T>::kind;
  static constexpr const char* expected = PythonForm<T>::expected;
  inline static const std::string optional_annotation =
      std::string(PythonForm<T>::annotation) + " | None";
  inline static const char* const annotation = optional_annotation.c_str();
  static type out(const std::optional<T>& value) {
    return value ? type(PythonForm<T>::out(*value)) : std::nullopt;
  }
  static std::optional<T> in(const type& value) {
    return value ? std::optional<T>(PythonForm<T>::in(*value)) : std::nullopt;
  }
};

template <class T>
bool is_wrong_scalar(py::handle value) {
  // pybind11 would take True for 1; a flag given for a number is a slip.
  return !std::is_same_v<typename PythonForm<T>::type, bool> && py::isinstance<py::bool_>(value);
}

template <class P, class T>
void assign_field(P& params, const Field<P, T>& field, py::handle value) {
  const std::string name = std::string(P::kName) + "." + field.name;
  try {
    if (is_wrong_scalar<T>(value)) throw py::cast_error();
    params.*field.member = PythonForm<T>::in(value.cast<typename PythonForm<T>::type>());
  } catch (const py::cast_error&) {
    raise("WrongType", name + " = " + py::repr(value).cast<std::string>() + ": expected " +
                           PythonForm<T>::expected + (is_optional<T>::value ? " or None" : ""));
  } catch (const InvalidParameter& e) {
    throw InvalidParameter(name + " = " + e.what());
  }
}

template <class P>
void assign_named(P& params, const std::string& name, py::handle value) {
  bool found = false;
  std::string known;
  const auto visit = [&](const auto& field) {
    known += (known.empty() ? "" : ", ") + std::string(field.name);
    if (name == field.name) {
      assign_field(params, field, value);
      found = true;
    }
  };
  std::apply([&](const auto&... field) { (visit(field), ...); }, P::fields());
  if (!found)
    raise("WrongType",
          std::string(P::kName) + " has no parameter \"" + name + "\"; it has " + known);
}

/// T itself, or what it may hold.
template <class T>
struct Unwrapped {
  using type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
};

template <class P, class T>
py::dict describe_field(const Field<P, T>& field) {
  py::list choices;
  using Value = typename Unwrapped<T>::type;
  if constexpr (std::is_enum_v<Value>) {
    for (const char* name : Choices<Value>::names) choices.append(name);
  }
  static const P defaults;
  return py::dict("name"_a = field.name, "kind"_a = PythonForm<T>::kind,
                  "optional"_a = is_optional<T>::value, "unit"_a = field.unit,
                  "least"_a = field.range.least, "most"_a = field.range.most,
                  "least_excluded"_a = field.range.least_excluded,
                  "most_excluded"_a = field.range.most_excluded, "finite"_a = field.range.finite,
                  "default"_a = PythonForm<T>::out(defaults.*field.member), "doc"_a = field.doc,
                  "choices"_a = choices);
}

template <class P>
py::dict as_dict(const P& params) {
  py::dict result;
  const auto visit = [&](const auto& field) {
    using T = std::remove_cvref_t<decltype(params.*field.member)>;
    result[field.name] = PythonForm<T>::out(params.*field.member);
  };
  std::apply([&](const auto&... field) { (visit(field), ...); }, P::fields());
  return result;
}

/// The constructor's signature in words that a stub generator reads.
template <class P>
std::string init_signature(std::size_t positional) {
  std::string text = "__init__(self";
  std::size_t k = 0;
  const auto visit = [&](const auto& field) {
    using T = std::remove_cvref_t<decltype(std::declval<P>().*field.member)>;
    if (k++ == positional) text += ", *";
    text += std::string(", ") + field.name + ": " + PythonForm<T>::annotation + " = ...";
  };
  std::apply([&](const auto&... field) { (visit(field), ...); }, P::fields());
  return text + ") -> None";
}

/// @param positional  how many of the fields, from the first, may be given without their names.
template <class P>
py::class_<P> bind_params(py::module_& m, const char* doc, std::size_t positional = 0) {
  py::class_<P> cls(m, P::kName, doc);
  const auto names = [] {
    std::vector<std::string> result;
    std::apply([&](const auto&... field) { (result.emplace_back(field.name), ...); }, P::fields());
    return result;
  }();
  {
    py::options options;
    options.disable_function_signatures();
    cls.def(py::init([names, positional](const py::args& args, const py::kwargs& kwargs) {
              if (args.size() > positional) {
                raise("WrongType", std::string(P::kName) + " takes its parameters by name, as in " +
                                       P::kName + "(" + names.front() + "=…)");
              }
              P params;
              for (std::size_t k = 0; k < args.size(); ++k) assign_named(params, names[k], args[k]);
              for (const auto& [name, value] : kwargs)
                assign_named(params, name.template cast<std::string>(), value);
              validate(params);
              return params;
            }),
            init_signature<P>(positional).c_str());
    cls.def(
        "replace",
        [](const P& self, const py::kwargs& changes) {
          P params = self;
          for (const auto& [name, value] : changes)
            assign_named(params, name.template cast<std::string>(), value);
          validate(params);
          return params;
        },
        ("replace(self, **changes: typing.Any) -> " + std::string(P::kName) +
         "\n\nA copy with some fields changed.")
            .c_str());
  }
  const auto bind_field = [&](const auto& field) {
    using T = std::remove_cvref_t<decltype(std::declval<P>().*field.member)>;
    using Form = PythonForm<T>;
    cls.def_property(
        field.name, [field](const P& self) { return Form::out(self.*field.member); },
        [field](P& self, const typename Form::type& value) {
          P changed = self;
          assign_field(changed, field, py::cast(value));
          validate(changed);
          self = changed;
        },
        field.doc);
  };
  std::apply([&](const auto&... field) { (bind_field(field), ...); }, P::fields());
  cls.def("as_dict", &as_dict<P>, "The fields by name.");
  cls.def_static(
      "describe",
      [] {
        py::list result;
        std::apply([&](const auto&... field) { (result.append(describe_field(field)), ...); },
                   P::fields());
        return result;
      },
      "Name, kind, unit, range, default and meaning of each field.");
  cls.def("__repr__", [](const P& self) {
    std::string text;
    for (const auto& [name, value] : as_dict(self)) {
      text += (text.empty() ? "" : ", ") + name.template cast<std::string>() + "=" +
              py::repr(value).template cast<std::string>();
    }
    return std::string(P::kName) + "(" + text + ")";
  });
  cls.def("__eq__", [](const P& self, const py::object& other) {
    return py::isinstance<P>(other) && as_dict(self).equal(as_dict(other.cast<const P&>()));
  });
  cls.attr("__hash__") = py::none();
  return cls;
}

}  // namespace pbf
