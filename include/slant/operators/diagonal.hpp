// SPDX-License-Identifier: MIT
//
// A diagonal matrix. Unlike other matrices its laws can be verified at no cost, and are:
//
//     auto D = slant::diagonal(d);                              // self-adjoint
//     auto P = slant::diagonal<slant::positive_definite>(d);    // throws unless all d_i > 0
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/capabilities.hpp>

#include <type_traits>
#include <utility>

namespace slant {

/// y_i = d_i x_i. D is `Vector const&` (referenced) or a vector type (owned).
template <class D, law_set L = slant::laws<slant::self_adjoint>>
class diagonal_operator {
  using vector_type = std::remove_cvref_t<D>;

 public:
  static constexpr char const* symbol = "diag";
  using scalar = scalar_t<vector_type>;
  static constexpr law_set laws = L | slant::laws<slant::self_adjoint>;

  explicit diagonal_operator(held<D> d) : d_(std::move(d)) {}

  [[nodiscard]] index rows() const { return entries().size(); }
  [[nodiscard]] index cols() const { return entries().size(); }
  /// The vector d.
  [[nodiscard]] decltype(auto) entries() const { return slant::local(d_.get()); }
  /// The vector d, if it is owned; that its new entries keep the laws is for the caller to know.
  [[nodiscard]] decltype(auto) entries()
    requires(!std::is_reference_v<D>)
  {
    return slant::local(d_.get());
  }

  void apply(has_scalar<scalar> auto const& x, auto& y) const {
    slant::local(y).noalias() = entries().asDiagonal() * slant::local(x);
  }
  void apply_add(scalar α, has_scalar<scalar> auto const& x, auto& y) const {
    // α D could leave the range of the scalar where α (D x) does not.
    slant::local(y).noalias() += α * (entries().asDiagonal() * slant::local(x));
  }
  void diagonal(has_scalar<scalar> auto& d) const { slant::local(d) = entries(); }
  void columns(index first, has_scalar<scalar> auto& y) const {
    slant::local(y).setZero();
    for (index j = 0; j < slant::local(y).cols(); ++j) {
      slant::local(y)(first + j, j) = entries()[first + j];
    }
  }
  /// diag(1/d), where the laws exclude zeros. Throws bad_input naming an entry so small that its
  /// reciprocal is not finite.
  [[nodiscard]] auto inverse() const
    requires(laws.contains(law::positive_definite))
  {
    using plain = plain_t<local_t<vector_type>>;
    plain reciprocal = entries().cwiseInverse();
    for (index i = 0; i < rows(); ++i) {
      if (!detail::is_finite(scalar(reciprocal[i]))) {
        throw bad_input("d", detail::show(scalar(entries()[i])),
                        "a number with a finite reciprocal")
            .at(i);
      }
    }
    return diagonal_operator<plain, slant::laws<slant::self_adjoint, slant::positive_definite>>{
        held<plain>(std::move(reciprocal))};
  }

 private:
  held<D> d_;
};

namespace detail {

template <law_set L, class D>
void require_diagonal_laws(D const& d) {
  using S = typename D::Scalar;
  for (index i = 0; i < d.size(); ++i) {
    S const value = d[i];
    auto const require = [&](bool holds, char const* expectation) {
      if (!holds) throw bad_input("d", show(value), expectation).at(i);
    };
    require(is_finite(value), "a finite number");
    if constexpr (L.contains(law::positive_definite)) require(value > S(0), "a number > 0");
    if constexpr (L.contains(law::positive_semidefinite)) require(value >= S(0), "a number >= 0");
    if constexpr (L.contains(law::projector)) require(value == S(0) || value == S(1), "0 or 1");
    if constexpr (L.contains(law::firmly_nonexpansive)) {
      require(value >= S(0) && value <= S(1), "a number in [0, 1]");
    }
  }
}

}  // namespace detail

/// diag(d), referenced if d is an lvalue. Throws bad_input if an entry is not finite or breaks one
/// of the laws.
template <law... L, class D>
  requires scalar<scalar_t<std::remove_cvref_t<D>>> &&
           (has_local<std::remove_cvref_t<D>> || has_like<std::remove_cvref_t<D>>)
[[nodiscard]] auto diagonal(D&& d) {
  using plain = plain_t<std::remove_cvref_t<D>>;
  using kept = std::conditional_t<std::is_same_v<plain, std::remove_cvref_t<D>>, kept_t<D>, plain>;
  diagonal_operator<kept, slant::laws<L...>> a{held<kept>(std::forward<D>(d))};
  detail::require_diagonal_laws<slant::laws<L...>>(a.entries());
  return a;
}

}  // namespace slant
