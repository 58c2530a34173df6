// SPDX-License-Identifier: MIT
//
// What is refused, printed, found by lookup; handles.
#include <slant/krylov/cg.hpp>
#include <slant/operators/counted.hpp>
#include <slant/operators/describe.hpp>
#include <slant/operators/range_sum.hpp>
#include <slant/slanting/arithmetic.hpp>

#include <support/testing.hpp>
#include "operators/letters.hpp"

// Names of a client that it calls without a namespace: for formulas it gets its own functions, not
// what the library is made of.
namespace client {

template <class A>
slant::index negate(A const& a) {
  return a.rows();
}
template <class A, class B>
slant::index multiply(A const& a, B const& b) {
  return a.rows() + b.rows();
}
template <class A, class X, class Y, class W>
slant::index run(A const& a, X const&, Y&, W&) {
  return a.rows();
}

template <class A>
slant::index all(A const& a) {
  int y = 0, w = 0;
  return negate(a) + multiply(a, a) + run(a, 0, y, w);
}

}  // namespace client

namespace syntax_test {

using namespace test::evaluated;
using slant::identity;

struct foreign {
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  [[nodiscard]] Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = x; }
};

template <class A, class B> concept multiplies = requires(A const& a, B const& b) { a* b; };
template <class A, class B> concept adds = requires(A const& a, B const& b) { a + b; };

TEST_CASE("functions of a client are not mixed up with those of the library") {
  MatrixXd const m = MatrixXd::Identity(2, 2);
  auto const A = slant::op<"A">(m);
  CHECK(client::all(A) == 8);
  CHECK(client::all(2 * A + A) == 8);
}

TEST_CASE("which operands find the operators, and which do not") {
  using L = decltype(slant::op<"L">(foreign{}));
  using B = decltype(slant::op<"B">(MatrixXd()));
  static_assert(!multiplies<foreign, foreign> && !adds<foreign, MatrixXd>);
  static_assert(multiplies<foreign, slant::identity_operator> && multiplies<L, foreign>);
  static_assert(multiplies<B, MatrixXd> && multiplies<Eigen::SparseMatrix<double>, B>);
  static_assert(multiplies<B, VectorXd> && !multiplies<VectorXd, B>);
  static_assert(!adds<B, double> && !multiplies<B, std::string>);
  static_assert(!multiplies<B, slant::law_set>);
  // Functions stay functions, Eigen's objects Eigen's.
  static_assert(slant::slanting_map<decltype(std::declval<B>() * slant::identity_map{2})>);
  static_assert(!slant::expression<decltype(std::declval<MatrixXd>() * std::declval<MatrixXd>())>);
  static_assert(slant::eigen_matrix<decltype(std::declval<VectorXd&>().head(3))>);
  static_assert(!slant::operand<Eigen::MatrixXcd>);  // Aᵀ would not be the adjoint
}

