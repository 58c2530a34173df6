// SPDX-License-Identifier: MIT
#include <slant/iteration/nested.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/testing/archetypes.hpp>

#include <ranges>
#include <support/testing.hpp>

namespace nested_test {

/// −u'' on n = 2^(l+2) − 1 interior nodes of (0, 1), and linear interpolation from the level
/// before.
class line {
 public:
  line(int l, double tolerance) : tolerance_(tolerance), n_((4 << l) - 1) {
    double const h = 1.0 / double(n_ + 1);
    A_.resize(n_, n_);
    b_.resize(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      A_.insert(i, i) = 2 / h;
      if (i > 0) A_.insert(i, i - 1) = -1 / h;
      if (i + 1 < n_) A_.insert(i, i + 1) = -1 / h;
      b_[i] = h * std::exp(double(i + 1) * h);
    }
    Eigen::Index const coarse = (n_ - 1) / 2;
    P_.resize(n_, coarse);
    for (Eigen::Index j = 0; j < coarse; ++j) {
      P_.insert(2 * j, j) = 0.5;
      P_.insert(2 * j + 1, j) = 1;
      P_.insert(2 * j + 2, j) = 0.5;
    }
  }
  line(line const&) = delete;
  line& operator=(line const&) = delete;

  auto a() const { return slant::matrix<slant::self_adjoint, slant::positive_definite>(A_); }
  auto method() const { return slant::cg{a(), b_}; }
  auto stop() const { return slant::residual_below(tolerance_) || slant::at_most(1000); }
  auto prolongation() const { return slant::matrix(P_); }

  VectorXd const& b() const { return b_; }
  sparse const& A() const { return A_; }

 private:
  double tolerance_;
  Eigen::Index n_;
  sparse A_;
  sparse P_;
  VectorXd b_;
};

auto lines(int levels, double tolerance) {
  return std::views::iota(0, levels) |
         std::views::transform([tolerance](int l) { return line(l, tolerance); });
}

TEST_CASE("each level starts from the prolonged solution of the one before") {
  std::vector<VectorXd> starts;
  auto const note = [&](auto const& s) {
    if (s.iteration == 0) starts.push_back(s.x);
  };
  VectorXd const zero = VectorXd::Zero(3);
  auto const r = slant::solve_nested(lines(4, 1e-10), zero, note);
  CHECK(r.converged());
  CHECK(r.x().size() == 31);
  REQUIRE(r.levels.size() == 4);
  REQUIRE(starts.size() == 4);
  CHECK(starts[0] == zero);
  for (std::size_t l = 1; l < 4; ++l) {
    VectorXd const& coarse = r.levels[l - 1].x();
    CHECK(starts[l].size() == r.levels[l].x().size());
    for (Eigen::Index i = 0; i < coarse.size(); ++i) CHECK(starts[l][2 * i + 1] == coarse[i]);
    CHECK(starts[l][0] == coarse[0] / 2);
  }
  line const finest(3, 1e-10);
  CHECK((finest.A() * r.x() - finest.b()).norm() <= 1e-9 * finest.b().norm());
}

TEST_CASE("what a level counts is that level's work, and less than from zero") {
  auto const nested = slant::solve_nested(lines(8, 1e-3), test::zeros(3));
  line const finest(7, 1e-3);
  VectorXd const zero = VectorXd::Zero(finest.b().size());
  auto const direct = slant::solve(finest.method(), zero, finest.stop());
  CHECK(nested.converged());
  CHECK(direct.converged());
  CHECK(nested.finest().iterations() < direct.iterations() / 4);
  CHECK(nested.levels[0].state.work.operator_applications <= 3 + 1);
}

TEST_CASE("levels may stand in a container and are not copied") {
  std::vector<std::unique_ptr<line>> kept;
  for (int l = 0; l < 2; ++l) kept.push_back(std::make_unique<line>(l, 1e-8));
  auto const levels = kept | std::views::transform([](auto const& p) -> line const& { return *p; });
  CHECK(slant::solve_nested(levels, test::zeros(3)).converged());
}

TEST_CASE("a level that did not converge is a start all the same") {
  struct hasty : line {
    explicit hasty(int l) : line(l, 1e-8), steps(l == 0 ? 1 : 100) {}
    auto stop() const { return slant::residual_below(1e-8) || slant::at_most(steps); }
    int steps;
  };
  auto const levels =
      std::views::iota(0, 3) | std::views::transform([](int l) { return hasty(l); });
  auto const r = slant::solve_nested(levels, test::zeros(3));
  CHECK(r.levels[0].status == slant::status::iteration_limit);
  CHECK(r.converged());
  CHECK(r.levels.size() == 3);
}

/// x ← 1e200 x: overflows in its second step.
struct explosion {
  struct state {
    VectorXd x;
    slant::index iteration = 0;
    slant::status status = slant::status::running;
  };
  static state start(VectorXd const& x0) { return {x0}; }
  static void step(state& s) {
    s.x *= 1e200;
    ++s.iteration;
  }
};

struct exploding_level {
  slant::index steps;
  static explosion method() { return {}; }
  auto stop() const { return slant::at_most(steps); }
  static auto prolongation() { return slant::matrix(MatrixXd::Identity(2, 2).eval()); }
};

TEST_CASE("after an iterate that is not finite there is no next level") {
  VectorXd const one = VectorXd::Ones(2);
  auto const r = slant::solve_nested(std::vector<exploding_level>{{1}, {2}, {1}}, one);
  CHECK(r.levels.size() == 2);
  CHECK_FALSE(r.converged());
  CHECK(slant::solve_nested(std::vector<exploding_level>{{0}, {1}, {0}}, one).levels.size() == 3);
}

/// The least that vectors and operators can do.
struct archetype_level {
  using vector = slant::testing::archetype::vector;
  Eigen::Index n;

  auto method() const {
    return slant::cg{spd(2 * MatrixXd::Identity(n, n)), vector(VectorXd::Ones(n))};
  }
  static auto stop() { return slant::residual_below(1e-12) || slant::at_most(9); }
  auto prolongation() const {
    return slant::testing::archetype::linear_operator(MatrixXd::Ones(n, 1));
  }
  using spd = slant::testing::archetype::spd_operator;
};

TEST_CASE("vectors and operators are asked for nothing that they need not have") {
  slant::testing::archetype::vector const zero(VectorXd::Zero(1));
  auto const r = slant::solve_nested(std::vector<archetype_level>{{1}, {5}}, zero);
  CHECK(r.levels[0].iterations() == 1);
  CHECK(r.levels[1].iterations() == 0);  // constants are prolonged exactly
  CHECK(r.x().local() == VectorXd::Constant(5, 0.5));
}

TEST_CASE("no level, and levels that do not fit, are refused by name") {
  VectorXd const zero = VectorXd::Zero(3);
  CHECK_THROWS_WITH_AS((void)slant::solve_nested(lines(0, 0.1), zero),
                       "levels: got none, expected at least one level", slant::bad_input);
  auto const gap =
      std::vector<int>{0, 2} | std::views::transform([](int l) { return line(l, 1e-8); });
  CHECK_THROWS_WITH_AS((void)slant::solve_nested(gap, zero),
                       "x: got 3 rows, expected 7 (cols() of the operator)", slant::bad_input);
}

}  // namespace nested_test
