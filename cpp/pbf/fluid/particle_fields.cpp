#include "pbf/fluid/particle_fields.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/fluid/field_operators.hpp"
#include "pbf/kernels/calibration.hpp"
#include "pbf/neighbors/reorder.hpp"

namespace pbf {
namespace {

/// Beyond, the derivatives' powers of h are more, or less, than a float holds [m].
constexpr Range kSupportRadii = between(static_cast<double>(1e-6F), 1e6);

void require_count(Index got, Index expected) {
  if (got != expected) {
    throw InvalidParameter("values: " + std::to_string(got) + " rows, but positions has " +
                           std::to_string(expected) + "; must be equal");
  }
}

}  // namespace

ParticleFields::ParticleFields(const PointsView& positions, Real h, const Options& options)
    : options_(options), h_(h) {
  if (!kSupportRadii.contains(static_cast<double>(h))) {
    throw InvalidParameter("support_radius = " + to_text(h) + " m: " + kSupportRadii.text());
  }
  if (!(options.volume >= 0) || !std::isfinite(options.volume)) {
    throw InvalidParameter("volume = " + to_text(options.volume) + " m^3: must be finite, > 0");
  }
  if (options_.volume == 0) {
    const double radius = static_cast<double>(h);
    options_.volume = static_cast<Real>(calibrate(options.kernel, 3, radius / 2, radius).volume);
  }
  for (Index i = 0; i < positions.cols(); ++i) {
    const Vec3 x = positions.col(i);
    if (CellGrid::reaches(x, h)) continue;
    throw InvalidParameter("positions: particle " + std::to_string(i) + " at " + to_text(x) +
                           " m; " + CellGrid::reach_text(h));
  }
  grid_.build(records_of(positions), h, options.num_threads);
  x_ = gathered(Points(positions), grid_.order());
  near_.build(grid_, records_of(x_), h, options.num_threads);
}

/// Calls f(sample, k, i) for the particle at place k of the cell order, which is i outside.
template <class F>
void ParticleFields::at_each(F&& f) const {
  with_kernel(options_.kernel, 3, h_, [&](const auto& kernel) {
    const FieldSample sample{x_, near_, kernel, options_.volume};
    parallel_for(size(), options_.num_threads, [&](Index k) {
      f(sample, k, static_cast<Index>(grid_.order()[static_cast<std::size_t>(k)]));
    });
  });
}

Scalars ParticleFields::relative_density() const {
  Scalars result(size());
  at_each([&](const auto& s, Index k, Index i) {
    Real sum_W = s.kernel.W(Real(0));
    for (const std::uint32_t j : near_[k])
      sum_W += s.kernel.W((x_.col(k) - x_.col(j)).squaredNorm());
    result[i] = s.V * sum_W;
  });
  return result;
}

Points ParticleFields::gradient(const ScalarsView& values) const {
  require_count(values.size(), size());
  const Scalars A = gathered(Scalars(values), grid_.order());
  Points result(3, size());
  at_each([&](const auto& s, Index k, Index i) {
    const Vec3 grad = gradient_at(s, k, A);
    result.col(i) = options_.corrected ? Vec3(gradient_correction_at(s, k) * grad) : grad;
  });
  return result;
}

Eigen::Matrix<Real, 9, Eigen::Dynamic> ParticleFields::jacobian(const PointsView& values) const {
  require_count(values.cols(), size());
  const Points a = gathered(Points(values), grid_.order());
  Eigen::Matrix<Real, 9, Eigen::Dynamic> result(9, size());
  at_each([&](const auto& s, Index k, Index i) {
    Mat3 J = jacobian_at(s, k, a);
    if (options_.corrected) J = J * gradient_correction_at(s, k).transpose();
    Eigen::Map<Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>>(result.col(i).data()) = J;
  });
  return result;
}

Scalars ParticleFields::divergence(const PointsView& values) const {
  const auto J = jacobian(values);
  return (J.row(0) + J.row(4) + J.row(8)).transpose().array();
}

Points ParticleFields::curl(const PointsView& values) const {
  const auto J = jacobian(values);
  Points result(3, size());
  for (Index i = 0; i < size(); ++i) {
    result.col(i) =
        curl_of(Eigen::Map<const Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>>(J.col(i).data()));
  }
  return result;
}

Scalars ParticleFields::laplacian(const ScalarsView& values) const {
  require_count(values.size(), size());
  const Scalars A = gathered(Scalars(values), grid_.order());
  Scalars result(size());
  at_each([&](const auto& s, Index k, Index i) { result[i] = laplacian_at(s, k, A); });
  return result;
}

}  // namespace pbf
