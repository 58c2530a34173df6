// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <oracle/random_programs.hpp>
#include <support/program_sets.hpp>
#include <support/testing.hpp>

namespace solve_program_test {

/// x ≥ lower and discs of radii g.
auto dense_program(MatrixXd const& A, VectorXd const& b, VectorXd const& lower, VectorXd const& g) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b,
                             slant::cartesian(slant::half_lines(lower), slant::discs(g))};
}

/// Half lines and discs around a known solution: pressed, open, sliding and sticking nodes, with
/// the stiffness of the nodes from 1 to `contrast`.
struct known_program {
  MatrixXd A;
  VectorXd b, g, x;

  known_program(int m, double contrast) {
    int const n = 3 * m;
    A = MatrixXd::Constant(n, n, 0.1) + MatrixXd::Identity(n, n);
    VectorXd s(n);
    for (int i = 0; i < m; ++i) {
      double const size = std::exp2(std::round(std::log2(contrast) * i / (2.0 * (m - 1))));
      s(i) = s(m + 2 * i) = s(m + 2 * i + 1) = size;
    }
    A = (s.asDiagonal() * A * s.asDiagonal()).eval();
    g = VectorXd::Ones(m);
    x.resize(n);
    VectorXd force = VectorXd::Zero(n);
    for (int i = 0; i < m; ++i) {
      bool const open = i % 2 == 0, slides = i % 3 == 0;
      x(i) = open ? 0 : 1;
      force(i) = open ? s(i) : 0;
      x.segment<2>(m + 2 * i) << (slides ? 1 : 0.25), 0;
      if (slides) force(m + 2 * i) = -s(i);
    }
    b = A * x - force;
  }
  [[nodiscard]] auto program() const { return dense_program(A, b, 0 * g, g); }
  [[nodiscard]] double error(VectorXd const& y) const {
    VectorXd const e = y - x;
    return std::sqrt(e.dot(A * e) / x.dot(A * x));
  }
};

TEST_CASE("solve(qp, tolerance): the error that is asked for, and what is said of it") {
  known_program const p(6, 1);
  auto const qp = p.program();
  for (double const tolerance : {1e-2, 1e-6, 1e-12}) {
    auto const run = slant::solve(qp, tolerance);
    CHECK(run.converged());
    CHECK(run.choice.empty());
    CHECK(p.error(run.x()) <= tolerance);
    CHECK(p.error(run.x()) <= 2 * run.error.relative() + 1e-15);
    CHECK(run.reason.find("relative energy error") != std::string::npos);
    CHECK(run.work.operator_applications > run.iterations());
  }
  CHECK_THROWS_AS((void)slant::solve(qp, -1.0), slant::bad_input);
  CHECK(SLANT_COMPLAINT(slant::solve(qp, 1e-8, -1)) == "max_steps: got -1, expected at least 0");
  CHECK(slant::solve(qp, 1e-8, 1).status == slant::status::iteration_limit);
}

TEST_CASE(
    "solve(qp, tolerance): stiffness of the blocks over twelve orders of magnitude is scaled") {
  known_program const p(6, 1e12);
  auto const run = slant::solve(p.program(), 1e-9);
  CHECK(run.converged());
  CHECK(run.choice.find("blocks scaled") == 0);
  CHECK(p.error(run.x()) <= 1e-9);
  CHECK(run.iterations() <= 30);
}

TEST_CASE("solve(qp, M, tolerance): a preconditioner saves applications") {
  known_program const p(8, 16);
  MatrixXd const inverse = p.A.inverse();
  auto const qp = p.program();
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(
      MatrixXd(0.5 * (inverse + inverse.transpose())));
  auto const run = slant::solve(qp, M, 1e-10);
  CHECK(run.converged());
  CHECK(p.error(run.x()) <= 1e-10);
  CHECK(run.work.operator_applications <= slant::solve(qp, 1e-10).work.operator_applications);
}

/// No more is known of A than that it is semidefinite.
auto program_of(oracle::random_program const& p) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A),
                             p.b, test::set_of(p)};
}

