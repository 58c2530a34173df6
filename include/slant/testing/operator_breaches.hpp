// SPDX-License-Identifier: MIT
//
// The laws of linear operators, sampled; needs no test framework (laws.hpp does).
//
//     A(αx + βy) = αAx + βAy,   A x into a y full of NaN,   A x with a used or copied workspace, or
//     beside another thread,   the laws that the type declares,   and of each capability it has:
//     adjoint, accumulation, diagonal, columns, several right-hand sides, inverse.
//
// Sampling proves nothing, but it looks in the right places: laws about ⟨Ax, x⟩ are also tried in
// the directions at the two ends of the spectrum. All tolerances are multiples of ε ‖A‖ ‖x‖, with
// ‖A‖ estimated from samples, so units do not matter. Operators that solve with an ill-conditioned
// matrix may need options.roundings of the order of the condition.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/testing/parts/operator_sampler.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace slant::testing::detail {

// --- concurrency ---------------------------------------------------------------------------------
//
// One operator applied from two threads at the same time, each with its own workspace.

/// Applies to `other` as long as it lives, and counts.
template <class V>
class applied_beside {
 public:
  applied_beside(operator_probe<V> const& a, V const& other, V result)
      : thread_([this, &a, &other, y = std::move(result)]() mutable {
          auto w = a.workspace(other);
          while (!stop_.load(std::memory_order_relaxed)) {
            a.apply_with(other, y, w);
            finished_.fetch_add(1, std::memory_order_relaxed);
          }
        }) {}
  ~applied_beside() {
    stop_ = true;
    thread_.join();
  }
  applied_beside(applied_beside const&) = delete;
  applied_beside& operator=(applied_beside const&) = delete;

  /// Applications that are finished.
  [[nodiscard]] long finished() const { return finished_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> stop_ = false;
  std::atomic<long> finished_ = 0;
  std::thread thread_;  // last: it uses the others from its first moment
};

/// The checks of one operator; `size` is an estimate of ‖A‖, which check_overwriting makes.
template <class V>
struct operator_laws {
  using S = scalar_t<V>;
  using matrix = typename operator_probe<V>::matrix;

  operator_probe<V> const& a;
  operator_sampler<V> sampler;
  S size{0};

  // --- capability laws ---------------------------------------------------------------------------

  /// ⟨Ax, y⟩ = ⟨x, Aᵀy⟩; the adjoint overwrites.
  void check_adjoint() {
    if (!a.apply_adjoint) return;
    for (int k = 0; k < a.options.samples; ++k) {
      V const x = sampler.random(a.cols);
      V const y = sampler.random(a.rows);
      S const difference = S(slant::inner_product(sampler.image(x), y)) -
                           S(slant::inner_product(x, sampler.adjoint_image(y)));
      sampler.expect_small("adjoint, <Ax, y> = <x, A'y>", difference,
                           S(size * slant::norm(x) * slant::norm(y)));
    }
  }

  /// apply_add(α, x, y) = y + α A x and apply_adjoint_add(α, x, y) = y + α Aᵀx.
  void check_accumulation() {
    for (S const& α : {S(1), S(S(-3) / S(4)), S(0)}) {
      auto const check = [&](char const* law, auto const& add, V const& x, V const& start,
                             V const& image) {
        V result = start;
        add(α, x, result);
        V sum = start;
        slant::local(sum) += α * slant::local(image);
        sampler.expect_close(law, result, sum, S(size * slant::norm(x) + slant::norm(start)));
      };
      V const x = sampler.random(a.cols);
      V const y = sampler.random(a.rows);
      if (a.apply_add) {
        check("apply_add(c, x, y) = y + c A x", a.apply_add, x, y, sampler.image(x));
      }
      if (a.apply_adjoint_add) {
        check("apply_adjoint_add(c, x, y) = y + c A'x", a.apply_adjoint_add, y, x,
              sampler.adjoint_image(y));
      }
    }
  }

  /// diagonal_i = ⟨A e_i, e_i⟩.
  void check_diagonal() {
    if (!a.diagonal) return;
    V d = sampler.garbage(a.rows);
    a.diagonal(d);
    if (slant::local(d).size() != a.rows) {
      sampler.report("diagonal", "the result has a wrong size");
      return;
    }
    for (index const i : sampler.places(a.rows, 64)) {
      V const ae = sampler.image(sampler.unit(a.cols, i));
      sampler.expect_small("diagonal_i = <A e_i, e_i>", S(slant::local(ae)[i] - slant::local(d)[i]),
                           size);
    }
  }