TEST_CASE("what is refused, in a sentence that names it") {
  SLANT_TEST_LETTERS;
  auto const here = [](MatrixXd const& a) { return op(a); };
  CHECK(SLANT_COMPLAINT(op<"B">(o.B) * Kinv * adjoint(op<"B">(o.R))) ==
        "B: got two different objects, expected one object: a name stands for one operator");
  CHECK(SLANT_COMPLAINT(op<"A">(o.S) + op<"A">(o.P)) ==
        "A: got two different objects, expected one object: a name stands for one operator");
  CHECK(SLANT_COMPLAINT(here(o.G) * adjoint(here(o.H))) ==
        "an operator: got two different objects made by one op(…), one of them as an adjoint, "
        "expected one object, or op<\"name\">(…), or distinct(…) of one of them");
  auto const g = here(o.G), h = here(o.H);
  CHECK_THROWS_AS((void)(slant::counted(g) * adjoint(slant::counted(h))), slant::bad_input);
  CHECK_NOTHROW((void)(g + h + adjoint(h) + adjoint(g)));
  CHECK_THROWS_AS((void)(g + h + adjoint(h) + adjoint(h)), slant::bad_input);
  CHECK_NOTHROW((void)(g * h + g * adjoint(distinct(h))));
  CHECK_NOTHROW((void)(op<"B">(o.B) * adjoint(op<"B">(o.B)) + B * adjoint(op<"B">(B))));
  CHECK(SLANT_COMPLAINT(-2.0 * S) ==
        "c: got -2, expected a number > 0 in front of a definite operator; for others write "
        "-(c * A) or any_sign(c) * A");
  CHECK(SLANT_COMPLAINT(0.0 * S).starts_with("c: got 0, expected a number > 0"));
  CHECK(SLANT_COMPLAINT(-2.0 * B * S * adjoint(B))
            .starts_with("c: got -2, expected a number >= 0 in front of a semidefinite"));
  CHECK_NOTHROW((void)(-(2.0 * S)));
  CHECK(SLANT_COMPLAINT(std::nan("") * G) == "c: got nan, expected a finite number");
  CHECK(SLANT_COMPLAINT(1e-200 * (1e-200 * S))
            .starts_with("c: got 1e-200 * 1e-200, expected numbers whose product is in the range"));
  VectorXd const e = VectorXd::Unit(n, 0);
  CHECK(VectorXd(1e290 * VectorXd((1e-165 * G) / 1e-20 * ((1e-165 * G) / 1e-20) * e))
            .isApprox(VectorXd(G * (G * e)), 1e-12));
  CHECK(SLANT_COMPLAINT((1e160 * S) / 1e-160).starts_with("c: got 1e+160 * 1e+160, expected"));
  CHECK(SLANT_COMPLAINT(1e-200 * G / 1e200).starts_with("c: got 1e-200 * 1e-200, expected"));
  CHECK(SLANT_COMPLAINT(S / 0.0) == "c: got 0, expected a number with a finite reciprocal");
  CHECK(SLANT_COMPLAINT(B * S * B) == "B: got 4 x 7, expected 7 rows (the columns of B S)");
  CHECK(SLANT_COMPLAINT(B + S) == "S: got 7 x 7, expected 4 x 7 (the size of B)");
  CHECK(SLANT_COMPLAINT(S * identity(3)) == "I: got 3 x 3, expected 7 rows (the columns of S)");
  CHECK(SLANT_COMPLAINT(full_row_rank(adjoint(B))) ==
        "B: got 7 x 4, expected at most as many rows as columns (independent rows)");
  CHECK(SLANT_COMPLAINT(full_column_rank(B)) ==
        "B: got 4 x 7, expected at most as many columns as rows");
}

std::string text(auto const& a) {
  return (std::ostringstream() << a).str();
}

TEST_CASE("printing") {
  SLANT_TEST_LETTERS;
  CHECK(text(B * Kinv * adjoint(B) + 1e-3 * identity(m)) == "B K⁻¹ Bᵀ + 0.001 I   (4 × 4, spd)");
  CHECK(text(-G) == "−G   (7 × 7, no laws)");
  CHECK(text(S - 2 * P) == "S − 2 P   (7 × 7, self-adjoint)");
  CHECK(text(-2 * G * H) == "−2 G H   (7 × 7, no laws)");
  CHECK(text(2 * (S - P) * G) == "2 (S − P) G   (7 × 7, no laws)");
  CHECK(text(adjoint(B * Kinv * G)) == "Gᵀ K⁻¹ Bᵀ   (7 × 4, no laws)");
  CHECK(text(op<"F">(foreign{}) + foreign{}) == "F + foreign   (2 × 2, no laws)");
  CHECK(text(+J) == "J   (7 × 7, orthogonal projector)");
  CHECK(text(T + o.H) == "T + matrix   (7 × 7, no laws)");
  auto const minus = slant::congruence(o.B, -S);
  CHECK(to_string(C * minus) == "C (−matrix S matrixᵀ)");
  CHECK(to_string(-minus) == "−(−matrix S matrixᵀ)");
  CHECK(to_string(N + minus) == "N − matrix S matrixᵀ");
  CHECK(to_string(G * slant::congruence(I, S + P)) == "G (S + P)");
  CHECK(slant::expr::formula_of<decltype(C * minus)>().view() ==
        "C * (-matrix * S * adjoint(matrix))");
}

TEST_CASE("what declares, asserts or counts is printed as the operator behind it") {
  SLANT_TEST_LETTERS;
  auto const symmetric = slant::declare<self_adjoint>(G);
  auto const formula = slant::declare<self_adjoint>(G * H);
  auto const transposed = slant::declare<slant::positive_semidefinite>(adjoint(G));
  CHECK(to_string(B * symmetric * adjoint(B)) == "B G Bᵀ");
  CHECK(to_string(B * formula * adjoint(B)) == "B (G H) Bᵀ");
  CHECK(to_string(S + slant::counted(formula)) == "S + (G H)");
  CHECK(to_string(G * transposed) == "G Gᵀ");
  CHECK(to_string(adjoint(transposed) * G) == "(Gᵀ)ᵀ G");
  CHECK(to_string(slant::full_row_rank(slant::matrix(o.B)) * S) == "matrix S");
  CHECK(to_string(slant::verbatim(S + P) * G) == "(S + P) G");
  using slant::expr::formula_of;
  CHECK(formula_of<decltype(adjoint(transposed) * formula)>().view() ==
        "adjoint(adjoint(G)) * (G * H)");
  // So a name inside must stand for one object, too.
  CHECK(SLANT_COMPLAINT(op<"A">(o.S) + slant::declare<self_adjoint>(op<"A">(o.P))) ==
        "A: got two different objects, expected one object: a name stands for one operator");
}

