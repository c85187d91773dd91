#include "pbf/neighbors/scan.hpp"

namespace pbf {

#define PBF_DECLARE(isa) \
  namespace isa {        \
  const Scan& scan();    \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const Scan& scan(Isa isa) {
  using FindTable = const Scan& (*)();
#define PBF_TABLE(isa) isa::scan,
  static constexpr FindTable tables[] = {PBF_FOR_EACH_ISA(PBF_TABLE)};
#undef PBF_TABLE
  return tables[static_cast<std::size_t>(isa)]();
}

}  // namespace pbf
