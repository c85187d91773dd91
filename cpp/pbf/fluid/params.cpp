#include "pbf/fluid/params.hpp"

namespace pbf {

void FluidParams::check_together(Faults& faults) const {
  // Below 1.2 d the lattice neighbors drop out of the kernel; above 4 d a particle has more than
  // 250 neighbors.
  const double least = 1.2 * static_cast<double>(spacing);
  const double most = 4.0 * static_cast<double>(spacing);
  const Range range = between(least, most);
  if (!range.contains(static_cast<double>(h()))) {
    faults.add("support_radius", h(), "m", range.text() + " (1.2 to 4 times the spacing)");
  }
  if (dimensions == 2 && gravity[2] != 0) {
    faults.add("gravity", gravity, "m/s^2", "z must be 0 in 2-D (dimensions = 2)");
  }
}

void SolverParams::check_together(Faults& faults) const {
  if (min_iterations > max_iterations) {
    faults.add("min_iterations", min_iterations, "",
               "must not exceed max_iterations = " + to_text(max_iterations));
  }
  if (min_time_step > max_time_step) {
    faults.add("min_time_step", min_time_step, "s",
               "must not exceed max_time_step = " + to_text(max_time_step));
  }
}

}  // namespace pbf