TEST_CASE("what has no name is printed by its kind, and so is what holds many operators") {
  SLANT_TEST_LETTERS;
  auto const saddle =
      slant::block(slant::block_row(S, adjoint(B)), slant::block_row(B, slant::zero(m)));
  CHECK(text(saddle) == "block_operator   (11 × 11, no laws)");
  CHECK(text(op<"C">(saddle)) == "C   (11 × 11, no laws)");
  CHECK(text(slant::counted(S + P)) == "S + P   (7 × 7, spd)");
  CHECK(text(slant::declare<self_adjoint>(G)) == "G   (7 × 7, self-adjoint)");
  CHECK(text(slant::restricted(S, {0, 3})) == "restriction S restrictionᵀ   (2 × 2, spd)");
  CHECK(slant::describe(saddle).find("block_operator   11 × 11, no laws") == 0);

  auto const product = slant::kronecker(S, identity(3));  // its workspace has six members
  CHECK(slant::describe(product).find("kronecker_operator   21 × 21, spd, workspace ") == 0);
  CHECK(slant::describe(product + slant::identity(21)).find("21 × 21, spd, workspace ") !=
        std::string::npos);
}

TEST_CASE("describe") {
  SLANT_TEST_LETTERS;
  auto const Kc = op<"K">(slant::counted(Kinv));
  auto const A = B * Kc * adjoint(B) - identity(m);
  VectorXd const x = VectorXd::Ones(m), y = A * x;
  CHECK(describe(A) ==
        "B K Bᵀ − I   4 × 4, self-adjoint, workspace 112 bytes\n"
        "│  not positive_semidefinite: in the term -I, a minus stands before I\n"
        "├─ B K Bᵀ   4 × 4, psd, workspace 112 bytes\n"
        "│  │  not positive_definite: the rows of B may be dependent: assert full_row_rank(B)\n"
        "│  ├─ B   4 × 7, no laws, matrix_operator, 28 entries\n"
        "│  ├─ K   7 × 7, spd, counted_operator, 1 applications\n"
        "│  └─ Bᵀ   7 × 4, no laws, matrix_operator, 28 entries\n"
        "└─ −I   4 × 4, self-adjoint\n"
        "   │  not positive_semidefinite: a minus stands before I\n"
        "   └─ I   4 × 4, identity, identity_operator\n");
  CHECK(describe(G * Kinv * G).find("│  not self_adjoint: G at the end is not adjoint(G)\n") !=
        std::string::npos);
  CHECK(describe(G + H + adjoint(G)).find("in the term H, H does not") != std::string::npos);
  CHECK(describe(op<"W">(S + P)).find("└─ S + P   7 × 7, spd") != std::string::npos);
  auto const many = slant::sum(std::vector{slant::distinct(Kc), slant::distinct(Kc)});
  CHECK(describe(many).find("workspace 0 bytes") == std::string::npos);
  CHECK(y.isApprox(o.B * o.K.inverse() * o.B.transpose() * x - x, 1e-12));
}

/// Letters own what they were made of as an rvalue, and a method a copy of the expression.
auto made_in_a_function(MatrixXd const& B, MatrixXd const& K, VectorXd const& b) {
  auto const Bop = slant::op<"B">(B);
  auto const Kinv = inverse(slant::op<"K">(slant::dense_ldlt(K)));
  auto const A = Bop * Kinv * adjoint(Bop) + 0.5 * identity(B.rows());
  return slant::cg{A, b};
}

TEST_CASE("expressions are handles: nothing dangles but what was named by an lvalue") {
  SLANT_TEST_LETTERS;
  VectorXd const b = VectorXd::LinSpaced(m, 1, 2);
  auto const cg = made_in_a_function(o.B, o.K, b);
  auto s = cg.start(VectorXd::Zero(m));
  for (int i = 0; i < m; ++i) cg.step(s);
  VectorXd const expected =
      (o.B * o.K.inverse() * o.B.transpose() + 0.5 * MatrixXd::Identity(m, m)).ldlt().solve(b);
  CHECK((s.x - expected).norm() <= 1e-12 * expected.norm());
  static_assert(slant::handle<decltype(B)&> && !slant::handle<MatrixXd>);
}

}  // namespace syntax_test
