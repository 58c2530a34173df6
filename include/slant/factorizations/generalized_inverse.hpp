// SPDX-License-Identifier: MIT
//
// A generalised inverse of a symmetric positive semidefinite matrix K with kernel R, for bodies
// that float [K refs 6, 15]: with J the fixing rows of R (kernel_basis.hpp) and I the others,
//
//     K⁺ = [ K_II⁻¹  0 ]          K K⁺ K = K,    K⁺ K K⁺ = K⁺,    K⁺ symmetric, semidefinite.
//          [ 0       0 ]
//
// K_II is definite, so that one ordinary factorisation does. x = K⁺ b solves K x = b whenever Rᵀb =
// 0 and is the solution with x_J = 0; all solutions are x + R α. Another choice of J changes x by
// some R α; what the projector onto the orthogonal complement of R leaves of it is the same, that
// of the Moore–Penrose inverse [K refs 42, 44].
//
//     auto Kplus = slant::generalized_inverse(K, slant::contact::rigid_body_modes(nodes));
//     auto F = slant::congruence(B, Kplus);
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/partitions.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/kernel_basis.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace slant {

/// y = K⁺ x. Owns its factors and the kernel; copies share the factors.
template <class S = double>
class generalized_inverse {
 public:
  using scalar = S;
  using sparse_type = Eigen::SparseMatrix<S>;
  using dense_type = Eigen::MatrixX<S>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;

  /// K of which the kernel is not known; see kernel_basis.hpp. Two factorisations.
  explicit generalized_inverse(sparse_type const& K)
      : generalized_inverse(K, slant::computed_kernel(K)) {}

  /// K with the kernel that the columns of R span, none for a regular K. One factorisation. Throws
  /// bad_input if the columns are dependent or not in the kernel (with ‖K R‖ and what was
  /// expected), if they are not all of it, or if K is not symmetric or not semidefinite.
  generalized_inverse(sparse_type const& K, dense_type const& R)
      : kernel_(basis(K, R)),
        fixing_(fixing_rows(kernel_)),
        kept_(detail::complement(kernel_.rows(), fixing_)),
        factors_(factored(K, kept_, kernel_.cols())) {}

  [[nodiscard]] index rows() const noexcept { return kernel_.rows(); }
  [[nodiscard]] index cols() const noexcept { return kernel_.rows(); }
  /// R, n × d, with orthonormal columns: the kernel operator is matrix(kernel()).
  [[nodiscard]] dense_type const& kernel() const& noexcept { return kernel_; }
  [[nodiscard]] dense_type kernel() && noexcept { return std::move(kernel_); }
  /// J, in increasing order.
  [[nodiscard]] std::vector<index> const& fixing() const& noexcept { return fixing_; }
  std::vector<index> const& fixing() const&& = delete;

  /// Room for the components I.
  [[nodiscard]] auto workspace(has_scalar<S> auto const& x) const {
    auto right = slant::like(slant::local(x), static_cast<index>(kept_.size()));
    auto solution = right;
    auto inner = slant::workspace(factors_, right);
    return temporaries<decltype(right), decltype(inner)>{std::move(right), std::move(solution),
                                                         std::move(inner)};
  }
  void apply(has_scalar<S> auto const& x, auto& y, auto& w) const {
    auto const& from = slant::local(x);
    auto&& to = slant::local(y);
    for (index j = 0; j < from.cols(); ++j) {
      index i = 0;
      for (index const k : kept_) w.right.coeffRef(i++, j) = from.coeff(k, j);
    }
    detail::solve_with(factors_, w.right, w.solution, w.inner);
    to.setZero();
    for (index j = 0; j < from.cols(); ++j) {
      index i = 0;
      for (index const k : kept_) to.coeffRef(k, j) = w.solution.coeff(i++, j);
    }
  }

 private:
  using factors_type = decltype(slant::factorize(std::declval<sparse_type const&>()));

  template <class V, class Inner>
  struct temporaries {
    V right;     // x_I
    V solution;  // K_II⁻¹ x_I
    Inner inner;
  };

  /// Orthonormal columns, after a look at K and R.
  static dense_type basis(sparse_type const& K, dense_type const& R) {
    detail::require_symmetric_matrix("K", K);
    detail::check_size("rows of R", R.rows(), K.rows(), "the size of K,");
    detail::require_finite_entries("R", R);
    dense_type basis = detail::orthonormal_basis<S>(R);
    if (basis.cols() < R.cols()) {
      throw bad_input("columns of R", "rank " + detail::show(index(basis.cols())),
                      detail::show(index(R.cols())) + " independent ones");
    }
    detail::require_kernel(K, basis);
    return basis;
  }

  static factors_type factored(sparse_type const& K, std::vector<index> const& rows, index d) {
    sparse_type const E = detail::columns_of_identity<S>(K.rows(), rows);
    sparse_type const block = E.transpose() * K * E;
    auto factors = [&] {
      try {
        return slant::factorize(block);
      } catch (bad_input const& refusal) {
        refuse(d, refusal.what());
      }
    }();
    if (leaves_free(factors, block)) refuse(d, "a motion that K does not resist");
    return factors;
  }
  [[noreturn, gnu::cold]] static void refuse(index d, std::string const& why) {
    throw bad_input("R", detail::show(d) + " directions, and with as many rows fixed still " + why,
                    "the whole kernel of a positive semidefinite K");
  }
  /// Whether K_II, with a diagonal of 1, is singular up to rounding though no pivot is: what two
  /// solves make of any vector.
  static bool leaves_free(factors_type const& factors, sparse_type const& block) {
    using vector_type = Eigen::VectorX<S>;
    if (block.rows() == 0) return false;
    vector_type const scale = block.diagonal().cwiseSqrt().cwiseInverse();
    sparse_type const scaled = scale.asDiagonal() * block * scale.asDiagonal();
    detail::random_bits generator(2013);
    vector_type v(block.rows()), x = v;
    for (S& entry : v) entry = S(generator() >> 63U) - S(0.5);
    auto w = slant::workspace(factors, v);
    for (int k = 0; k < 2; ++k) {
      v = v.cwiseQuotient(scale);
      detail::solve_with(factors, v, x, w);
      x = x.cwiseQuotient(scale);
      v = x / x.cwiseAbs().maxCoeff();
    }
    return (scaled * v).cwiseAbs().maxCoeff() <=
           S(4) * std::numeric_limits<S>::epsilon() * detail::largest_row_sum(scaled);
  }

  dense_type kernel_;          // R
  std::vector<index> fixing_;  // J
  std::vector<index> kept_;    // I
  factors_type factors_;       // of K_II
};

}  // namespace slant
