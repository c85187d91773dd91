#pragma once

#include "pbf/fluid/slices.hpp"

/// The sums of fluid/density_constraint.hpp over neighbors j and boundary particles q.
namespace pbf::PBF_ISA_NAMESPACE {

/// C_i and its gradients.
struct ConstraintLanes {
  Vec3Lanes x;  ///< x*_i [m]
  Lanes C;      ///< ρ_i/ρ0 − 1
  Lanes grad2;  ///< Σ_k ‖∇_k C_i‖² [1/m²]
};

template <class Kernel>
PBF_INLINE ConstraintLanes constraint(const Kernel& VW, const Slice& slice, const Record* x_star) {
  const Vec3Lanes x_i = load_records(x_star + slice.first).xyz;
  Lanes density = VW.W(Lanes(0));
  Lanes sum_grad2 = 0;         // Σ_{j≠i} ‖∇_j C_i‖², in units of slope_unit²
  Vec3Lanes grad = {0, 0, 0};  // ∇_i C_i, in units of slope_unit
  slice.for_each_neighbor([&](const std::uint32_t* j) PBF_LAMBDA_INLINE {
    const Vec3Lanes r = x_i - gather(x_star, j).xyz;
    const Lanes r2 = dot(r, r);
    const Lanes s = VW.slope_in_units(r2);
    density += VW.W(r2);
    grad -= s * r;
    sum_grad2 += s * r2 * s;  // in this order no product overflows where r is nothing
  });
  slice.for_each_wall([&](const Vec3Lanes& q) PBF_LAMBDA_INLINE {
    const Vec3Lanes r = x_i - q;
    const Lanes r2 = dot(r, r);
    density += VW.W(r2);
    grad -= VW.slope_in_units(r2) * r;
  });
  // One factor after the other: their square may not be a normal number.
  const Lanes unit(VW.slope_unit);
  return {x_i, density - Lanes(1), unit * (unit * (sum_grad2 + dot(grad, grad)))};
}

template <class Kernel>
void multipliers(const Kernel& VW,
                 const Stretch& at,
                 Real epsilon,
                 Real floor,
                 const Record* x_star,
                 Record* x_lambda) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const ConstraintLanes i = constraint(VW, slice, x_star);
    const Lanes C = max(i.C, Lanes(floor));
    const Lanes denominator = i.grad2 + Lanes(epsilon);
    // Without relaxation and without a gradient no correction could change C.
    const Lanes lambda = select(denominator > Lanes(0), -C / denominator, Lanes(0));
    store_records(x_lambda + slice.first, i.x, lambda);
  });
}

/// The formulas are in fluid/pressure.hpp.
template <class Kernel>
void pressures(const Kernel& VW,
               const Stretch& at,
               const PressureTerms& terms,
               const Record* x_star,
               Record* states,
               Record* x_delta) {
  const Lanes alpha = terms.compliance;
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const ConstraintLanes i = constraint(VW, slice, x_star);
    const RecordLanes state = load_records(states + slice.first);
    const Lanes last = state.xyz.x, guess = state.xyz.y;
    const Lanes denominator = i.grad2 + Lanes(terms.epsilon) + alpha;
    const Lanes residual = i.C + alpha * guess;
    const Lanes wanted = guess - Lanes(terms.step) * residual / denominator;
    const Lanes most = Lanes(-terms.floor) / denominator;
    const Lanes allowed = select(wanted > most, most, wanted);
    const Lanes total = select(denominator > Lanes(0), allowed, last);
    const Lanes way = total - last;
    const Lanes next_guess = total + Lanes(terms.momentum) * way;
    store_records(states + slice.first, Vec3Lanes{total, next_guess, residual},
                  (guess - total) * denominator * way);
    store_records(x_delta + slice.first, i.x, next_guess - guess);
  });
}

/// Of a particle's p̂ that stands for a boundary particle's.
inline constexpr Real kBoundaryShare = 1.0F / 3;

/// The sum of fluid/pressure.hpp's mean virial, without its factor.
template <class Kernel>
void virials(const Kernel& VW, const Stretch& at, const Record* x_p, Record* virial) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const RecordLanes i = load_records(x_p + slice.first);
    Lanes sum = 0;
    slice.for_each_neighbor([&](const std::uint32_t* entries) PBF_LAMBDA_INLINE {
      const RecordLanes j = gather(x_p, entries);
      const Vec3Lanes r = i.xyz - j.xyz;
      const Lanes r2 = dot(r, r);
      sum += (i.w + j.w) * (VW.slope(r2) * r2);
    });
    slice.for_each_wall([&](const Vec3Lanes& q) PBF_LAMBDA_INLINE {
      const Vec3Lanes r = i.xyz - q;
      const Lanes r2 = dot(r, r);
      sum += Lanes(1 + kBoundaryShare) * i.w * (VW.slope(r2) * r2);
    });
    store_records(virial + slice.first, i.xyz, sum);
  });
}

