// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/equilibrated.hpp>
#include <slant/sets/sets.hpp>

#include <krylov/spd_matrices.hpp>
#include <oracle/dense_newton.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>

namespace equilibrated_test {

/// Contact with friction at 8 nodes whose stiffness grows from 1 to `spread`: bounds, then discs.
struct uneven {
  static constexpr Eigen::Index m = 8;
  VectorXd unit = VectorXd(3 * m);  ///< what an unknown is measured in
  MatrixXd A;
  VectorXd b;
  VectorXd lower = VectorXd::Zero(m);
  VectorXd g = VectorXd(m);

  explicit uneven(double spread) {
    for (Eigen::Index j = 0; j < 3 * m; ++j) {
      auto const node = static_cast<double>(j < m ? j : (j - m) / 2);
      unit(j) = std::pow(spread, -node / (2 * (m - 1)));
    }
    VectorXd const scale = unit.cwiseInverse();
    A = scale.asDiagonal() * test::with_spectrum(test::log_spaced(3 * m, 100), 4) *
        scale.asDiagonal();
    b = 3 * scale.cwiseProduct(test::random_vector(3 * m, 7));
    for (Eigen::Index i = 0; i < m; ++i) g(i) = 0.8 * unit(m + 2 * i);
  }
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines(lower), slant::discs(g));
  }
  [[nodiscard]] oracle::dense_qp plain() const {
    oracle::dense_qp qp{A, b.cast<long double>(), {}, {}};
    for (Eigen::Index i = 0; i < m; ++i) qp.intervals.push_back({i, lower(i)});
    for (Eigen::Index i = 0; i < m; ++i) qp.circles.push_back({m + 2 * i, m + 2 * i + 1, g(i)});
    return qp;
  }
};

auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(30);

TEST_CASE("blocks of very different stiffness: the work does not depend on the spread") {
  slant::index products = 0;
  for (double const spread : {1.0, 1e3, 1e6, 1e9, 1e14}) {
    CAPTURE(spread);
    uneven const p(spread);
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
    auto const set = p.set();
    slant::separable_qp const qp{A, p.b, set};
    slant::equilibrated const even(qp);
    auto const scaled = even.qp();
    auto const r =
        slant::solve(slant::symmetric_newton{scaled}, even.from(VectorXd::Zero(qp.size())), stop);
    CHECK(r.converged());
    // The digits of the reference, measured in the unit of each unknown.
    auto const reference = oracle::solve_dense(p.plain());
    VectorXd const error = (even.back(r.x()) - reference.x.cast<double>()).cwiseQuotient(p.unit);
    CHECK(error.cwiseAbs().maxCoeff() <= 1e-9);
    auto const work = r.state.work.operator_applications;
    if (spread == 1) products = work;
    CHECK(work <= products + products / 5);
  }
}

TEST_CASE("without it the stiff blocks decide the length of every step") {
  auto const solve_plainly = [](double spread, slant::index most) {
    uneven const p(spread);
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
    auto const set = p.set();
    slant::separable_qp const qp{A, p.b, set};
    return test::minimise(slant::symmetric_newton{qp}, test::zeros(qp.size()), 1e-12, most);
  };
  auto const even = solve_plainly(1, 30).state.work.operator_applications;
  auto const stiff = solve_plainly(1e6, 2000).state.work.operator_applications;
  CAPTURE(even);
  CAPTURE(stiff);
  CHECK(stiff >= 20 * even);
  CHECK_FALSE(solve_plainly(1e9, 2000).converged());
}

TEST_CASE("a problem that is handed over is owned") {
  uneven const p(1e4);
  slant::equilibrated const even(slant::separable_qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A), p.b, p.set()});
  auto const scaled = even.qp();
  CHECK(slant::solve(slant::symmetric_newton{scaled}, even.from(VectorXd::Zero(24)), stop)
            .converged());
}

TEST_CASE("factors: one a block, means of the diagonal, one in between where it vanishes") {
  auto const set =
      slant::cartesian(slant::half_lines(VectorXd::Zero(2).eval()),
                       slant::discs(VectorXd::Ones(2).eval()), slant::free_components(2));
  VectorXd const a{{4.0, 0.0, 1.0, 31.0, 0.0, 0.0, 0.25, 16.0}};
  double const t = std::sqrt(0.25) * std::sqrt(2.0);
  CHECK(slant::block_factors(set, a) == VectorXd{{0.5, t, 0.25, 0.25, t, t, 2.0, 0.25}});
  CHECK(slant::block_factors(set, VectorXd(0 * a)) == VectorXd::Ones(8));
  for (double const wrong :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    VectorXd bad = a;
    bad(3) = wrong;
    CHECK_THROWS_AS(static_cast<void>(slant::block_factors(set, bad)), slant::bad_input);
  }
  CHECK_THROWS_WITH(static_cast<void>(slant::block_factors(set, VectorXd(VectorXd::Ones(3)))),
                    "diagonal: got 3, expected the dimension of the set, 8");
}

TEST_CASE("there and back; sizes are checked") {
  uneven const p(100);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.A);
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  slant::equilibrated const even(qp, VectorXd(VectorXd::Constant(24, 0.5)));
  VectorXd const x = test::random_vector(24, 1);
  CHECK(even.back(even.from(x)) == x);
  CHECK_THROWS_AS(static_cast<void>(even.from(VectorXd(1))), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(even.back(VectorXd(1))), slant::bad_input);
  CHECK_THROWS_AS(slant::equilibrated(qp, VectorXd(VectorXd::Ones(2))), slant::bad_input);
}

}  // namespace equilibrated_test