  /// The columns of `result` are A applied to the columns of `x`.
  void expect_images(char const* law, matrix const& x, matrix const& result) {
    if (result.rows() != a.rows || result.cols() != x.cols()) {
      sampler.report(law, "the result has a wrong size");
      return;
    }
    for (index j = 0; j < x.cols(); ++j) {
      V one = sampler.garbage(a.cols);
      slant::local(one) = x.col(j);
      V column = sampler.garbage(a.rows);
      slant::local(column) = result.col(j);
      sampler.expect_close(law, column, sampler.image(one), S(size * slant::norm(one)));
    }
  }

  /// columns(first, Y)_k = A e_{first + k}, and A [x₁ … x_k] = [A x₁ … A x_k] in either storage
  /// order.
  void check_columns() {
    S const nan = std::numeric_limits<S>::quiet_NaN();
    if (a.columns) {
      index const k = std::min<index>(3, a.cols);
      for (index const first : {index(0), a.cols - k}) {
        matrix y = matrix::Constant(a.rows, k, nan);
        a.columns(first, y);
        matrix const units = matrix::Identity(a.cols, a.cols).middleCols(first, k);
        expect_images("columns(j)_k = A e_{j+k}", units, y);
      }
    }
    auto const check_many = [&](char const* law, auto const& apply_to_many) {
      if (!apply_to_many) return;
      matrix x(a.cols, 3);
      for (index j = 0; j < x.cols(); ++j) x.col(j) = slant::local(sampler.random(a.cols));
      matrix y = matrix::Constant(a.rows, x.cols(), nan);
      apply_to_many(x, y);
      expect_images(law, x, y);
    };
    check_many("A [x1 x2 x3] = [A x1, A x2, A x3]", a.apply_to_many);
    check_many("stored by rows, A [x1 x2 x3] = [A x1, A x2, A x3]", a.apply_to_many_by_rows);
  }

  /// inverse()(A x) = x, up to the condition of A.
  void check_inverse() {
    if (!a.inverse) return;
    for (int k = 0; k < a.options.samples; ++k) {
      V const x = sampler.random(a.cols);
      V const ax = sampler.image(x);
      V back = sampler.garbage(a.cols);
      a.inverse(ax, back);
      // ‖A⁻¹‖ is at least this; the product with ‖A‖ estimates the condition.
      S const image_size = slant::norm(ax);
      S const inverse_size = image_size > S(0) ? S(slant::norm(x) / image_size) : S(0);
      sampler.expect_close("inverse()(A x) = x", back, x,
                           S((S(1) + size * inverse_size) * slant::norm(x)));
    }
  }

  // --- declared laws -----------------------------------------------------------------------------

  /// x ↦ Aᵀx by what there is: self-adjointness, apply_adjoint, or all columns of a small A. Else
  /// empty.
  [[nodiscard]] std::function<V(V const&)> adjoint_map() {
    constexpr index small = 200;
    if (a.laws.contains(law::self_adjoint)) return [&](V const& x) { return sampler.image(x); };
    if (a.apply_adjoint) return [&](V const& x) { return sampler.adjoint_image(x); };
    if (a.cols > small) return {};
    std::vector<V> columns;
    for (index j = 0; j < a.cols; ++j) columns.push_back(sampler.image(sampler.unit(a.cols, j)));
    return [columns = std::move(columns)](V const& x) {
      V y = x;
      for (std::size_t j = 0; j < columns.size(); ++j) {
        slant::local(y)[static_cast<index>(j)] = slant::inner_product(columns[j], x);
      }
      return y;
    };
  }

  /// Directions in which to try laws about ⟨Ax, x⟩: random ones, unit vectors, and the ends of the
  /// spectrum of (A + Aᵀ)/2, where that can be applied.
  [[nodiscard]] std::vector<V> telling_directions() {
    std::vector<V> directions;
    for (int k = 0; k < a.options.samples; ++k) directions.push_back(sampler.random(a.cols));
    for (index const i : sampler.places(a.cols, 16)) directions.push_back(sampler.unit(a.cols, i));
    if (auto const adjoint_image = adjoint_map()) {
      auto const symmetric_part = [&](V const& x) {
        V y = sampler.image(x);
        V const z = adjoint_image(x);
        slant::local(y) = (slant::local(y) + slant::local(z)) / S(2);
        return y;
      };
      for (V& x :
           extreme_directions(symmetric_part, sampler.random(a.cols), a.options.lanczos_steps)) {
        directions.push_back(std::move(x));
      }
    }
    return directions;
  }