TEST_CASE("solve(qp, 1e-8): hard programs, degenerate and singular ones, tiny ones") {
  for (auto const suite : {oracle::program_suite::nasty, oracle::program_suite::degenerate,
                           oracle::program_suite::tiny}) {
    for (std::uint64_t k = 0; k < 40; ++k) {
      CAPTURE(int(suite));
      CAPTURE(k);
      auto const p = oracle::make_program(suite, k);
      auto const run = slant::solve(program_of(p), 1e-8);
      CHECK(run.converged());
      auto const exact = p.definite ? oracle::exact_solution(p) : std::nullopt;
      if (exact) {
        double const error = oracle::energy_error(p, run.x(), *exact);
        CHECK(error <= 2e-8);
        CHECK(error <= 5 * run.error.relative() + 1e-13);
      } else {
        CHECK(std::min(oracle::relative_residual(p, run.x()) / 1e-8,
                       oracle::floors_above(p, run.x()) / 10) <= 30);
      }
    }
  }
}

TEST_CASE("solve(qp, tolerance): a solution without energy is one") {
  MatrixXd const K = VectorXd{{1, 0}}.asDiagonal();
  VectorXd const b{{0, -1}}, low{{0, 0.25}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(K);
  auto const run = slant::solve(slant::separable_qp{A, b, slant::half_lines(low)}, 1e-8);
  CHECK((run.converged() && run.x() == low));
}

TEST_CASE("solve(qp, tolerance): scaled or not, x is in Λ to the last bit") {
  oracle::random_program p;
  p.A = MatrixXd{{3e6, 1e2, 0}, {1e2, 0.7, 1e-4}, {0, 1e-4, 1e-5}};
  p.b = VectorXd{{1e9, 5, 9}};
  p.right = VectorXd{{1.0 / 3, 0.1, 0.7}};
  p.left = -p.right;
  auto const run = slant::solve(program_of(p), 1e-8);
  CHECK(run.converged());
  CHECK(run.choice.find("blocks scaled") == 0);
  CHECK(run.x() == VectorXd{{p.right[0], p.left[1], p.right[2]}});
}

TEST_CASE("solve(qp, tolerance): an unbounded program, with the direction of descent") {
  for (double const stiffness : {1.0, 1e-6}) {  // the latter scaled
    oracle::random_program p;
    p.A = VectorXd{{1, 0, stiffness}}.asDiagonal();
    p.b = VectorXd{{1, 1, -1}};
    p.lower = VectorXd::Zero(3);
    auto const run = slant::solve(program_of(p), 1e-8);
    CAPTURE(stiffness);
    CAPTURE(run.reason);
    CHECK(run.status == slant::status::unbounded);
    REQUIRE(run.descent.size() == 3);
    CHECK((run.descent.array() >= 0).all());
    CHECK((p.A * run.descent).norm() <= 1e-12 * run.descent.norm());
    CHECK(p.b.dot(run.descent) > 0);
  }
}

TEST_CASE("solve(program with equations, tolerance): unbounded, with the direction of descent") {
  for (double const stiffness : {1.0, 1e-6}) {  // the latter scaled
    MatrixXd const K = VectorXd{{1, 0, 0, stiffness}}.asDiagonal();
    VectorXd const b{{1, 1, -0.5, 1}};
    sparse const G = MatrixXd{{0, 1, -2, 0}}.sparseView();
    auto const q =
        slant::quadratic(slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(K), b);
    auto const run = slant::solve(
        slant::minimise(q).over(slant::half_lines(4)).subject_to(G, VectorXd::Zero(1)), 1e-8);
    CAPTURE(run.reason);
    CHECK(run.status == slant::status::unbounded);
    REQUIRE(run.descent.size() == 4);
    CHECK(run.choice.starts_with("blocks scaled") == (stiffness < 1));
    VectorXd const d = run.descent.normalized();
    CHECK(d.minCoeff() >= 0);
    CHECK((K * d).norm() + (G * d).norm() <= 1e-12);
    CHECK(b.dot(d) > 0.1);
  }
}

TEST_CASE("solve(qp, x0, tolerance): a start near the solution saves steps, scaled or not") {
  for (double const contrast : {1.0, 1e12}) {
    known_program const p(6, contrast);
    auto const qp = p.program();
    auto const cold = slant::solve(qp, 1e-9);
    auto const warm = slant::solve(qp, VectorXd(p.x * (1 + 1e-5)), 1e-9);
    CHECK(warm.converged());
    CHECK(p.error(warm.x()) <= 1e-9);
    CHECK(warm.iterations() < cold.iterations());
    CHECK_THROWS_AS((void)slant::solve(qp, VectorXd(3), 1e-9), slant::bad_input);
  }
}

TEST_CASE("solve(qp, 0): the digits that there are, as `stalled`") {
  known_program const p(4, 1);
  auto const run = slant::solve(p.program(), 0.0);
  CHECK((run.status == slant::status::stalled || run.error.bound == 0));
  CHECK(p.error(run.x()) <= 1e-14);
}

/// No more is known of A than that it is semidefinite.
auto sparse_program(Eigen::SparseMatrix<double> const& A, VectorXd const& b,
                    VectorXd const& lower) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A), b,
                             slant::half_lines(lower)};
}

