// SPDX-License-Identifier: MIT
//
// Images of blocks and products: moved by a vector, blown up or shrunk, turned.
#pragma once

#include <slant/base/scaling.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/parts/image.hpp>
#include <slant/sets/proximal_step.hpp>

#include <Eigen/Core>

#include <string>
#include <type_traits>
#include <utility>

namespace slant {

// --- shifted -------------------------------------------------------------------------------------

namespace detail {

/// x = z + c.
template <class V>
class shift {
 public:
  static constexpr bool separable = true;

  explicit shift(held<V> c) : c_(std::move(c)) {}

  [[nodiscard]] auto const& centre() const { return slant::local(c_.get()); }

  [[nodiscard]] auto pull(auto const& x) const { return detail::settled(x - centre()); }
  [[nodiscard]] auto push(auto const& z) const { return detail::settled(z + centre()); }
  [[nodiscard]] auto const& pull_direction(auto const& d) const { return d; }
  [[nodiscard]] auto const& push_adjoint(auto const& y) const { return y; }
  [[nodiscard]] auto offset(auto const& y) const { return y.dot(centre()); }
  [[nodiscard]] auto push_gradient(auto const& g) const { return g; }
  [[nodiscard]] auto push_hessian(auto const& h) const { return h; }
  [[nodiscard]] auto push_slant(auto const& g) const { return g; }

  template <class X, class Z>
  [[nodiscard]] scalar_t<X> slop(X const& x, Z const&) const {
    return rounding_band<scalar_t<X>>() * (x.template lpNorm<1>() + centre().template lpNorm<1>());
  }
  [[nodiscard]] auto at(auto const& p) const {
    auto part = p.value(centre());
    using part_type = decltype(part);
    return shift<part_type>(held<part_type>(std::move(part)));
  }

 private:
  held<V> c_;
};

}  // namespace detail

/// Λ + c for a block or a product and a vector of its dimension. Products and long vectors passed
/// as lvalues are referenced. @throws bad_input if c has another size or an entry that is not
/// finite.
template <class C, class V>
  requires set_part<std::remove_cvref_t<C>>
[[nodiscard]] auto shifted(C&& set, V&& c) {
  detail::check_size("size of the shift", index(slant::local(c).size()), slant::dimension_of(set),
                     "the dimension of the set,");
  detail::check_finite("c", c);
  if constexpr (has_static_dimension<std::remove_cvref_t<C>>) {
    using vector_type = point_t<C>;
    return detail::image_of(std::forward<C>(set),
                            detail::shift<vector_type>(held<vector_type>(vector_type(c))));
  } else if constexpr (vector<std::remove_cvref_t<V>>) {
    return detail::image_of(std::forward<C>(set),
                            detail::shift<kept_t<V>>(held<kept_t<V>>(std::forward<V>(c))));
  } else {
    return shifted(std::forward<C>(set), typename std::remove_cvref_t<V>::PlainObject(c));
  }
}

// --- scaled --------------------------------------------------------------------------------------

namespace detail {

/// x = c z.
template <class S>
class dilation {
 public:
  static constexpr bool separable = true;

  explicit dilation(S const& c) : c_(c) {}

  [[nodiscard]] S const& factor() const { return c_; }

  [[nodiscard]] auto pull(auto const& x) const { return detail::settled(x / c_); }
  [[nodiscard]] auto push(auto const& z) const { return detail::settled(z * c_); }
  [[nodiscard]] auto pull_direction(auto const& d) const { return detail::settled(d / c_); }
  [[nodiscard]] auto push_adjoint(auto const& y) const { return detail::settled(y * c_); }
  [[nodiscard]] S offset(auto const&) const { return S(0); }
  [[nodiscard]] auto push_gradient(auto const& g) const { return (g / c_).eval(); }
  [[nodiscard]] auto push_hessian(auto const& h) const { return (h / c_ / c_).eval(); }
  [[nodiscard]] auto push_slant(auto const& g) const { return g; }

  template <class X, class Z>
  [[nodiscard]] S slop(X const&, Z const& z) const {
    return rounding_band<S>() * z.template lpNorm<1>();
  }
  [[nodiscard]] dilation at(auto const&) const { return *this; }

