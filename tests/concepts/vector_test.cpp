// SPDX-License-Identifier: MIT
//
// A vector whose entries belong to another library: methods and sets use it
// through the Eigen::Map that it keeps.
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>

namespace vector_test {

using own_vector = slant::testing::archetype::vector;

class foreign {
 public:
  using view = Eigen::Map<VectorXd>;

  explicit foreign(std::vector<double> entries)
      : entries_(std::move(entries)), map_(entries_.data(), slant::index(entries_.size())) {}
  explicit foreign(VectorXd const& v) : foreign(std::vector<double>(v.begin(), v.end())) {}
  foreign(foreign const& other) : foreign(other.entries_) {}
  foreign& operator=(foreign const& other) {
    entries_ = other.entries_;
    new (&map_) view(entries_.data(), slant::index(entries_.size()));
    return *this;
  }
  ~foreign() = default;

  [[nodiscard]] view& local() { return map_; }
  [[nodiscard]] view const& local() const { return map_; }
  [[nodiscard]] double inner_product(foreign const& y) const { return map_.dot(y.map_); }
  [[nodiscard]] foreign like(slant::index n) const {
    return foreign(std::vector<double>(static_cast<std::size_t>(n)));
  }

 private:
  std::vector<double> entries_;
  view map_;
};
static_assert(slant::vector<foreign>);

/// tridiag(−1, 3, −1)
struct chain {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  slant::index n;
  [[nodiscard]] slant::index rows() const { return n; }
  [[nodiscard]] slant::index cols() const { return n; }
  template <class X>
  void apply(X const& x, X& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    to = 3 * from;
    to.head(n - 1) -= from.tail(n - 1);
    to.tail(n - 1) -= from.head(n - 1);
  }
};

TEST_CASE("vector: foreign storage gives what Eigen's vectors give") {
  slant::index const n = 10;
  VectorXd const plain_b = VectorXd::LinSpaced(n, -3, 4);
  VectorXd const plain_zero = VectorXd::Zero(n);
  foreign const b(plain_b);
  foreign const zero(plain_zero);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(100);
  auto const x = slant::solve(slant::cg{chain{n}, b}, zero, stop);
  auto const plain_x = slant::solve(slant::cg{chain{n}, plain_b}, plain_zero, stop);
  CHECK(x.converged());
  CHECK(VectorXd(x.x().local()) == plain_x.x());

  auto const set = slant::cartesian(slant::half_lines(4), slant::discs(VectorXd::Constant(3, 0.7)));
  auto const rule = slant::reduced_gradient_below(1e-12) || slant::at_most(1000);
  auto const λ = slant::solve(slant::kprgp{slant::separable_qp{chain{n}, b, set}}, zero, rule);
  auto const plain_λ =
      slant::solve(slant::kprgp{slant::separable_qp{chain{n}, plain_b, set}}, plain_zero, rule);
  CHECK(λ.converged());
  CHECK(VectorXd(λ.x().local()) == plain_λ.x());
}

/// Its own inner product counts, not the dot that it inherits.
struct weighted : VectorXd {
  using VectorXd::VectorXd;
  [[nodiscard]] double inner_product(weighted const& y) const { return 4 * this->dot(y); }
};
struct wordy : VectorXd {
  using VectorXd::VectorXd;
  [[nodiscard]] std::string inner_product(wordy const&) const { return "large"; }
};

TEST_CASE("vector: an own inner product answers for itself, and with a number") {
  weighted const x(VectorXd::Ones(4));
  CHECK(slant::inner_product(x, x) == 16);
  CHECK(slant::norm(x) == 4);
  static_assert(slant::has_inner_product<weighted>);
  static_assert(!slant::has_inner_product<wordy>);
}

TEST_CASE("3-4-5 at every scale, for vectors of Eigen and for vectors of one's own") {
  VectorXd const v{{3.0, 0.0, -4.0}};
  for (int e : {0, -1070, -1000, -540, -500, -250, 250, 500, 540, 1000, 1020}) {
    CAPTURE(e);
    VectorXd const scaled = v.unaryExpr([e](double x) { return std::ldexp(x, e); });
    CHECK(slant::norm(scaled) == std::ldexp(5.0, e));
    CHECK(slant::norm(own_vector(scaled)) == std::ldexp(5.0, e));
  }
}

TEST_CASE("zero, nothing, infinity and NaN stay what they are") {
  auto const both = [](VectorXd const& v, auto check) {
    check(slant::norm(v));
    check(slant::norm(own_vector(v)));
  };
  both(VectorXd::Zero(3), [](double norm) { CHECK(norm == 0); });
  both(VectorXd(), [](double norm) { CHECK(norm == 0); });
  both(VectorXd{{1.0, std::numeric_limits<double>::infinity()}},
       [](double norm) { CHECK(std::isinf(norm)); });
  both(VectorXd{{1.0, std::nan("")}}, [](double norm) { CHECK(std::isnan(norm)); });
  CHECK_THROWS_AS(static_cast<void>(slant::like(Vector3d(1, 2, 3), 0)), std::invalid_argument);
}

}  // namespace vector_test