/// An obstacle under a membrane on N × N nodes that are linked by springs of stiffness 1, or, in the
/// stripes, of `contrast`.
struct membrane {
  Eigen::SparseMatrix<double> A;
  VectorXd b, floor;

  explicit membrane(int N, double contrast = 1) : A(N * N, N * N) {
    std::vector<Eigen::Triplet<double>> t;
    VectorXd sum = VectorXd::Zero(N * N);
    auto const link = [&](int i, int j, double c) {
      t.emplace_back(i, j, -c);
      t.emplace_back(j, i, -c);
      sum(i) += c;
      sum(j) += c;
    };
    for (int k = 0; k < N * N; ++k) {
      int const x = k % N, y = k / N;
      double const c = (x / 10) % 2 == 0 ? 1 : contrast;
      if (x + 1 < N) link(k, k + 1, c);
      if (y + 1 < N) link(k, k + N, c);
      sum(k) += (x == 0) + (x + 1 == N) + (y == 0) + (y + 1 == N);  // the frame
    }
    for (int k = 0; k < N * N; ++k) t.emplace_back(k, k, sum(k));
    A.setFromTriplets(t.begin(), t.end());
    b = VectorXd::Constant(N * N, -4.0 / (N * N));
    floor = VectorXd::Constant(N * N, -0.1);
  }
  [[nodiscard]] auto program() const { return sparse_program(A, b, floor); }
  /// A bound of ‖x − x*‖_A / ‖x‖_A from the violation e of r ≥ 0 where x is on the floor, r = 0 where
  /// not: ‖e‖ / √λ, λ ≤ λ_min(A) that of the membrane of springs 1, all of them ≥ 1.
  [[nodiscard]] double error_at_most(VectorXd const& x) const {
    VectorXd e = A * x - b;
    double const π = std::acos(-1.0), N = std::sqrt(double(x.size()));
    for (int i = 0; i < x.size(); ++i) {
      if (x(i) < floor(i)) return 1;
      if (x(i) == floor(i) && e(i) > 0) e(i) = 0;
    }
    return e.norm() / (std::sqrt(8.0) * std::sin(π / (2 * (N + 1)))) / std::sqrt(x.dot(A * x));
  }
};

TEST_CASE(
    "solve(qp, tolerance) for a sparse matrix: multigrid where conjugate gradients take long") {
  membrane const easy(20), wide(120), stripes(120, 1e6);
  auto const run = slant::solve(easy.program(), 1e-8);
  CHECK(run.converged());
  CHECK(run.choice.empty());
  CHECK(easy.error_at_most(run.x()) <= 1e-7);

  for (membrane const* m : {&wide, &stripes}) {
    auto const qp = m->program();
    auto const chosen = slant::solve(qp, 1e-8);
    CAPTURE(chosen.reason);
    CHECK(chosen.converged());
    CHECK(m->error_at_most(chosen.x()) <= 1e-6);
    CHECK(chosen.choice.find("multigrid, because") != std::string::npos);
    CHECK((chosen.choice.find("blocks scaled") == 0) == (m == &stripes));
    // What was tried first, until a step has ended beyond 579 applications, and the expert's
    // spelling.
    auto const spelled = slant::solve(qp, slant::multigrid{m->A}, 1e-8);
    CHECK(chosen.work.operator_applications <= 2 * 579 + spelled.work.operator_applications);
    CHECK(chosen.iterations() <= 60);
    // Where steps end when applications do, what is said is of the point that is returned.
    for (slant::index const most : {1, 2, 4, 8, 16}) {
      auto const early = slant::solve(qp, 1e-8, most);
      VectorXd const e = early.x() - chosen.x();
      double const error = std::sqrt(e.dot(m->A * e) / chosen.x().dot(m->A * chosen.x()));
      CHECK(early.reason.find("relative energy error") != std::string::npos);
      CHECK(error <= 10 * early.error.relative());
    }
  }
  std::ostringstream out;
  out << slant::solve(stripes.program(), 1e-6);
  CHECK(out.str().find("\n  chosen                 blocks scaled, because") != std::string::npos);
}

