// SPDX-License-Identifier: MIT
//
// Functions of two slanting functions, block by block: y ↦ κ_i(F(y)_i, G(y)_i), and their chain
// rule P F° + Q G° with block diagonal P and Q.
#pragma once

#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>
#include <slant/sets/block_diagonal_slant.hpp>
#include <slant/sets/detail/block_list.hpp>
#include <slant/slanting/detail/assembled_operator.hpp>
#include <slant/slanting/detail/evaluated_pair.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

/// P A + Q B.
struct block_weighted_rule {
  template <class P, class Q, class A, class B>
  [[nodiscard]] auto operator()(P const& p, Q const& q, A const& a, B const& b) const {
    using left = product_operator<P const&, A const&>;
    using right = product_operator<Q const&, B const&>;
    return sum_operator<left, right>(held<left>(left(p, a)), held<right>(right(q, b)));
  }
};

/// κ has `dimension` N, `scalar`, value(a, b) → N numbers, slants(a, b) → {∂κ/∂a, ∂κ/∂b} and
/// with(parameters…).
template <class Kernel, class F, class G>
class blockwise_pair : public evaluated_pair<F, G> {
  using pair = evaluated_pair<F, G>;
  static constexpr int n = Kernel::dimension;
  using scalar = typename Kernel::scalar;
  using blocks_type = block_diagonal_slant<scalar, n, consecutive, false, law_set{}>;

 public:
  using pair::left;
  using pair::right;
  using pair::rows;

  /// @throws bad_input unless F and G have the sizes of the list.
  blockwise_pair(listed_blocks<Kernel> kernels, held<F> f, held<G> g)
      : pair(std::move(f), std::move(g)), kernels_(std::move(kernels)) {
    require_equal_sizes("f.rows()", rows(), n * kernels_.size(), "the components of all blocks");
  }

  /// New parameters for all blocks; does not allocate.
  template <class... Params>
    requires takes_parameters<Kernel, Params...>
  void update(Params const&... params) {
    kernels_.update(params...);
  }

  template <class Y, class V, class W>
    requires pair::template
  usable<plain_t<Y>> void value(Y const& y, V& v, W& w) const {
    this->evaluate_parts(y, w);
    for_each(w, [&](auto const& kernel, index i, auto const& a, auto const& b) {
      place_of(i).put(slant::local(v), kernel.value(a, b));
    });
  }
  template <class Y>
    requires pair::template
  usable<plain_t<Y>> [[nodiscard]] auto slant(Y const& y) const {
    auto w = this->workspace(y);
    this->evaluate_parts(y, w);
    assembled_operator s(block_weighted_rule{}, blocks_type(kernels_.size()),
                         blocks_type(kernels_.size()), left().slant(y), right().slant(y));
    set_slants(s, w);
    return s;
  }
  template <class Y, class S, class W>
  void slant(Y const& y, S& s, W& w) const {
    this->evaluate_parts(y, w);
    slant_after_value(y, s, w);
  }
  template <class Y, class S, class W>
  void slant_after_value(Y const& y, S& s, W& w) const {
    set_slants(s, w);
    this->update_parts(y, s, w);
  }

 private:
  [[nodiscard]] auto place_of(index i) const {
    return block_place<n, consecutive>(i, kernels_.size());
  }
  /// f(kernel, number, its part of F(y), its part of G(y)).
  template <class W, class Function>
  void for_each(W const& w, Function const& f) const {
    for (index i = 0; i < kernels_.size(); ++i) {
      f(kernels_[i], i, place_of(i).value(w.f), place_of(i).value(w.g));
    }
  }
  template <class S, class W>
  void set_slants(S& s, W const& w) const {
    for_each(w, [&](auto const& kernel, index i, auto const& a, auto const& b) {
      auto const [at_f, at_g] = kernel.slants(a, b);
      s.template part<0>().assign(i, at_f);
      s.template part<1>().assign(i, at_g);
    });
  }

  listed_blocks<Kernel> kernels_;
};

}  // namespace slant::detail
