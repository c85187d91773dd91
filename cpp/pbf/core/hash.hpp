#pragma once

#include <cstddef>
#include <cstdint>

namespace pbf {

/// FNV-1a over bytes: shows that two states have the same bits. Not for security.
class Hash {
 public:
  Hash& add(const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < bytes; ++k) value_ = (value_ ^ byte[k]) * 0x100000001b3ULL;
    return *this;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace pbf
