// SPDX-License-Identifier: MIT
//
// The law checks must find operators that lie: one liar per law, and honest operators that pass.
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace operator_laws_test {

using namespace test::evaluated;
namespace archetype = slant::testing::archetype;
using archetype::vector;

/// Whether a breach of a law whose name begins like this is found.
template <class A>
bool finds(A const& a, std::string const& law) {
  for (auto const& broken : slant::testing::operator_breaches(a))
    if (broken.law.rfind(law, 0) == 0) return true;
  return false;
}

MatrixXd random_matrix(Eigen::Index n) {
  std::srand(7);
  return MatrixXd::Random(n, n);
}
MatrixXd orthogonal(Eigen::Index n) {
  return test::orthonormal(random_matrix(n));
}
/// Symmetric with these eigenvalues.
MatrixXd with_eigenvalues(VectorXd const& λ) {
  MatrixXd const q = orthogonal(λ.size());
  MatrixXd const m = q * λ.asDiagonal() * q.transpose();
  return (m + m.transpose()) / 2;
}

/// Applies a matrix; the liars below add one wrong member each.
struct honest {
  MatrixXd m;
  [[nodiscard]] Eigen::Index rows() const { return m.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return m.cols(); }
  void apply(VectorXd const& x, VectorXd& y) const { y.noalias() = m * x; }
};

struct affine : honest {
  void apply(VectorXd const& x, VectorXd& y) const { y = (m * x).array() + 1e-6; }
};
struct accumulating : honest {
  void apply(VectorXd const& x, VectorXd& y) const { y += m * x; }
};
struct partly_written : honest {
  void apply(VectorXd const& x, VectorXd& y) const {
    y.tail(rows() - 1) = (m * x).tail(rows() - 1);
  }
};
struct not_a_number : honest {
  void apply(VectorXd const& x, VectorXd& y) const { y = std::sqrt(-1.0) * x; }
};
struct wrong_size : honest {
  void apply(VectorXd const& x, VectorXd& y) const { y = x.head(cols() - 1); }
};
struct remembering : honest {
  struct memory {
    double last = 0;
  };
  [[nodiscard]] memory workspace(VectorXd const&) const { return {}; }
  void apply(VectorXd const& x, VectorXd& y, memory& w) const {
    y = m * x + w.last * VectorXd::Ones(rows());
    w.last = 1e-3;
  }
};
struct wrong_adjoint : honest {
  void apply_adjoint(VectorXd const& x, VectorXd& y) const { y = m * x; }
};
struct wrong_accumulation : honest {
  void apply_add(double, VectorXd const& x, VectorXd& y) const { y += m * x; }
};
struct wrong_adjoint_accumulation : honest {
  void apply_adjoint(VectorXd const& x, VectorXd& y) const { y = m.transpose() * x; }
  void apply_adjoint_add(double α, VectorXd const& x, VectorXd& y) const {
    y = α * (m.transpose() * x);
  }
};
struct wrong_diagonal : honest {
  void diagonal(VectorXd& d) const {
    d = m.diagonal();
    d[3] *= 1 + 1e-9;
  }
};
struct wrong_columns : honest {
  void columns(slant::index first, MatrixXd& y) const {
    y = m.middleRows(first, y.cols()).transpose();
  }
};
struct wrong_inverse : honest {
  [[nodiscard]] honest inverse() const { return {m.transpose()}; }
};
struct wrong_for_many {
  MatrixXd m;
  [[nodiscard]] Eigen::Index rows() const { return m.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return m.cols(); }
  void apply(auto const& x, auto& y) const {
    y = m * x;
    if (y.cols() > 1) y.col(1) = y.col(0);
  }
};

/// Takes every storage order for that of MatrixXd.
struct wrong_by_rows {
  MatrixXd m;
  [[nodiscard]] Eigen::Index rows() const { return m.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return m.cols(); }
  void apply(auto const& x, auto& y) const {
    Eigen::Map<MatrixXd>(y.data(), y.rows(), y.cols()) = m * x;
  }
};

/// tridiag(−1, 2, −1) with a temporary that all threads share.
struct with_shared_temporary {
  Eigen::Index n;
  mutable VectorXd t = VectorXd::Zero(n);
  [[nodiscard]] Eigen::Index rows() const { return n; }
  [[nodiscard]] Eigen::Index cols() const { return n; }
  void apply(VectorXd const& x, VectorXd& y) const {
    t = x;
    y = 2 * t;
    y.head(n - 1) -= t.tail(n - 1);
    y.tail(n - 1) -= t.head(n - 1);
  }
};

template <slant::law... L>
struct declaring : honest {
  static constexpr auto laws = slant::laws<L...>;
};

TEST_CASE("honest operators pass") {
  slant::testing::check_operator_laws(honest{random_matrix(7)});
  slant::testing::check_operator_laws(declaring<slant::self_adjoint, slant::positive_definite>{
      {with_eigenvalues(VectorXd::LinSpaced(40, 1e-9, 1))}});
  slant::testing::check_operator_laws(slant::identity(0));
}

TEST_CASE("units do not matter") {
  for (double const scale : {1e-150, 1e150}) {
    MatrixXd const m = scale * with_eigenvalues(VectorXd::LinSpaced(20, 0.1, 1));
    slant::testing::check_operator_laws(
        declaring<slant::self_adjoint, slant::positive_definite>{{m}});
    CHECK(finds(declaring<slant::self_adjoint>{{scale * random_matrix(5)}}, "self_adjoint"));
    CHECK(finds(declaring<slant::positive_definite>{{-m}}, "positive_definite"));
  }
}

TEST_CASE("liars about apply are found") {
  MatrixXd const m = random_matrix(6);
  CHECK(finds(affine{{m}}, "linearity"));
  CHECK(finds(accumulating{{m}}, "overwriting"));
  CHECK(finds(partly_written{{m}}, "overwriting"));
  CHECK(finds(not_a_number{{m}}, "apply"));
  CHECK(finds(wrong_size{{m}}, "apply"));
  CHECK(finds(remembering{{m}}, "repeatability"));
}

TEST_CASE("an operator that is not safe beside another thread is found") {
  // One look may fail on a machine that has no second core to spare; twenty do not.
  for (Eigen::Index const n : {10, 100, 1000}) {
    CAPTURE(n);
    int looks = 0;
    bool found = false;
    while (!found && looks++ < 20) found = finds(with_shared_temporary{n}, "repeatability, beside");
    CHECK(found);
  }
}

TEST_CASE("liars about capabilities are found") {
  MatrixXd const m = random_matrix(6);
  CHECK(finds(wrong_adjoint{{m}}, "adjoint"));
  CHECK(finds(wrong_accumulation{{m}}, "apply_add"));
  CHECK(finds(wrong_adjoint_accumulation{{m}}, "apply_adjoint_add"));
  CHECK(finds(wrong_diagonal{{m}}, "diagonal"));
  CHECK(finds(wrong_columns{{m}}, "columns"));
  CHECK(finds(wrong_inverse{{m}}, "inverse"));
  CHECK(finds(wrong_for_many{m}, "A [x1 x2 x3]"));
  CHECK(finds(wrong_by_rows{m}, "stored by rows"));
}

TEST_CASE("liars about laws are found") {
  using namespace slant;
  CHECK(finds(declaring<self_adjoint>{{random_matrix(6)}}, "self_adjoint"));
  CHECK(finds(declaring<self_adjoint>{{MatrixXd::Ones(2, 3)}}, "laws"));

  SUBCASE("one slightly negative eigenvalue among a hundred") {
    VectorXd λ = VectorXd::LinSpaced(100, 0.5, 1);
    λ[0] = -1e-6;
    CHECK(finds(declaring<self_adjoint, positive_semidefinite>{{with_eigenvalues(λ)}},
                "positive_semidefinite"));
    CHECK(finds(declaring<self_adjoint, positive_definite>{{with_eigenvalues(λ)}},
                "positive_definite"));
    λ[0] = 0;  // semidefinite, not definite
    CHECK(
        !finds(declaring<self_adjoint, positive_semidefinite>{{with_eigenvalues(λ)}}, "positive"));
    CHECK(finds(declaring<self_adjoint, positive_definite>{{with_eigenvalues(λ)}},
                "positive_definite"));
  }
  SUBCASE("an indefinite symmetric part") {
    MatrixXd m = MatrixXd::Identity(8, 8);
    m(0, 7) = 2 + 1e-6;  // the least eigenvalue of the symmetric part is 1 − m(0, 7) / 2
    CHECK(finds(declaring<positive_definite>{{m}}, "positive_definite"));
    m(0, 7) = 2 - 1e-6;
    CHECK(!finds(declaring<positive_definite>{{m}}, "positive_definite"));
  }
  SUBCASE("projectors and firm nonexpansiveness") {
    VectorXd λ = VectorXd::Zero(30);
    λ.head(7).setOnes();
    CHECK(!finds(declaring<self_adjoint, projector>{{with_eigenvalues(λ)}}, "projector"));
    CHECK(!finds(declaring<self_adjoint, projector>{{with_eigenvalues(λ)}}, "firmly"));
    λ[11] = 1e-7;
    CHECK(finds(declaring<self_adjoint, projector>{{with_eigenvalues(λ)}}, "projector"));
    λ = VectorXd::LinSpaced(100, 0, 1);
    CHECK(!finds(declaring<self_adjoint, firmly_nonexpansive>{{with_eigenvalues(λ)}}, "firmly"));
    λ[99] = 1 + 1e-9;
    CHECK(finds(declaring<self_adjoint, firmly_nonexpansive>{{with_eigenvalues(λ)}}, "firmly"));
  }
}

template <class V> concept has_element_access = requires(V& v) { v[0]; };
template <class V>
concept has_arithmetic = requires(V& v) { v + v; } || requires(V& v) { v *= 2.0; };

static_assert(slant::vector<vector> && slant::vector<archetype::basic_vector<float>>);
static_assert(!has_element_access<vector> && !has_arithmetic<vector>);
static_assert(!std::is_default_constructible_v<vector> && !std::is_convertible_v<VectorXd, vector>);

template <class A>
inline constexpr bool is_bare =
    slant::linear_operator<A, vector> && !slant::linear_operator<A, VectorXd> &&
    !slant::has_workspace<A, vector> && !slant::has_accumulate<A, vector> &&
    !slant::has_diagonal<A, vector> && !slant::has_columns<A, MatrixXd> &&
    !slant::has_inverse<A, vector> && !slant::applies_to_many<A, MatrixXd>;

static_assert(is_bare<archetype::linear_operator> && is_bare<archetype::spd_operator>);
static_assert(!slant::has_adjoint<archetype::linear_operator, vector>);
static_assert(slant::self_adjoint_operator<archetype::self_adjoint_operator, vector> &&
              !slant::psd_operator<archetype::self_adjoint_operator, vector>);
static_assert(slant::psd_operator<archetype::psd_operator, vector> &&
              !slant::spd_operator<archetype::psd_operator, vector>);
static_assert(slant::has_plain_solve<archetype::factorization, vector> &&
              !slant::has_cols<archetype::factorization> &&
              !slant::factorization<archetype::factorization, VectorXd>);

TEST_CASE("archetypes keep their word") {
  vector const prototype{VectorXd()};
  MatrixXd m = MatrixXd::Identity(3, 3);
  slant::testing::check_operator_laws(archetype::spd_operator(m), prototype);
  m(2, 2) = 0;
  slant::testing::check_operator_laws(archetype::psd_operator(m), prototype);
  m(2, 2) = -1;
  slant::testing::check_operator_laws(archetype::self_adjoint_operator(m), prototype);
  m(0, 2) = 5;
  slant::testing::check_operator_laws(archetype::operator_with_adjoint(m), prototype);

  vector const b(VectorXd(VectorXd::LinSpaced(3, 1, 3)));
  vector x = slant::like(b, 3);
  archetype::factorization(m).solve(b, x);
  CHECK((m * x.local() - b.local()).norm() < 1e-14);
}

}  // namespace operator_laws_test