  /// Every law that `a` declares, in one direction x. `size` is an estimate of ‖A‖; y is any other
  /// direction.
  void check_laws_along(V const& x, V const& y) {
    V const ax = sampler.image(x);
    S const length = slant::norm(x);
    S const form = slant::inner_product(ax, x);
    S const scale = size * length * length;
    if (a.laws.contains(law::self_adjoint)) {
      S const difference =
          S(slant::inner_product(ax, y)) - S(slant::inner_product(x, sampler.image(y)));
      sampler.expect_small("self_adjoint, <Ax, y> = <x, Ay>", difference,
                           S(size * length * slant::norm(y)));
    }
    if (a.laws.contains(law::positive_definite)) {
      // Zero up to rounding is not positive: here rounding counts against the operator.
      S const rounding =
          std::numeric_limits<S>::epsilon() * S(8 + int(std::min<index>(a.cols, 1000))) * scale;
      if (!(form > rounding)) sampler.report("positive_definite, <Ax, x> > 0", -form, S(0));
    } else if (a.laws.contains(law::positive_semidefinite)) {
      S const bound = sampler.allowed(scale);
      if (!(form >= -bound)) {
        sampler.report("positive_semidefinite, <Ax, x> >= 0", -form, bound);
      }
    }
    if (a.laws.contains(law::projector)) {
      sampler.expect_close("projector, A A x = A x", sampler.image(ax), ax,
                           S(size * (S(1) + size) * length));
    }
    if (a.laws.contains(law::firmly_nonexpansive)) {
      S const square = slant::inner_product(ax, ax);
      S const bound = sampler.allowed(scale * (S(1) + size));
      if (!(form >= square - bound)) {
        sampler.report("firmly_nonexpansive, <Ax, x> >= |Ax|^2", square - form, bound);
      }
    }
  }

  /// `size` is an estimate of ‖A‖.
  void check_declared_laws() {
    if (a.laws == law_set{} || a.cols == 0) return;
    auto const directions = telling_directions();
    for (std::size_t k = 0; k < directions.size(); ++k) {
      check_laws_along(directions[k], directions[(k + 1) % directions.size()]);
    }
  }

  /// A x is the same while another thread applies A to something else. The two must meet, and
  /// often: an application counts where one of the other thread's ended during it. On a busy
  /// machine with one free core they meet only where the system interrupts one of them, so time is
  /// limited as well.
  void check_concurrency() {
    constexpr int meetings = 2000;
    constexpr std::chrono::milliseconds patience(50);
    std::string const law = "repeatability, beside another thread with its own workspace";

    V const x = sampler.random(a.cols);
    V const other = sampler.random(a.cols);
    V const expected = sampler.image(x);
    S const image_size = size * slant::norm(x);
    auto w = a.workspace(x);
    V y = sampler.garbage(a.rows);

    applied_beside<V> const beside(a, other, y);
    while (beside.finished() == 0) std::this_thread::yield();
    auto const end = std::chrono::steady_clock::now() + patience;
    for (int met = 0; met < meetings && std::chrono::steady_clock::now() < end;) {
      long const before = beside.finished();
      a.apply_with(x, y, w);
      met += beside.finished() != before;
      sampler.expect_close(law, y, expected, image_size);
      if (sampler.has_found(law)) return;
    }
  }

  /// Sizes and overwriting. Returns an estimate of ‖A‖, NaN if what follows would make no sense.
  [[nodiscard]] S check_overwriting() {
    S const nan = std::numeric_limits<S>::quiet_NaN();
    S largest(0);
    for (int k = 0; k < std::max(a.options.samples, 1); ++k) {
      V const x = sampler.random(a.cols);
      V y = sampler.constant(a.rows, S(0));
      a.apply(x, y);
      if (slant::local(y).size() != a.rows) {
        sampler.report("apply", "the result does not have rows() entries");
        return nan;
      }
      if (!slant::local(y).allFinite()) {
        sampler.report("apply", "the result of a finite vector is NaN or infinite");
        return nan;
      }
      if (!slant::local(sampler.image(x)).allFinite()) {
        sampler.report("overwriting", "a y full of NaN on entry leaves NaN in A x");
        return nan;
      }
      V from_ones = sampler.constant(a.rows, S(1));
      a.apply(x, from_ones);
      S const image_size = slant::norm(y);
      sampler.expect_close("overwriting, A x does not depend on y", from_ones, y, image_size);
      S const length = slant::norm(x);
      if (length > S(0)) largest = std::max<S>(largest, image_size / length);
    }
    return largest;
  }

  void check_linearity() {
    S const α(3);
    S const β = S(-7) / S(4);
    for (int k = 0; k < a.options.samples; ++k) {
      V const x = sampler.random(a.cols);
      V const y = sampler.random(a.cols);
      V z = x;
      slant::local(z) = α * slant::local(x) + β * slant::local(y);
      V sum = sampler.image(x);
      V const ay = sampler.image(y);
      slant::local(sum) = α * slant::local(sum) + β * slant::local(ay);
      sampler.expect_close("linearity, A(cx + dy) = cAx + dAy", sampler.image(z), sum,
                           S(size * (S(3) * slant::norm(x) + S(2) * slant::norm(y))));
    }
  }

