// SPDX-License-Identifier: MIT
//
// Compositions of arbitrary matrices: they are the matrix that a dense computation gives, and keep
// the laws that they declare.
#include "numbers.hpp"

#include <slant/operators/letter.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>
#include <slant/testing/operator_breaches.hpp>

namespace properties::operators {

using matrix = Eigen::MatrixXd;
using vector = Eigen::VectorXd;

/// LᵀL, exactly.
matrix any_semidefinite(Eigen::Index n) {
  matrix const L = matrix_of(*rc::gen::inRange(0, 4), n, quarter);
  return L.transpose() * L;
}

/// `terms` bounds the norm of what is multiplied and added up; the sum may be much smaller.
template <class A>
void keep_laws(A const& a, matrix const& dense, double terms) {
  auto const size = double(dense.rows() + dense.cols());
  slant::testing::operator_law_options options{.samples = 3};
  if (dense.norm() > 0) options.roundings = (64 + 8 * size) * std::max(1.0, terms / dense.norm());
  for (auto const& broken : slant::testing::operator_breaches(a, vector(), options))
    RC_FAIL(broken.law + " (" + broken.evidence + ")");
  vector const x = vector_of(dense.cols(), quarter);
  vector y(dense.rows());
  slant::apply(a, x, y);
  // Numbers of a few binary digits: nothing is rounded.
  RC_ASSERT(y == dense * x);
}

}  // namespace properties::operators

namespace properties {

bool operators_keep_their_laws() {
  using namespace operators;
  return rc::check("α B A Bᵀ and |α| B A Bᵀ + C Cᵀ are what they say", [] {
    Eigen::Index const n = *rc::gen::inRange(1, 5), m = *rc::gen::inRange(1, 5);
    matrix const dense_a = any_semidefinite(n), dense_b = matrix_of(m, n, quarter),
                 dense_c = matrix_of(m, n, quarter);
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(dense_a);
    auto const B = slant::matrix(dense_b), C = slant::matrix(dense_c);
    auto const first = slant::congruence(B, A);
    auto const second = slant::product(C, slant::adjoint(C));
    double const α = *quarter(), terms = dense_b.squaredNorm() * dense_a.norm();
    keep_laws(first, dense_b * dense_a * dense_b.transpose(), terms);
    matrix const term = dense_b * dense_a * dense_b.transpose();
    keep_laws(slant::scaled(slant::any_sign(α), first), α * term, std::fabs(α) * terms);
    keep_laws(slant::sum(slant::scaled(std::fabs(α), first), second),
              std::fabs(α) * term + dense_c * dense_c.transpose(),
              std::fabs(α) * terms + dense_c.squaredNorm());
  });
}

}  // namespace properties
