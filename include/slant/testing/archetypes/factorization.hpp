// SPDX-License-Identifier: MIT
//
// The least that is a factorisation: a number of rows and a solve, with a concrete signature on
// archetype vectors. It promises no laws.
#pragma once

#include <slant/concepts/factorization.hpp>
#include <slant/testing/archetypes/vector.hpp>

#include <Eigen/LU>

namespace slant::testing::archetype {

class factorization {
 public:
  /// Of an invertible matrix.
  explicit factorization(Eigen::MatrixXd const& m) : lu_(m) {}

  [[nodiscard]] index rows() const { return lu_.rows(); }
  void solve(vector const& b, vector& x) const { x.local() = lu_.solve(b.local()); }

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

/// The same for a symmetric positive definite matrix.
class spd_factorization : public factorization {
 public:
  static constexpr law_set laws = slant::laws<law::self_adjoint, law::positive_definite>;
  using factorization::factorization;
};

static_assert(slant::factorization<factorization, vector>);

}  // namespace slant::testing::archetype
