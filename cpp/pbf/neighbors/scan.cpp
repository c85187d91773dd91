#include "pbf/neighbors/scan.hpp"

namespace pbf {

PBF_TABLE_BY_ISA(Scan, scan, scan)

}  // namespace pbf