 private:
  S c_;
};

}  // namespace detail

/// c Λ for a finite c > 0. A product passed as an lvalue is referenced.
/// @throws bad_input if c is not a finite number > 0.
template <class S, class C>
  requires set_part<std::remove_cvref_t<C>> && std::convertible_to<S, set_scalar_t<C>>
[[nodiscard]] auto scaled(S const& c, C&& set) {
  using scalar = set_scalar_t<C>;
  auto const factor = static_cast<scalar>(c);
  detail::check_positive("c", factor);
  return detail::image_of(std::forward<C>(set), detail::dilation<scalar>(factor));
}

// --- block scaled --------------------------------------------------------------------------------
//
// A product of blocks of which each is blown up or shrunk by a factor of its own:
//
//     block_scaled(d, Λ) = { D z : z ∈ Λ },   D = diag(d),
//
// d constant on every block, so that a ball stays a ball and projections stay block by block. The
// change of unknowns x = D z that gives all blocks a similar stiffness needs it: see
// problems/equilibrated.hpp.

namespace detail {

/// x = D z, D diagonal.
template <class S>
class block_dilation {
 public:
  static constexpr bool separable = true;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  explicit block_dilation(vector_type d) : d_(std::move(d)) {}

  [[nodiscard]] auto pull(auto const& x) const { return x.cwiseQuotient(d_); }
  [[nodiscard]] auto push(auto const& z) const { return z.cwiseProduct(d_); }
  [[nodiscard]] auto pull_direction(auto const& v) const { return pull(v); }
  [[nodiscard]] auto push_adjoint(auto const& y) const { return push(y); }
  [[nodiscard]] S offset(auto const&) const { return S(0); }
  /// What it is on the block at p.
  [[nodiscard]] dilation<S> at(auto const& p) const {
    return dilation<S>(p.size() > 0 ? d_(p.component(0)) : S(1));
  }

 private:
  vector_type d_;
};

/// Throws bad_input unless d has a finite factor > 0 for each unknown, the same all over a block.
template <class S, class C>
void check_block_factors(Eigen::Matrix<S, Eigen::Dynamic, 1> const& d, C const& set) {
  check_size("d", index(d.size()), slant::dimension_of(set), "the dimension of the set,");
  slant::visit_blocks(set, [&](auto const& block, auto const& p) {
    for (index j = 0; j < p.size(); ++j) {
      S const& factor = d(p.component(j));
      if (!(factor > S(0) && is_finite(factor))) {
        throw bad_input("d(" + std::to_string(p.component(j)) + ")", show(factor),
                        "a finite number > 0");
      }
      if (!whole_space<std::remove_cvref_t<decltype(block)>> && factor != d(p.component(0))) {
        throw bad_input("d(" + std::to_string(p.component(j)) + ")", show(factor),
                        show(d(p.component(0))) + " as for the other unknowns of its block");
      }
    }
  });
}

}  // namespace detail

/// x ↦ φ(x/c) for a block φ that is no set. F is `Function const&` (referenced) or a function type
/// (owned).
template <class F>
class scaled_function : public detail::static_size<static_dimension_of<F>> {
 public:
  using scalar = set_scalar_t<F>;

  scaled_function(held<F> φ, scalar const& c) : φ_(std::move(φ)), c_(c) {}

  [[nodiscard]] index size() const { return slant::dimension_of(φ_.get()); }

  /// c prox_{(ρ/c²)φ}(z/c).
  template <class S, class Z>
  [[nodiscard]] auto prox(S const& ρ, Z const& z) const {
    return (slant::prox(φ_.get(), S(ρ / c_ / c_), (z / c_).eval()) * c_).eval();
  }
  template <class X>
  [[nodiscard]] scalar_t<X> value(X const& x) const {
    return φ_.get().value((x / c_).eval());
  }
  /// φ*(c v).
  template <class V>
  [[nodiscard]] scalar_t<V> conjugate(V const& v) const
    requires has_conjugate<std::remove_cvref_t<F>, point_t<F>>
  {
    return φ_.get().conjugate((v * c_).eval());
  }
  template <class S, class Z>
  [[nodiscard]] auto slant(S const& ρ, Z const& z) const
    requires has_prox_slant<std::remove_cvref_t<F>, point_t<F>>
  {
    return φ_.get().slant(S(ρ / c_ / c_), (z / c_).eval());
  }
  template <class S, class Z>
  [[nodiscard]] block_state state(S const& ρ, Z const& z) const
    requires has_prox_state<std::remove_cvref_t<F>, point_t<F>>
  {
    return φ_.get().state(S(ρ / c_ / c_), (z / c_).eval());
  }

 private:
  held<F> φ_;
  scalar c_;
};

/// x ↦ φ(D⁻¹x) for a separable function; made by block_scaled.
template <class F, class S>
class block_scaled_function : public detail::static_size<Eigen::Dynamic> {
 public:
  using scalar = S;

  block_scaled_function(held<F> φ, Eigen::Matrix<S, Eigen::Dynamic, 1> d)
      : φ_(std::move(φ)), map_(std::move(d)) {}

  [[nodiscard]] index size() const { return slant::dimension_of(φ_.get()); }
  [[nodiscard]] index block_count() const { return slant::block_count(φ_.get()); }