TEST_CASE("where further steps lead away from the best point, that is returned") {
  membrane const m(12);
  auto const qp = m.program();
  std::vector<VectorXd> seen;
  auto certificate = [&](VectorXd const& x) {
    seen.push_back(x);
    return slant::energy_error<double>{.bound = seen.size() == 1 ? 1e-5 : 1e-4, .size = 1};
  };
  auto const make = [&](double const&) { return slant::symmetric_newton{qp}; };
  VectorXd const zero = VectorXd::Zero(m.b.size());
  auto const run = slant::detail::run_certified(make, zero, certificate, 1e-8, {.steps = 100});
  REQUIRE(seen.size() == 2);
  CHECK(seen[0] != seen[1]);
  CHECK(run.point == seen[0]);
  CHECK(run.status == slant::status::stalled);
  CHECK(run.reason.find("1e-05") != std::string::npos);
}

/// An operator that knows its inverse, as those of a client may.
struct invertible {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::SparseMatrix<double> A;
  slant::ldlt<double> factors{A};

  [[nodiscard]] slant::index rows() const { return A.rows(); }
  [[nodiscard]] slant::index cols() const { return A.cols(); }
  void apply(VectorXd const& x, VectorXd& y) const { y.noalias() = A * x; }
  [[nodiscard]] auto inverse() const { return slant::inverse(factors); }
};

TEST_CASE("multigrid of a scaled matrix: what was constant is in its near kernel") {
  membrane const m(80);
  VectorXd const d = VectorXd::NullaryExpr(
      m.b.size(), [](Eigen::Index i) { return std::exp2(double(i % 7)) / (1 + double(i % 3)); });
  Eigen::SparseMatrix<double> const scaled = d.asDiagonal() * m.A * d.asDiagonal();
  auto const steps = [](auto const& A, VectorXd const& b, auto const& M) {
    auto const K = slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
    auto const run = slant::solve(slant::cg{K, b, M}, test::zeros(b.size()),
                                  slant::residual_below(1e-8) || slant::at_most(200));
    return run.iterations();
  };
  VectorXd const none;
  auto const unscaled = steps(m.A, m.b, slant::detail::multigrid_of(m.A, none));
  CHECK(unscaled <= 20);
  CHECK(steps(scaled, d.cwiseProduct(m.b), slant::detail::multigrid_of(m.A, d)) <= unscaled + 6);
}

TEST_CASE("solve(qp, tolerance): a hard sparse program gets all that a dense one gets") {
  for (unsigned seed = 0; seed < 16; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    int const n = 30 + int(random() % 31);
    MatrixXd A = MatrixXd::Zero(n, n);  // springs of stiffness 1e-4 to 1e4 in a row
    for (int i = 0; i <= n; ++i) {
      double const c = std::pow(10, 4 * number(random));
      if (i > 0) A(i - 1, i - 1) += c;
      if (i < n) A(i, i) += c;
      if (i > 0 && i < n) A(i, i - 1) = A(i - 1, i) = -c;
    }
    VectorXd const b = VectorXd::NullaryExpr(n, [&] { return number(random); });
    VectorXd const floor = VectorXd::NullaryExpr(n, [&] { return number(random) - 1; });
    Eigen::SparseMatrix<double> const sparse = A.sparseView();
    CAPTURE(seed);
    auto const r = slant::solve(sparse_program(sparse, b, floor), 1e-7);
    CHECK(r.converged());
    VectorXd const e = r.x() - slant::solve(dense_program(A, b, floor, VectorXd()), 1e-7).x();
    // Estimates; 30 times the tolerance is what the adversarial bench calls wrong.
    CHECK(e.dot(A * e) <= 9e-12 * r.x().dot(A * r.x()));
  }
}

