#include "pbf/core/fields.hpp"

namespace pbf {

std::string Range::text() const {
  std::ostringstream out;
  const bool has_least = !std::isinf(least);
  const bool has_most = !std::isinf(most);
  out << "must be ";
  if (finite) out << "finite";
  if (finite && (has_least || has_most)) out << ", ";
  if (has_least) out << (least_excluded ? "> " : ">= ") << least;
  if (has_least && has_most) out << " and ";
  if (has_most) out << (most_excluded ? "< " : "<= ") << most;
  if (!finite && !has_least && !has_most) out << "a number";
  return out.str();
}

void Faults::throw_if_any() const {
  if (faults_.empty()) return;
  std::string text;
  for (const auto& fault : faults_) text += (text.empty() ? "" : "\n") + fault;
  throw InvalidParameter(text);
}

}  // namespace pbf
