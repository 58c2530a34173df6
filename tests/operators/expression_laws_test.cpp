// SPDX-License-Identifier: MIT
//
// Expressions with the laws that a reader would write beside them: exactly those are inferred, all of
// them hold, and A x is what Eigen computes from the matrices.
#include <slant/operators/operators.hpp>

#include <support/testing.hpp>
#include "operators/letters.hpp"

namespace laws_test {

using namespace test::evaluated;
using slant::any_sign, slant::full_column_rank, slant::full_row_rank, slant::identity;
using slant::law_set, slant::positive;

constexpr law_set none{};
constexpr law_set sa = slant::laws<slant::self_adjoint>;
constexpr law_set psd = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
constexpr law_set spd = slant::laws<slant::self_adjoint, slant::positive_definite>;
constexpr law_set pd = slant::laws<slant::positive_definite>;
constexpr law_set semi = slant::laws<slant::positive_semidefinite>;

/// A client's operator: two sizes, one function, its laws.
struct laplacian {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index n;
  [[nodiscard]] Eigen::Index rows() const { return n; }
  [[nodiscard]] Eigen::Index cols() const { return n; }
  void apply(auto const& x, auto& y) const {
    y = 2.5 * x;
    y.topRows(n - 1) -= x.bottomRows(n - 1);
    y.bottomRows(n - 1) -= x.topRows(n - 1);
  }
  [[nodiscard]] MatrixXd matrix() const {
    MatrixXd a = 2.5 * MatrixXd::Identity(n, n);
    a.diagonal(1).setConstant(-1);
    a.diagonal(-1).setConstant(-1);
    return a;
  }
};

/// Factors of K = diag(1, 0) that solve in the range of K.
struct singular_factors {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  void solve(auto const& b, auto& x) const {
    x = b;
    x.row(1).setZero();
  }
};

/// Not a template, which would be compiled for each expression.
void judge(char const* text, std::string const& printed, law_set got, law_set expected,
           MatrixXd const& full, MatrixXd const& matrix) {
  INFO(text, " = ", printed, ": ", slant::expr::laws_text(got));
  CHECK(got == expected);
  CHECK(test::false_laws(full, got) == "");
  CHECK((full - matrix).norm() <= 1e-12 * (1 + matrix.norm()));
}

template <class A>
void expect(law_set expected, char const* text, A const& a, MatrixXd const& matrix) {
  judge(text, to_string(a), slant::laws_of<A>, expected, test::dense_of(a), matrix);
}
#define EXPECT(laws, expression, matrix) expect(laws, #expression, expression, matrix)

TEST_CASE("laws of sums and numbers") {
  SLANT_TEST_LETTERS;
  MatrixXd const id = MatrixXd::Identity(n, n);
  laplacian const L{n};
  EXPECT(spd, S + P, o.S + o.P);
  EXPECT(spd, S / 3, o.S / 3);
  EXPECT(psd, 0 * P, 0 * o.P);
  EXPECT(spd, P + S - (-P), 2 * o.P + o.S);
  EXPECT(spd, positive(1e-3) * I + P, 1e-3 * id + o.P);
  EXPECT(spd, 2 * (3 * (S + P)) / 5, 1.2 * (o.S + o.P));
  EXPECT(pd, T + S, o.T + o.S);
  EXPECT(spd, L + P, L.matrix() + o.P);
  EXPECT(spd, op<"L">(laplacian{n}) + 2 * P, L.matrix() + 2 * o.P);
  EXPECT(sa, G + S + adjoint(G), o.G + o.S + o.G.transpose());
  EXPECT(sa, G * H + adjoint(H) * adjoint(G), o.G * o.H + (o.G * o.H).transpose());
  EXPECT(slant::laws_of<decltype(J)>, +J, o.J);
  EXPECT(spd, op<"W">(S + P), o.S + o.P);
  EXPECT(spd, slant::sum(P, S) + P, o.S + 2 * o.P);
}

TEST_CASE("laws of palindromes") {
  SLANT_TEST_LETTERS;
  auto const Bf = full_row_rank(B);
  auto const W = op<"W">(S - 2 * P);
  auto const here = op(o.G);
  auto const CB = full_row_rank(C * B);
  auto const GH = full_row_rank(G + H);
  auto const counted = slant::counted(B);
  MatrixXd const K = o.K.inverse();
  MatrixXd const BKB = o.B * K * o.B.transpose();
  EXPECT(psd, B * Kinv * adjoint(B), BKB);
  EXPECT(spd, Bf * Kinv * adjoint(B), BKB);
  EXPECT(spd, B * Kinv * adjoint(Bf), BKB);
  EXPECT(spd, CB * Kinv * adjoint(CB), o.C * BKB * o.C.transpose());
  EXPECT(spd, GH * S * adjoint(GH), (o.G + o.H) * o.S * (o.G + o.H).transpose());
  EXPECT(psd, counted * Kinv * adjoint(counted), BKB);
  EXPECT(spd, B * Kinv * adjoint(B) + 1e-3 * identity(m), BKB + 1e-3 * MatrixXd::Identity(m, m));
  EXPECT(psd, 2.0 * B * S * adjoint(B) * 3.0, 6 * o.B * o.S * o.B.transpose());
  EXPECT(psd, C * (B * Kinv * adjoint(B)) * adjoint(C), o.C * BKB * o.C.transpose());
  EXPECT(spd, full_row_rank(C) * Bf * Kinv * adjoint(B) * adjoint(C), o.C * BKB * o.C.transpose());
  EXPECT(spd, Bf * (S + P) * adjoint(B), o.B * (o.S + o.P) * o.B.transpose());
  EXPECT(psd, R * S * adjoint(R), o.R * o.S * o.R.transpose());
  EXPECT(sa, B * Q * adjoint(B), o.B * o.Q * o.B.transpose());
  EXPECT(psd, B * Kinv * G * S * adjoint(G) * Kinv * adjoint(B),
         o.B * K * o.G * o.S * o.G.transpose() * K * o.B.transpose());
  EXPECT(spd, Kinv * S * Kinv, K * o.S * K);
  EXPECT(spd, S * S, o.S * o.S);
  EXPECT(sa, Q * Q * Q, o.Q * o.Q * o.Q);
  EXPECT(psd, S * P * S, o.S * o.P * o.S);
  EXPECT(psd, adjoint(G) * G, o.G.transpose() * o.G);
  EXPECT(spd, adjoint(full_column_rank(G)) * G, o.G.transpose() * o.G);
  EXPECT(spd, adjoint(G) * G + 0.5 * I, o.G.transpose() * o.G + 0.5 * MatrixXd::Identity(n, n));
  EXPECT(spd, adjoint(T) * T, o.T.transpose() * o.T);
  EXPECT(semi, B * T * adjoint(B), o.B * o.T * o.B.transpose());
  EXPECT(pd, Bf * T * adjoint(B), o.B * o.T * o.B.transpose());
  EXPECT(psd, (G + H) * S * adjoint(G + H), (o.G + o.H) * o.S * (o.G + o.H).transpose());
  EXPECT(psd, W * S * W, (o.S - 2 * o.P) * o.S * (o.S - 2 * o.P));
  EXPECT(psd, here * S * adjoint(here), o.G * o.S * o.G.transpose());
  EXPECT(spd, +slant::congruence(full_row_rank(o.B), Kinv), BKB);
  EXPECT(spd, +slant::congruence(Bf, Kinv), BKB);
}

TEST_CASE("independent rows: of a choice of components, of no generalised inverse") {
  SLANT_TEST_LETTERS;
  auto const choice = op<"R">(slant::restriction(n, {5, 0, 2}));
  EXPECT(spd, choice * S * adjoint(choice), o.S({5, 0, 2}, {5, 0, 2}));
  auto const pseudo = inverse(op<"K">(singular_factors{}));
  auto const S2 = op<"S", self_adjoint, positive_definite>(MatrixXd::Identity(2, 2));
  EXPECT(psd, pseudo * S2 * pseudo, MatrixXd(VectorXd::Unit(2, 0).asDiagonal()));
}

TEST_CASE("inverses, diagonals, identities, rewriting") {
  SLANT_TEST_LETTERS;
  MatrixXd const K = o.K.inverse();
  MatrixXd const Dm = o.d.asDiagonal();
  auto const d = op<"D">(D);
  EXPECT(spd, Kinv + P, K + o.P);
  EXPECT(spd, inverse(3 * d), (3 * Dm).inverse());
  EXPECT(spd, D * slant::diagonal<slant::positive_definite>(o.d), Dm * Dm);
  EXPECT(spd, inverse(D * D), (Dm * Dm).inverse());
  EXPECT(sa, D * E, o.d.cwiseProduct(o.e).asDiagonal().toDenseMatrix());
  EXPECT(spd, S * I * I, o.S);
  EXPECT(spd, inverse(d) * S * inverse(d), Dm.inverse() * o.S * Dm.inverse());
  EXPECT(none, inverse(d) * S, Dm.inverse() * o.S);
  EXPECT(slant::laws_of<slant::identity_operator>, I * I, MatrixXd::Identity(n, n));

  auto const same = []<class X, class Y>(X const&, Y const&) { return std::is_same_v<X, Y>; };
  CHECK(same(I * S, S));
  CHECK(same(adjoint(adjoint(G)), G));
  CHECK(same(adjoint(S), S));
  CHECK(same(-(-S), S));
  CHECK(same(inverse(inverse(d)), d));
  CHECK_FALSE(slant::invertible<decltype(Kinv)>);  // factors are no operator
  CHECK(slant::expr::is_letter<decltype(D * E)>);
  CHECK(same(adjoint(B * Kinv * adjoint(B)), B * Kinv * adjoint(B)));
  CHECK(same(C * (B * Kinv), (C * B) * Kinv));
  CHECK(same(G + (S + P), (G + S) + P));
  CHECK(inverse(inverse(d)).object() == d.object());
}

TEST_CASE("laws that must not be inferred") {
  SLANT_TEST_LETTERS;
  MatrixXd const K = o.K.inverse();
  EXPECT(none, G * Kinv * G, o.G * K * o.G);
  EXPECT(none, S * Q, o.S * o.Q);
  EXPECT(none, B * Kinv * adjoint(R), o.B * K * o.R.transpose());
  EXPECT(none, op(o.B) * Kinv * adjoint(op(o.B)), o.B * K * o.B.transpose());
  EXPECT(none, B * Kinv * MatrixXd(o.B.transpose()), o.B * K * o.B.transpose());
  EXPECT(sa, -S, -o.S);
  EXPECT(sa, S - S, 0 * o.S);
  EXPECT(sa, any_sign(2.0) * S, 2 * o.S);
  EXPECT(sa, any_sign(2.0) * B * S * adjoint(B), 2 * o.B * o.S * o.B.transpose());
  EXPECT(sa, I - J, MatrixXd::Identity(n, n) - o.J);
  EXPECT(none, G + G, 2 * o.G);
  EXPECT(none, 2 * G + adjoint(G), 2 * o.G + o.G.transpose());
  EXPECT(none, G + adjoint(G) + adjoint(G), o.G + 2 * o.G.transpose());
  EXPECT(none, S * G * S, o.S * o.G * o.S);
  EXPECT(none, (2 * S + P) * Q * (3 * S + P), (2 * o.S + o.P) * o.Q * (3 * o.S + o.P));
  EXPECT(none, G * S + adjoint(G) * S, (o.G + o.G.transpose()) * o.S);
  EXPECT(none, T * T, o.T * o.T);
  EXPECT(none, G * S * adjoint(G) * S, o.G * o.S * o.G.transpose() * o.S);
  EXPECT(psd, 0.5 * J, 0.5 * o.J);
  EXPECT(psd, J + J, 2 * o.J);
  EXPECT(none, G * slant::distinct(G), o.G * o.G);
  EXPECT(none, slant::verbatim(G) * adjoint(G), o.G * o.G.transpose());
}

TEST_CASE("what expressions can do besides A x agrees with their matrices") {
  SLANT_TEST_LETTERS;
  auto const here = op(o.G);
  CHECK(test::disagreement(test::results_of(2 * G)) <= 1e-14);
  CHECK(test::disagreement(test::results_of(adjoint(G))) <= 1e-14);
  CHECK(test::disagreement(test::results_of(G - 3 * adjoint(H) + D)) <= 1e-14);
  CHECK(test::disagreement(test::results_of(B * Kinv * G)) <= 1e-14);
  CHECK(test::disagreement(test::results_of(-(C * (B * Kinv * adjoint(B) + 2 * N)))) <= 1e-14);
  CHECK(test::disagreement(test::results_of(Kinv + here * H)) <= 1e-14);
  CHECK(test::disagreement(test::results_of(inverse(3 * op<"D">(D)))) <= 1e-14);
}

}  // namespace laws_test