TEST_CASE("solve(qp, tolerance): an inverse that A offers preconditions, as it would by hand") {
  membrane const m(40);
  invertible const A{m.A};
  slant::separable_qp const qp{A, m.b, slant::half_lines(m.floor)};
  auto const run = slant::solve(qp, 1e-8);
  CHECK(run.converged());
  CHECK(m.error_at_most(run.x()) <= 1e-7);
  CHECK(run.choice == "A⁻¹ as preconditioner, because A offers it");
  auto const spelled = slant::solve(qp, slant::inverse(A.factors), 1e-8);
  CHECK(run.work.operator_applications == spelled.work.operator_applications);
  CHECK(run.work.operator_applications <
        slant::solve(m.program(), 1e-8).work.operator_applications);
}

TEST_CASE("solve(qp, tolerance): a sparse matrix that levels refuse is solved without") {
  // A node without stiffness, pressed onto its floor.
  membrane m(120);
  m.A.coeffRef(0, 0) = 0;
  m.A.coeffRef(0, 1) = m.A.coeffRef(1, 0) = m.A.coeffRef(0, 120) = m.A.coeffRef(120, 0) = 0;
  m.b(0) = -1;
  auto const run = slant::solve(m.program(), 1e-8);
  CHECK(run.converged());
  CHECK(run.x()(0) == m.floor(0));
  CHECK(run.choice.find("no multigrid, because") != std::string::npos);
}

TEST_CASE("solve(program with equations, tolerance): multigrid where it takes long without") {
  membrane const easy(20), stripes(120, 100);
  for (membrane const* m : {&easy, &stripes}) {
    // The volume above two parts of the membrane is given.
    Eigen::Index const n = m->b.size(), part = n / 4;
    Eigen::SparseMatrix<double> G(2, n);
    for (Eigen::Index j = part; j < 3 * part; ++j) G.insert(j / (2 * part), j) = 1;
    VectorXd const e = static_cast<double>(part) * VectorXd{{-0.05, -0.02}};
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(m->A);
    auto const set = slant::half_lines(m->floor);
    auto const run =
        slant::solve(slant::minimise(slant::quadratic(A, m->b)).over(set).subject_to(G, e), 1e-8);
    CAPTURE(run.reason);
    CHECK(run.converged());
    CHECK((run.choice.find("multigrid, because") != std::string::npos) == (m == &stripes));
    CHECK(run.iterations() <= 20);
    CHECK(run.work.operator_applications <= 1400);  // some 1150 of them before multigrid
    CHECK((G * run.x() - e).norm() <= 1e-6 * e.norm());
    membrane loaded = *m;
    loaded.b -= G.transpose() * run.multipliers;
    CHECK(loaded.error_at_most(run.x()) <= 1e-6);

    // The same in units of unknowns that differ by nine orders of magnitude: x = D y.
    VectorXd const d = VectorXd::NullaryExpr(
        n, [](Eigen::Index i) { return std::exp2(static_cast<double>(i * i % 31) - 15); });
    auto const D = d.asDiagonal();
    Eigen::SparseMatrix<double> const A_in_units = D * m->A * D, G_in_units = G * D;
    auto const B = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A_in_units);
    VectorXd const b = D * m->b;
    auto const Λ = slant::half_lines(VectorXd(m->floor.cwiseQuotient(d)));
    auto const in_units = slant::solve(
        slant::minimise(slant::quadratic(B, b)).over(Λ).subject_to(G_in_units, e), 1e-8);
    CAPTURE(in_units.reason);
    CHECK(in_units.converged());
    CHECK(in_units.choice.starts_with("blocks scaled"));
    CHECK((in_units.choice.find("; multigrid, because") != std::string::npos) == (m == &stripes));
    CHECK(2 * in_units.work.operator_applications <= 3 * run.work.operator_applications);
    CHECK((in_units.multipliers - run.multipliers).norm() <= 1e-6 * run.multipliers.norm());
    loaded.b = m->b - G.transpose() * in_units.multipliers;
    CHECK(loaded.error_at_most(D * in_units.x()) <= 1e-6);
  }
}

