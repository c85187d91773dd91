#include "pbf/fluid/density_constraint.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/fluid/tensile_correction.hpp"

#include <algorithm>

namespace pbf {

void relative_densities(const Neighborhood& near,
                        const Discretization& disc,
                        const PointsView& x_star,
                        int threads,
                        Scalars& relative_density) {
  relative_density.resize(x_star.cols());
  with_kernel(disc.fluid.kernel, disc.h, [&](const auto& kernel) {
    parallel_for(x_star.cols(), threads, [&](Index i) {
      const Vec3 x_i = x_star.col(i);
      Real sum_W = kernel.W(0);
      for (const std::uint32_t j : near.fluid[i])
        sum_W += kernel.W((x_i - x_star.col(j)).squaredNorm());
      for (const Vec3& q : near.boundary[i]) sum_W += kernel.W((x_i - q).squaredNorm());
      relative_density[i] = disc.V * sum_W;
    });
  });
}

void solve_multipliers(const Neighborhood& near,
                       const Discretization& disc,
                       const SolverParams& solver,
                       const PointsView& x_star,
                       Scalars& relative_density,
                       Scalars& lambda) {
  relative_density.resize(x_star.cols());
  lambda.resize(x_star.cols());
  const Real epsilon = solver.relaxation * disc.ideal_denominator;
  with_kernel(disc.fluid.kernel, disc.h, [&](const auto& kernel) {
    parallel_for(x_star.cols(), solver.num_threads, [&](Index i) {
      const Vec3 x_i = x_star.col(i);
      Real sum_W = kernel.W(0);
      Real sum_grad2 = 0;            // Σ_{j≠i} ‖∇_j C_i‖²
      Vec3 sum_grad = Vec3::Zero();  // ∇_i C_i
      for (const std::uint32_t j : near.fluid[i]) {
        const Vec3 r = x_i - x_star.col(j);
        const Real r2 = r.squaredNorm();
        // V first: ‖∇W‖² alone leaves float32's range for very fine and very coarse particles.
        const Real s = disc.V * kernel.grad_factor(r2);
        sum_W += kernel.W(r2);
        sum_grad += s * r;
        sum_grad2 += s * s * r2;
      }
      for (const Vec3& q : near.boundary[i]) {
        const Vec3 r = x_i - q;
        const Real r2 = r.squaredNorm();
        sum_W += kernel.W(r2);
        sum_grad += disc.V * kernel.grad_factor(r2) * r;
      }
      relative_density[i] = disc.V * sum_W;
      const Real C = std::max(relative_density[i] - 1, solver.constraint_floor);
      const Real denominator = sum_grad2 + sum_grad.squaredNorm() + epsilon;
      // Without relaxation and without a gradient no correction could change C.
      lambda[i] = denominator > 0 ? -C / denominator : Real(0);
    });
  });
}

void compute_corrections(const Neighborhood& near,
                         const Discretization& disc,
                         const SolverParams& solver,
                         const PointsView& x_star,
                         const ScalarsView& lambda,
                         Points& dp) {
  dp.resize(3, x_star.cols());
  with_kernel(disc.fluid.kernel, disc.h, [&](const auto& kernel) {
    const TensileCorrection s_corr(kernel, disc, solver);
    const auto gather = [&](auto with_tensile) {
      parallel_for(x_star.cols(), solver.num_threads, [&](Index i) {
        const Vec3 x_i = x_star.col(i);
        const auto s = [&](Real r2) { return with_tensile ? s_corr(kernel.W(r2)) : Real(0); };
        Vec3 sum = Vec3::Zero();
        for (const std::uint32_t j : near.fluid[i]) {
          const Vec3 r = x_i - x_star.col(j);
          const Real r2 = r.squaredNorm();
          sum += (lambda[i] + lambda[j] + s(r2)) * kernel.grad_factor(r2) * r;
        }
        for (const Vec3& q : near.boundary[i]) {
          const Vec3 r = x_i - q;
          const Real r2 = r.squaredNorm();
          sum += (lambda[i] + s(r2)) * kernel.grad_factor(r2) * r;
        }
        dp.col(i) = disc.V * sum;
      });
    };
    if (s_corr.active()) {
      gather(std::true_type{});
    } else {
      gather(std::false_type{});
    }
  });
}

void apply_corrections(const Discretization& disc,
                       const PointsView& x,
                       const PointsView& dp,
                       int threads,
                       Points& x_star,
                       Points& u) {
  parallel_for(x.cols(), threads,
               [&](Index i) { disc.move(x.col(i), dp.col(i), x_star.col(i), u.col(i)); });
}

}  // namespace pbf
