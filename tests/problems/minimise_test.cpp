// SPDX-License-Identifier: MIT
#include <slant/methods/methods.hpp>

#include <support/testing.hpp>

namespace minimise_test {

TEST_CASE("a program as on paper is separable_qp, with parts kept by the same rule") {
  VectorXd const d{{1.0, 2.0, 4.0}}, b{{-1.0, 4.0, 8.0}};
  auto const A = slant::diagonal<slant::positive_definite>(d);
  auto const set = slant::half_lines(3);
  auto const program = slant::minimise(slant::quadratic(A, b)).over(set);
  using twin = decltype(slant::separable_qp{A, b, set});
  static_assert(std::is_base_of_v<twin, decltype(program)>);
  CHECK(&program.a() == &A);
  CHECK(&program.b() == &b);
  CHECK(&program.set() == &set);
  auto const owner =
      slant::minimise(slant::quadratic(slant::identity(3), 2 * b)).over(slant::half_lines(3));
  CHECK(owner.b() == VectorXd(2 * b));
  CHECK(SLANT_COMPLAINT(slant::minimise(slant::quadratic(A, b)).over(slant::half_lines(2))) ==
        "dimension of the set: got 2, expected the size of b, 3");
}

/// min ½ xᵀA x − bᵀx over x ≥ 0, x₀ + x₁ + x₂ = 3, A = diag(1, 2, 4): the solution is (0, 1, 2) with
/// the multiplier 1, and the bound of x₀ has the force 2.
struct simplex {
  VectorXd const d{{1.0, 2.0, 4.0}}, b{{-1.0, 3.0, 9.0}}, e{{3.0}}, x{{0.0, 1.0, 2.0}};
  Eigen::SparseMatrix<double> const G = MatrixXd::Ones(1, 3).sparseView();
  [[nodiscard]] auto program() const {
    return slant::minimise(slant::quadratic(slant::diagonal<slant::positive_definite>(d), b))
        .over(slant::half_lines(3))
        .subject_to(G, e);
  }
};

TEST_CASE("a program with equations is solved, by solve and by the methods for such") {
  simplex const p;
  auto const program = p.program();
  CHECK(&program.qp().b() == &p.b);
  for (double const tolerance : {1e-3, 1e-12}) {
    auto const run = slant::solve(program, tolerance);
    CHECK(run.converged());
    CHECK(run.reason.starts_with("relative energy error "));
    CHECK(run.choice == "A⁻¹ as preconditioner, because A offers it");
    CHECK((run.x() - p.x).norm() <= 10 * tolerance);
    CHECK(run.multipliers(0) == doctest::Approx(1.0).epsilon(10 * tolerance));
    std::ostringstream out;
    out << run;
    CHECK(out.str().starts_with("converged: " + run.reason + "\n  unknowns               3\n"));
  }
  auto const other =
      slant::solve(slant::smalse{program.qp(), program.constraints()}, test::zeros(3),
                   (slant::reduced_gradient_below(1e-10) && slant::feasibility_below(1e-10)) ||
                       slant::at_most(100));
  CHECK(other.converged());
  CHECK((other.x() - p.x).norm() <= 1e-8);
}

TEST_CASE("what is said of a program with equations that cannot be solved, or not so soon") {
  simplex const p;
  CHECK(slant::solve(p.program(), 1e-12, 0).status == slant::status::iteration_limit);
  CHECK_THROWS_AS(static_cast<void>(slant::solve(p.program(), 1.0)), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(slant::solve(p.program(), 1e-8, -1)), slant::bad_input);
  // No x ≥ 0 has the sum −3.
  auto const run = slant::solve(slant::minimise(slant::quadratic(slant::identity(3), p.b))
                                    .over(slant::half_lines(3))
                                    .subject_to(p.G, VectorXd(-p.e)),
                                1e-8);
  CHECK(run.status == slant::status::stalled);
  CHECK(run.reason == "no point of the set satisfies the equality constraints");
}

TEST_CASE("equations of another size are refused") {
  simplex const p;
  auto const with = [&](Eigen::SparseMatrix<double> const& G, VectorXd const& e) {
    return slant::minimise(slant::quadratic(slant::identity(3), p.b))
        .over(slant::half_lines(3))
        .subject_to(G, e);
  };
  CHECK(SLANT_COMPLAINT(with(MatrixXd::Ones(1, 2).sparseView(), p.e)) ==
        "columns of G: got 2, expected the size of b, 3");
  CHECK(SLANT_COMPLAINT(with(p.G, VectorXd::Ones(2))) == "e: got 2, expected the rows of G, 1");
  CHECK_THROWS_AS(static_cast<void>(with(p.G, VectorXd::Constant(1, NAN))), slant::bad_input);
}

TEST_CASE("a solved program prints what was done") {
  VectorXd const d{{1.0, 2.0, 4.0}}, b{{-1.0, 4.0, 8.0}};
  auto const run = slant::solve(
      slant::minimise(slant::quadratic(slant::diagonal<slant::positive_definite>(d), b))
          .over(slant::half_lines(3)),
      1e-8);
  CHECK((run.x() - VectorXd{{0.0, 2.0, 2.0}}).norm() <= 1e-14);
  std::ostringstream out;
  out << run;
  CHECK(out.str().starts_with("converged: relative energy error "));
  CHECK(out.str().find("\n  unknowns               3\n") != std::string::npos);
  CHECK(out.str().find(std::to_string(run.steps) + " of symmetric_newton\n") != std::string::npos);
  CHECK(out.str().find("applications of A      " +
                       std::to_string(run.work.operator_applications)) != std::string::npos);
}

}  // namespace minimise_test