TEST_CASE("solve(program with equations, tolerance): rows that only units make alike") {
  // With y = 1e7 x₀ they are (1, 1, 0) and (1, 0, 1).
  Vector3d const x(1e-7, 2, 3);
  MatrixXd const K = Vector3d(1e14, 1, 1).asDiagonal();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  Eigen::SparseMatrix<double> const G = MatrixXd{{1e7, 1, 0}, {1e7, 0, 1}}.sparseView();
  VectorXd const μ{{1, -1}}, b = K * x + G.transpose() * μ, e = G * x;
  auto const set = slant::half_lines(VectorXd::Constant(3, -10));
  auto const run =
      slant::solve(slant::minimise(slant::quadratic(A, b)).over(set).subject_to(G, e), 1e-10);
  CHECK(run.converged());
  CHECK((run.x() - x).cwiseQuotient(x).norm() <= 1e-10);
  CHECK((run.multipliers - μ).norm() <= 1e-9);
}

TEST_CASE("solve(program with equations, tolerance): a large unknown of none of them") {
  MatrixXd const K = VectorXd{{1e-12, 1, 1}}.asDiagonal();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  auto const set = slant::half_lines(VectorXd::Constant(3, -10));
  Eigen::SparseMatrix<double> const G = MatrixXd{{0, 1, 1}}.sparseView();
  VectorXd const b{{1e8, 0.3, 0.5}}, e{{1e-5}};
  auto const p = slant::minimise(slant::quadratic(A, b)).over(set).subject_to(G, e);
  auto const run = slant::solve(p, 1e-8);
  CHECK((!run.converged() || std::abs((G * run.x() - e)[0]) <= 1e-8));
}

TEST_CASE("solve(program with equations, tolerance): corners, rows twice, no stiffness on ker G") {
  auto const run = [](MatrixXd const& K, VectorXd const& b, VectorXd const& l, VectorXd const& u,
                      MatrixXd const& G, VectorXd const& e) {
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(K);
    sparse const rows = G.sparseView();
    auto p = slant::minimise(slant::quadratic(A, b)).over(slant::intervals(l, u));
    return slant::solve(std::move(p).subject_to(rows, e), 1e-8);
  };
  double const oo = infinity;
  auto const corner =
      run(MatrixXd{{1, 2, 2, 0}, {2, 4, 4, 0}, {2, 4, 8, -2}, {0, 0, -2, 1}},
          VectorXd{{-3, -3, 3, -2}}, VectorXd{{-oo, -1, -2, -1}}, VectorXd{{1, 1, -1, -1}},
          MatrixXd{{-2, -1, -1, -2}, {-1, -2, -1, 1}}, VectorXd{{3, 2}});
  CHECK((corner.converged() && (corner.x() - VectorXd{{1, -1, -2, -1}}).norm() <= 1e-8));
  auto const twice = run(
      MatrixXd::Identity(3, 3), VectorXd{{-2, 3, 3}}, VectorXd{{-1, -1, 1}}, VectorXd{{oo, -1, oo}},
      MatrixXd{{2, 1, 2}, {0, 2, 1}, {0, 2, 1}, {0, -1, -2}}, VectorXd{{1, 0, 0, -3}});
  CHECK((twice.converged() && (twice.x() - VectorXd{{-1, -1, 2}}).norm() <= 1e-8));
  auto const soft =
      run(MatrixXd{{5, -3, -4}, {-3, 2, 2}, {-4, 2, 4}}, VectorXd::Zero(3), VectorXd{{0, 0, -2}},
          VectorXd{{oo, oo, 0}}, MatrixXd{{0, 1, -2}, {-1, 0, 2}}, VectorXd::Zero(2));
  CHECK((soft.converged() && soft.x().norm() <= 1e-8));
  auto const one = run(MatrixXd::Zero(1, 1), VectorXd{{2}}, VectorXd{{1}}, VectorXd{{oo}},
                       MatrixXd{{-2}}, VectorXd{{-2}});
  CHECK((one.converged() && one.x()[0] == 1));
  auto const none = run(MatrixXd{{0, 0}, {0, 2}}, VectorXd{{1, -2}}, VectorXd{{0, -1}},
                        VectorXd{{oo, -1}}, MatrixXd{{0, 1}}, VectorXd{{-4}});
  CHECK(none.reason.starts_with("no point of the set satisfies the equality constraints"));
}

