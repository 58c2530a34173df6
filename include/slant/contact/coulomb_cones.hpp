// SPDX-License-Identifier: MIT
//
// Coulomb's law as a family of convex problems over cones [Acary, Cadoux, Lemaréchal, Malick 2011]:
// with the shifts s as parameters of
//
//     min ½ λᵀAλ − (b − s)ᵀλ   over   ‖λ_t,i‖ ≤ μᵢ λ_ν,i,           P(λ) = μ‖u_t‖,
//
// s acting on the normal components. The gradient A λ − b is u in local coordinates, its normal
// part the gap and its tangential part the slip with the opposite sign, so that a fixed point has
// u + μ‖u_t‖ n ∈ K_μ*: de Saxcé's form of Coulomb's law, see contact/friction_problem.hpp.
//
// Multipliers are ordered contact by contact here, [ν, t₁(, t₂)].
#pragma once

#include <slant/contact/friction_coefficient.hpp>
#include <slant/contact/load_step.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/methods/separable_qp.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <Eigen/SparseCore>

#include <type_traits>
#include <utility>
#include <vector>

namespace slant::contact {

/// The family at the top of this file, for methods/successive_approximations.hpp. Refers to the
/// dual problem, whose slip bounds have no meaning here; not movable.
template <class Dual>
class coulomb_cones {
 public:
  using vector_type = typename Dual::vector_type;
  using scalar = scalar_t<vector_type>;
  using sparse_type = typename Dual::sparse_type;
  static_assert(std::is_same_v<typename Dual::friction_type, friction_line> ||
                    std::is_same_v<typename Dual::friction_type, friction_disc>,
                "coulomb_cones: the dual problem must have the law friction_line or friction_disc");
  /// Components of a contact.
  static constexpr int dimension =
      std::is_same_v<typename Dual::friction_type, friction_line> ? 2 : 3;

  /// Throws bad_input unless there is a coefficient for every contact node, finite and >= 0.
  coulomb_cones(Dual& problem, vector_type μ)
      : problem_(&problem),
        μ_(detail::one_per_contact(std::move(μ), problem.b().size() / dimension)),
        shift_(vector_type::Zero(μ_.size())),
        C_(by_contacts(problem.constraints(), μ_.size())),
        q_(-by_contacts(problem.b())),
        b_(-q_),
        set_(power(second_order_cone<dimension, scalar>{}, μ_)),
        qp_(problem.a(C_), b_, set_) {}
  coulomb_cones(coulomb_cones const&) = delete;
  coulomb_cones& operator=(coulomb_cones const&) = delete;

  /// The convex problem for the present shifts.
  [[nodiscard]] auto const& qp() const { return qp_; }
  /// B with its rows contact by contact, for preconditioners.
  [[nodiscard]] sparse_type const& constraints() const { return C_; }
  [[nodiscard]] vector_type const& mu() const { return μ_; }
  /// What u = A λ + q is without forces, no shift in it: −b contact by contact; changes in place.
  [[nodiscard]] vector_type const& q() const { return q_; }
  [[nodiscard]] vector_type const& b() const { return b_; }
  [[nodiscard]] auto const& set() const { return set_; }
  [[nodiscard]] vector_type zero() const { return problem_->zero(); }

  /// λ = (λ_ν, λ_t) of the dual problem, contact by contact.
  [[nodiscard]] vector_type by_contacts(vector_type const& λ) const {
    vector_type x(λ.size());
    for (index row = 0; row < λ.size(); ++row) x(place_of(row, μ_.size())) = λ(row);
    return x;
  }
  /// And back.
  [[nodiscard]] vector_type by_directions(vector_type const& x) const {
    vector_type λ(x.size());
    for (index row = 0; row < x.size(); ++row) λ(row) = x(place_of(row, μ_.size()));
    return λ;
  }

  /// New data, as dual::update; slip bounds among them are without effect.
  void update(load_step<scalar> step) {
    problem_->update(std::move(step));
    q_ = -by_contacts(problem_->b());
    assign(shift_);
  }

  [[nodiscard]] index parameter_count() const { return μ_.size(); }
  /// The present shifts; 0 before there are any.
  void guess(vector_type const&, vector_type& s) const { s = shift_; }
  /// μ‖u_t‖ of the gradient r of qp().
  void parameters(vector_type const&, vector_type const& r, vector_type& s) const {
    for (index i = 0; i < μ_.size(); ++i) {
      s(i) = μ_(i) * norm(r.template segment<dimension - 1>(dimension * i + 1));
    }
  }
  /// The shifts of qp(); a negative one becomes 0.
  void assign(vector_type& s) {
    for (index i = 0; i < μ_.size(); ++i) {
      if (!(s(i) > scalar(0))) s(i) = scalar(0);
      b_(dimension * i) = -q_(dimension * i) - s(i);
      b_.template segment<dimension - 1>(dimension * i + 1) =
          -q_.template segment<dimension - 1>(dimension * i + 1);
    }
    if (&s != &shift_) shift_ = s;
  }

 private:
  /// Where row `row` of m nodes stands contact by contact.
  static index place_of(index row, index m) {
    constexpr index t = dimension - 1;
    if (row < m) return dimension * row;
    return dimension * ((row - m) / t) + 1 + (row - m) % t;
  }
  static sparse_type by_contacts(sparse_type const& B, index m) {
    std::vector<Eigen::Triplet<scalar>> entries;
    entries.reserve(static_cast<std::size_t>(B.nonZeros()));
    for (index j = 0; j < B.outerSize(); ++j) {
      for (typename sparse_type::InnerIterator e(B, j); e; ++e) {
        entries.emplace_back(static_cast<int>(place_of(e.row(), m)), static_cast<int>(j),
                             e.value());
      }
    }
    sparse_type C(B.rows(), B.cols());
    C.setFromTriplets(entries.begin(), entries.end());
    return C;
  }

  using set_type =
      decltype(power(second_order_cone<dimension, scalar>{}, std::declval<vector_type const&>()));
  using qp_type =
      separable_qp<decltype(std::declval<Dual const&>().a(std::declval<sparse_type const&>())),
                   vector_type const&, set_type const&>;

  Dual* problem_;
  vector_type μ_;
  vector_type shift_;
  sparse_type C_;
  vector_type q_;
  vector_type b_;
  set_type set_;
  qp_type qp_;
};

}  // namespace slant::contact
