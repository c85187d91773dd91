#include "pbf/neighbors/scan.hpp"

namespace pbf {

#define PBF_DECLARE(isa) \
  namespace isa {        \
  const Scan& scan();    \
  }
PBF_FOR_EACH_ISA(PBF_DECLARE)
#undef PBF_DECLARE

const Scan& scan(Isa isa) {
  switch (isa) {
#define PBF_CASE(isa) \
  case Isa::isa:      \
    return isa::scan();
    PBF_FOR_EACH_ISA(PBF_CASE)
#undef PBF_CASE
  }
  return scan(usable_isas().front());
}

}  // namespace pbf
