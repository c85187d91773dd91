#pragma once

#include "pbf/core/isa.hpp"

#include <doctest/doctest.h>

#include <cstdlib>

namespace pbf::test {

/// Runs f with each instruction set that this processor has.
template <class F>
void for_each_isa(F&& f) {
  for (const Isa isa : usable_isas()) {
    CAPTURE(isa_name(isa));
    REQUIRE(setenv("PBF_ISA", isa_name(isa), 1) == 0);
    f();
    unsetenv("PBF_ISA");
  }
}

}  // namespace pbf::test