/// λ_sum + s_ij, with the exponent known to the compiler; 0: none; −1: any, looked up.
/// Powers end at 1e-24 m²: W falls to nothing towards the support radius, and numbers below
/// float32's normal range (1e-38) cost a processor more than the whole pair.
template <int kExponent, class Kernel>
PBF_INLINE Lanes repelled(const TensileTerms<Kernel>& terms, Lanes lambda_sum, Lanes r2) {
  if constexpr (kExponent == 0) {
    return lambda_sum;
  } else {
    const Lanes root = terms.root.W(r2);
    if constexpr (kExponent == 4) {
      const Lanes square = max(root * root, Lanes(1e-12F));
      return lambda_sum - square * square;
    } else {
      Lanes power = root;
      for (int k = 1; k < terms.exponent; ++k) power = max(power * root, Lanes(1e-24F));
      return lambda_sum - power;
    }
  }
}

/// The coordinate nearest to x from which a particle center may not stray; what is not a number
/// stays so, to be found and reported at the end of the step.
PBF_INLINE Lanes project(Lanes x, Real lower, Real upper) {
  x = select(x < Lanes(lower), Lanes(lower), x);
  return select(x > Lanes(upper), Lanes(upper), x);
}

template <int kExponent, class Kernel>
void corrections(const Kernel& VW,
                 const Stretch& at,
                 const TensileTerms<Kernel>& terms,
                 const Bounds3& centers,
                 const Record* x_lambda,
                 const Record* x,
                 Record* x_star,
                 Record* u) {
  for_each_slice(at, [&](const Slice& slice) PBF_LAMBDA_INLINE {
    const RecordLanes i = load_records(x_lambda + slice.first);
    Vec3Lanes dp = {0, 0, 0};  // in units of slope_unit
    slice.for_each_neighbor([&](const std::uint32_t* entries) PBF_LAMBDA_INLINE {
      const RecordLanes j = gather(x_lambda, entries);
      const Vec3Lanes r = i.xyz - j.xyz;
      const Lanes r2 = dot(r, r);
      dp -= repelled<kExponent>(terms, i.w + j.w, r2) * VW.slope_in_units(r2) * r;
    });
    slice.for_each_wall([&](const Vec3Lanes& q) PBF_LAMBDA_INLINE {
      const Vec3Lanes r = i.xyz - q;
      const Lanes r2 = dot(r, r);
      dp -= repelled<kExponent>(terms, i.w, r2) * VW.slope_in_units(r2) * r;
    });
    const Vec3Lanes start = load_records(x + slice.first).xyz;
    const RecordLanes u_i = load_records(u + slice.first);
    dp = Lanes(VW.slope_unit) * dp;
    const Vec3Lanes moved = i.xyz + dp;
    Vec3Lanes allowed, displacement;
    // The displacement grows by Δp, or ends where a wall holds the particle.
    const auto collide = [&](Lanes Vec3Lanes::*axis, int k) PBF_LAMBDA_INLINE {
      allowed.*axis = project(moved.*axis, centers.lower[k], centers.upper[k]);
      displacement.*axis = select(allowed.*axis == moved.*axis, u_i.xyz.*axis + dp.*axis,
                                  allowed.*axis - start.*axis);
    };
    collide(&Vec3Lanes::x, 0);
    collide(&Vec3Lanes::y, 1);
    collide(&Vec3Lanes::z, 2);
    store_records(x_star + slice.first, allowed, i.w);
    store_records(u + slice.first, displacement, u_i.w + i.w);
  });
}

template <class Kernel>
void corrections(const Kernel& VW,
                 const Stretch& at,
                 const TensileTerms<Kernel>& terms,
                 const Bounds3& centers,
                 const Record* x_lambda,
                 const Record* x,
                 Record* x_star,
                 Record* u) {
  if (terms.exponent == 0) {
    corrections<0>(VW, at, terms, centers, x_lambda, x, x_star, u);
  } else if (terms.exponent == 4) {
    corrections<4>(VW, at, terms, centers, x_lambda, x, x_star, u);
  } else {
    corrections<-1>(VW, at, terms, centers, x_lambda, x, x_star, u);
  }
}

}  // namespace pbf::PBF_ISA_NAMESPACE