  /// x = prox_{ρφ∘D⁻¹}(z), ρ > 0; x may be z.
  template <class Z, class X>
  void prox(S const& ρ, Z const& z, X&& x) const {
    visit([&](auto const& block, auto const& p) {
      p.put(x, slant::prox(block, ρ, detail::argument_of(block, p, z)));
    });
  }
  template <class X>
  [[nodiscard]] S value(X const& x) const {
    S sum(0);
    visit([&](auto const& block, auto const& p) {
      sum += slant::function_value(block, detail::argument_of(block, p, x));
    });
    return sum;
  }

  /// f(block, place) for every block, functions and sets.
  template <class V>
  void visit(V&& f) const {
    φ_.get().visit([&](auto const& block, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      auto const map = map_.at(p);
      if constexpr (function_part<block_type>) {
        f(scaled_function<block_type const&>(held<block_type const&>(block), map.factor()), p);
      } else {
        f(image_set<block_type, std::remove_const_t<decltype(map)>>(block, map), p);
      }
    });
  }

 private:
  held<F> φ_;
  detail::block_dilation<S> map_;
};

/// { D z : z ∈ set }, d one factor for each unknown; of a function that is no set x ↦ φ(D⁻¹x). What
/// is passed as an lvalue is referenced.
/// @throws bad_input unless d has the size of the set, with finite factors > 0 that are the same
/// all over a block (a block that is the whole space may have different ones).
template <class S, class C>
  requires has_visit<std::remove_cvref_t<C>> &&
           (set_part<std::remove_cvref_t<C>> || function_part<std::remove_cvref_t<C>>)
[[nodiscard]] auto block_scaled(Eigen::Matrix<S, Eigen::Dynamic, 1> d, C&& set) {
  detail::check_block_factors(d, set);
  held<kept_t<C>> part(std::forward<C>(set));
  if constexpr (function_part<std::remove_cvref_t<C>>) {
    return block_scaled_function<kept_t<C>, S>(std::move(part), std::move(d));
  } else {
    using map = detail::block_dilation<S>;
    return image_set<kept_t<C>, map>(std::move(part), map(std::move(d)));
  }
}

// --- rotated -------------------------------------------------------------------------------------

namespace detail {

/// x = Q z.
template <class S, int N>
class rotation {
 public:
  using matrix_type = Eigen::Matrix<S, N, N>;
  static constexpr bool separable = false;

  explicit rotation(matrix_type const& q) : q_(q) {}

  [[nodiscard]] auto pull(auto const& x) const { return (q_.transpose() * x).eval(); }
  [[nodiscard]] auto push(auto const& z) const { return (q_ * z).eval(); }
  [[nodiscard]] auto pull_direction(auto const& d) const { return pull(d); }
  [[nodiscard]] auto push_adjoint(auto const& y) const { return pull(y); }
  [[nodiscard]] S offset(auto const&) const { return S(0); }
  [[nodiscard]] auto push_gradient(auto const& g) const { return (q_ * g).eval(); }
  [[nodiscard]] matrix_type push_hessian(matrix_type const& h) const { return push_slant(h); }
  /// Q G Qᵀ, symmetric to the last bit.
  [[nodiscard]] matrix_type push_slant(matrix_type const& g) const {
    matrix_type const r = q_ * g * q_.transpose();
    return (r + r.transpose()) / S(2);
  }

  template <class X, class Z>
  [[nodiscard]] S slop(X const& x, Z const&) const {
    return rounding_band<S>() * S(N * N) * x.template lpNorm<1>();
  }

 private:
  matrix_type q_;
};

}  // namespace detail

/// QΛ for a block of dimension N and an orthogonal N × N matrix Q: rotated(ellipse{a, b}, Q) has
/// its axes along the columns of Q.
/// @throws bad_input if QᵀQ differs from I by more than 8 N ε in some entry, ε the machine epsilon.
template <set_block C, class Q>
[[nodiscard]] auto rotated(C const& set, Q const& matrix) {
  using S = set_scalar_t<C>;
  constexpr int n = C::dimension;
  using matrix_type = Eigen::Matrix<S, n, n>;
  matrix_type const q = matrix;
  matrix_type const defect = q.transpose() * q - matrix_type::Identity();
  S const largest = defect.cwiseAbs().maxCoeff();
  if (!(largest <= detail::rounding_band<S>() * S(n)) || defect.hasNaN()) {
    throw bad_input("Q", std::string("max |QᵀQ − I| = ").append(detail::show(largest)),
                    "an orthogonal matrix");
  }
  return detail::image_of(set, detail::rotation<S, n>(q));
}

}  // namespace slant
