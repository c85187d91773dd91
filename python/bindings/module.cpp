#include "common.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled side of pbfluids. Private: use the names of pbfluids itself.";
  pbf::register_errors(m);
  pbf::register_params(m);
  pbf::register_fluid(m);
  pbf::register_stages(m);
  pbf::register_operators(m);
  pbf::register_build(m);
#ifdef PBF_WITH_RENDER
  pbf::register_render(m);
#endif
}
