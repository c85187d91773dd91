// Runs every test with each instruction set that this processor has.
#define DOCTEST_CONFIG_IMPLEMENT
#include "pbf/core/isa.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  for (const pbf::Isa isa : pbf::usable_isas()) {
    setenv("PBF_ISA", pbf::isa_name(isa), 1);
    doctest::Context context(argc, argv);
    const int failed = context.run();
    if (failed != 0) {
      std::cerr << "with PBF_ISA=" << pbf::isa_name(isa) << '\n';
      return failed;
    }
    if (context.shouldExit()) return 0;
  }
  return 0;
}
