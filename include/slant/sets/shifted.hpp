// SPDX-License-Identifier: MIT
//
// Sets moved by a vector: shifted(ball<2>{g}, c) is the disc around c.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/sets/parts/image.hpp>

#include <type_traits>
#include <utility>

namespace slant {

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

}  // namespace slant