TEST_CASE("solve(program with equations, tolerance): rows that are nearly dependent") {
  auto const set = slant::half_lines(VectorXd::Constant(4, -10));
  int converged = 0;
  for (double const δ : {1e-3, 1e-4, 1e-5, 1e-6}) {
    for (double const s : {0.3, 1.0, 3.7}) {
      VectorXd const x{{1, 2 * s, 3, -1}};
      MatrixXd const K = VectorXd{{1, 1000, 2, s}}.asDiagonal();
      MatrixXd const rows{{1, s, 0.3, 0.1}, {1, s + δ, 0.3, 0.1}};
      Eigen::SparseMatrix<double> const G = rows.sparseView();
      VectorXd const e = G * x, b = K * x + G.transpose() * VectorXd{{1, -2}};
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
      if (δ < 1e-5 && s > 3) {  // 7e-8 from the span of the other row
        CHECK_THROWS_AS((void)slant::minimise(slant::quadratic(A, b)).over(set).subject_to(G, e),
                        slant::bad_input);
        continue;
      }
      auto const run =
          slant::solve(slant::minimise(slant::quadratic(A, b)).over(set).subject_to(G, e), 1e-9);
      VectorXd const d = run.x() - x;
      CAPTURE(δ);
      CAPTURE(s);
      CAPTURE(run.reason);
      // δ = 1e-5, s = 3.7: the certificate sees an error of 1e-10 where it is 4e-9.
      if (run.converged()) CHECK(std::sqrt(d.dot(K * d) / x.dot(K * x)) <= 2e-9);
      converged += run.converged();
    }
  }
  CHECK(converged >= 6);
}

TEST_CASE("solve(program with equations, tolerance): a set that is one block") {
  // The point of x₀ + x₁ + x₂ = 1 next to (3, 0, 0) in the unit ball: (1, 0, 0).
  MatrixXd const K = MatrixXd::Identity(3, 3);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  Eigen::SparseMatrix<double> const G = MatrixXd::Ones(1, 3).sparseView();
  VectorXd const b{{3, 0, 0}}, e{{1}};
  auto const run = slant::solve(
      slant::minimise(slant::quadratic(A, b)).over(slant::ball<3>(1.0)).subject_to(G, e), 1e-8);
  CHECK(run.converged());
  CHECK((run.x() - VectorXd{{1, 0, 0}}).norm() <= 1e-7);
}

TEST_CASE("solve(program with equations, tolerance): an unknown without stiffness, any unit of A") {
  Vector3d const x(1, 2, 0);
  Eigen::SparseMatrix<double> const G = MatrixXd{{1, 0, 1}, {0, 1, 1}}.sparseView();
  VectorXd const e = G * x, lower{{-10, -10, 0}};
  auto const set = slant::half_lines(lower);
  for (double const unit : {1.0, 1e100, 1e-100}) {
    MatrixXd const K = unit * Vector3d(1e4, 1, 0).asDiagonal().toDenseMatrix();
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(K);
    VectorXd const μ = unit * Vector2d(1, -1),
                   b = K * x + G.transpose() * μ - unit * Vector3d(0, 0, 1);
    auto const run =
        slant::solve(slant::minimise(slant::quadratic(A, b)).over(set).subject_to(G, e), 1e-8);
    CAPTURE(unit);
    CHECK(run.converged());
    CHECK((run.x() - x).norm() <= 1e-8);
  }
}

TEST_CASE("matrices by rows, and with long indices") {
  MatrixXd const dense{{2, 0.5, 0}, {0.5, 2, 0.5}, {0, 0.5, 2}};
  VectorXd const b{{-1, 0.5, 2}}, zero = VectorXd::Zero(3);
  auto const check = [&](auto const& K) {
    auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
    auto const run = slant::solve(slant::ssnm{slant::separable_qp{A, b, slant::half_lines(3)}},
                                  zero, slant::residual_below(1e-12) || slant::at_most(50));
    auto const x = slant::solve(minimise(quadratic(A, b)).over(slant::half_lines(3)), 1e-10).x();
    CHECK((run.x() - x).norm() <= 1e-9);
  };
  check(Eigen::SparseMatrix<double, Eigen::RowMajor>(dense.sparseView()));
  check(Eigen::SparseMatrix<double, Eigen::ColMajor, long>(dense.sparseView()));
}

}  // namespace solve_program_test
