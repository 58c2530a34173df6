// SPDX-License-Identifier: MIT
//
// What the tests of schur_contact share: small problems of one type, so that the method is compiled
// once, and their solutions by every active set.
#pragma once

#include <slant/slant.hpp>

#include <oracle/small_polyhedra.hpp>
#include <support/testing.hpp>

namespace schur_contact_scenes {

using slant::status;

/// A row of springs between n points, free at both ends.
inline MatrixXd chain(int n, double stiffness = 1) {
  MatrixXd k = MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    k(i, i) += stiffness;
    k(i + 1, i + 1) += stiffness;
    k(i, i + 1) -= stiffness;
    k(i + 1, i) -= stiffness;
  }
  return k;
}
/// diag(a, b).
inline MatrixXd both(MatrixXd const& a, MatrixXd const& b) {
  MatrixXd k = MatrixXd::Zero(a.rows() + b.rows(), a.rows() + b.rows());
  k.topLeftCorner(a.rows(), a.rows()) = a;
  k.bottomRightCorner(b.rows(), b.rows()) = b;
  return k;
}

struct small_problem {
  MatrixXd K;
  VectorXd f;
  MatrixXd B;
  VectorXd c;
};

/// A stiffness that counts its applications and gives numbers for so many of them only. All tests
/// use it, so that the method is compiled for one type of problem.
struct stiffness {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  MatrixXd k;
  std::shared_ptr<int> applications = std::make_shared<int>(0);
  int most = 1'000'000;
  [[nodiscard]] Eigen::Index rows() const { return k.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return k.cols(); }
  void apply(VectorXd const& x, VectorXd& y) const {
    y.noalias() = k * x;
    if (++*applications > most) y[0] = std::numeric_limits<double>::quiet_NaN();
  }
  void diagonal(VectorXd& d) const { d = k.diagonal(); }
};
using projector = slant::conjugate_projector_operator<double, slant::ldlt<double>>;
using row_set = slant::constraint_rows<double>;

inline auto problem(stiffness const& K, VectorXd const& f, row_set const& rows,
                    projector const& Q) {
  return slant::polyhedral_qp{K, f, rows, Q};
}
using problem_type =
    decltype(problem(std::declval<stiffness const&>(), std::declval<VectorXd const&>(),
                     std::declval<row_set const&>(), std::declval<projector const&>()));
using method = slant::schur_contact<problem_type const&>;
using options = slant::schur_contact_options<double>;

inline auto minimise(problem_type const& qp, VectorXd const& u0, options const& o = {}) {
  return slant::solve(method(qp, o), u0, slant::residual_below(1e-12) || slant::at_most(500));
}
using report_type = decltype(minimise(std::declval<problem_type const&>(), VectorXd()));

/// The projector of some columns.
inline projector projector_of(MatrixXd const& k, MatrixXd const& u) {
  return slant::conjugate_projector(sparse(k.sparseView()), sparse(u.sparseView()));
}
/// The one of the unknowns that no row touches, without the first few if the others are free.
inline projector projector_of(small_problem const& p) {
  std::vector<Eigen::Index> inside;
  for (Eigen::Index j = 0; j < p.K.cols(); ++j) {
    VectorXd const entries = (p.c.array() < infinity).select(p.B.col(j), 0.0);
    if (entries.isZero(0)) inside.push_back(j);
  }
  while (true) {
    try {
      return projector_of(p.K, MatrixXd::Identity(p.K.rows(), p.K.cols())(Eigen::all, inside));
    } catch (slant::bad_input const&) {
      inside.erase(inside.begin());
    }
  }
}

/// What a problem of the method refers to.
struct body_list {
  small_problem p;
  stiffness K{p.K};
  row_set rows{p.B.sparseView(), p.c};
  projector Q = projector_of(p);
  [[nodiscard]] VectorXd zero() const { return VectorXd::Zero(p.f.size()); }
  [[nodiscard]] auto qp() const { return problem(K, p.f, rows, Q); }
};

template <class Check>
void solve(small_problem const& p, options const& o, Check check) {
  body_list const bodies{p};
  auto const r = minimise(bodies.qp(), bodies.zero(), o);
  check(bodies, r);
}

/// Solves and compares with every active set.
inline void compare(small_problem const& p, options const& o = {}) {
  auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
  solve(p, o, [&](body_list const&, report_type const& r) {
    CAPTURE(r.reason);
    if (!reference) {
      REQUIRE(r.status == status::unbounded);
      VectorXd const d = r.state.descent.normalized();
      CHECK((p.K * d).norm() <= 1e-13 * p.K.norm());
      CHECK((p.B * d).maxCoeff() <= 1e-13);
      CHECK(p.f.dot(d) > 1e-12 * p.f.norm());
      return;
    }
    REQUIRE(r.converged());
    VectorXd const u = r.x();
    VectorXd const λ = r.state.multipliers();
    double const size = p.f.norm();
    CHECK((p.K * u + p.B.transpose() * λ - p.f).norm() <= 1e-11 * size);
    CHECK(λ.minCoeff() >= 0);
    VectorXd const acting = (p.c.array() < infinity).select(VectorXd(p.B * u - p.c), -1.0);
    CHECK(acting.maxCoeff() <= 1e-13 * (u.norm() + 1));
    // The energy is unique even where u is not.
    auto const energy = [&](VectorXd const& v) { return 0.5 * v.dot(p.K * v) - p.f.dot(v); };
    CHECK(std::abs(energy(u) - energy(reference->u)) <= 1e-9 * (std::abs(energy(u)) + size));
  });
}

}  // namespace schur_contact_scenes