  /// The result depends on x alone, not on earlier uses of the workspace.
  void check_repeatability() {
    V const x = sampler.random(a.cols);
    V const other = sampler.random(a.cols);
    V const expected = sampler.image(x);
    S const length = slant::norm(x);
    auto w = a.workspace(x);
    V y = sampler.garbage(a.rows);
    a.apply_with(other, y, w);
    a.apply_with(x, y, w);
    sampler.expect_close("repeatability, with a used workspace", y, expected, S(size * length));
    auto copied = w;
    a.apply_with(other, y, w);
    a.apply_with(x, y, copied);
    sampler.expect_close("repeatability, with a copied workspace", y, expected, S(size * length));
    a.apply_with(x, y, w);
    sampler.expect_close("repeatability, with a workspace whose copy was used", y, expected,
                         S(size * length));
  }
};

template <class V>
[[nodiscard]] std::vector<breach> operator_breaches_of(operator_probe<V> const& a,
                                                       V const& prototype) {
  operator_laws<V> laws{a, {a, prototype}};
  auto& sampler = laws.sampler;
  if (a.rows < 0 || a.cols < 0) {
    sampler.report("sizes", "rows() or cols() is negative");
    return sampler.found();
  }
  if (a.laws != law_set{} && a.rows != a.cols) {
    sampler.report("laws", "declared by an operator that is not square");
    return sampler.found();
  }
  laws.size = laws.check_overwriting();
  if (laws.size != laws.size) return sampler.found();  // NaN: reported already
  laws.check_linearity();
  laws.check_repeatability();
  laws.check_concurrency();
  laws.check_declared_laws();
  laws.check_adjoint();
  laws.check_accumulation();
  laws.check_diagonal();
  laws.check_columns();
  laws.check_inverse();
  return sampler.found();
}

}  // namespace slant::testing::detail

namespace slant::testing {

// --- operator breaches ---------------------------------------------------------------------------

/// The laws that `a` was found to break, each once, with the numbers that show it. `prototype` is
/// any vector of the kind the operator works on; its size and contents do not matter.
template <class A, slant::vector V = Eigen::VectorXd>
  requires linear_operator<A, V>
[[nodiscard]] std::vector<breach> operator_breaches(A const& a, V const& prototype = V(),
                                                    operator_law_options const& options = {}) {
  return detail::operator_breaches_of(detail::probe_operator<V>(a, options), prototype);
}

// --- conjugacy breaches --------------------------------------------------------------------------
//
// The laws of a conjugate projector, sampled [D (5)]:
//
//     K Q = Qᵀ K Q = Qᵀ K
//
// for a symmetric K; equivalently ⟨K Q x, y − Q y⟩ = 0 for all x, y: what Q keeps is K-orthogonal
// to what it removes. That Q² = Q, and that Qᵀ is its adjoint, is for operator_breaches.

/// The laws that Q was found to break, each once, with the numbers that show it. Tolerances are
/// multiples of ε max(‖K x‖, ‖K Q x‖) (1 + ‖Q x‖ / ‖x‖)² for the sample x; a U'KU of large
/// condition may need options.roundings.
template <class Q, class K, slant::vector V = Eigen::VectorXd>
  requires has_adjoint<Q, V> && linear_operator<Q, V> && linear_operator<K, V>
[[nodiscard]] std::vector<breach> conjugacy_breaches(Q const& q, K const& k,
                                                     V const& prototype = V(),
                                                     operator_law_options const& options = {}) {
  using S = scalar_t<V>;
  auto const probe = detail::probe_operator<V>(q, options);
  detail::operator_sampler<V> sampler(probe, prototype);
  index const n = index(q.rows());
  if (index(q.cols()) != n || index(k.rows()) != n || index(k.cols()) != n) {
    sampler.report("sizes", "Q and K are not square of the same size");
    return sampler.found();
  }
  auto const image = [&](V const& x) {
    V y = sampler.garbage(n);
    slant::apply(k, x, y);
    return y;
  };
  for (int sample = 0; sample < std::max(options.samples, 1); ++sample) {
    V const x = sampler.random(n);
    V const qx = sampler.image(x);
    V const kx = image(x);
    V const kqx = image(qx);
    S const length = slant::norm(x);
    if (!(length > S(0))) continue;
    S const growth = S(1) + slant::norm(qx) / length;
    S const size = std::max<S>(slant::norm(kx), slant::norm(kqx)) * growth * growth;
    sampler.expect_close("conjugacy, K Q x = Q'K x", kqx, sampler.adjoint_image(kx), size);
    sampler.expect_close("conjugacy, K Q x = Q'K Q x", kqx, sampler.adjoint_image(kqx), size);
  }
  return sampler.found();
}

}  // namespace slant::testing
