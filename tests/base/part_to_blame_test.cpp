// SPDX-License-Identifier: MIT
#include <slant/operators/operators.hpp>

#include <support/testing.hpp>

namespace part_to_blame_test {

using Eigen::VectorXf;

/// Two rows and columns, on vectors of type V.
template <class V>
struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  [[nodiscard]] Eigen::Index cols() const { return 2; }
  void apply(V const& x, V& y) const { y = 2 * x; }
};
using good = twice<VectorXd>;
using bad = twice<VectorXf>;

struct returning_adjoint {
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  [[nodiscard]] Eigen::Index cols() const { return 2; }
  void apply(VectorXd const& x, VectorXd& y) const { y = x; }
  [[nodiscard]] VectorXd apply_adjoint(VectorXd const& x) const { return x; }
};
struct returning_solve {
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  [[nodiscard]] VectorXd solve(VectorXd const& b) const { return b; }
};
struct without_apply {
  [[nodiscard]] Eigen::Index rows() const { return 2; }
  [[nodiscard]] Eigen::Index cols() const { return 2; }
};

template <class A>
using about = slant::detail::questions_about<std::remove_cvref_t<A>, VectorXd>;

template <class Part, class A>
bool blames(A const&) {
  using asked = about<A>;
  bool const itself = std::is_same_v<Part, A>;
  CHECK(slant::linear_operator<typename asked::whole, VectorXd> == !itself);
  CHECK(slant::detail::usable_part<typename asked::part, VectorXd> == itself);
  CHECK(slant::spd_operator<typename asked::promise, VectorXd>);  // not asked yet
  return std::is_same_v<typename asked::blamed, Part>;
}

TEST_CASE("part_to_blame: nothing is asked of an operator that works") {
  using asked = about<decltype(slant::sum(good{}, good{}))>;
  CHECK(slant::linear_operator<typename asked::whole, VectorXd>);
  CHECK(slant::detail::usable_part<typename asked::part, VectorXd>);
  // … except its laws.
  CHECK(std::is_same_v<typename asked::promise, decltype(slant::sum(good{}, good{}))>);
}

TEST_CASE("part_to_blame: what has no parts is itself to blame") {
  CHECK(blames<bad>(bad{}));
  CHECK(blames<without_apply>(without_apply{}));
}

TEST_CASE("part_to_blame: the innermost part that does not work") {
  CHECK(blames<bad>(slant::sum(good{}, bad{})));
  CHECK(blames<bad>(slant::product(slant::adjoint(bad{}), good{})));
  CHECK(blames<bad>(slant::congruence(good{}, slant::scaled(2.0, bad{}))));
  CHECK(blames<bad>(slant::sum(good{}, slant::scaled(2.0, slant::difference(good{}, bad{})))));
  CHECK(blames<bad>(slant::declare<slant::self_adjoint>(slant::counted(bad{}))));
  CHECK(blames<bad>(slant::block_diagonal(good{}, bad{})));
  CHECK(blames<returning_solve>(slant::congruence(good{}, slant::inverse(returning_solve{}))));
}

TEST_CASE("part_to_blame: a part without a usable adjoint, if nothing else is wrong") {
  CHECK(blames<returning_adjoint>(slant::adjoint(returning_adjoint{})));
  CHECK(blames<returning_adjoint>(slant::congruence(returning_adjoint{}, good{})));
  CHECK(blames<bad>(slant::sum(returning_adjoint{}, bad{})));
}

TEST_CASE("part_to_blame: all questions are answered if the vectors are what is wrong") {
  using asked = slant::detail::questions_about<bad, decltype(2 * VectorXd())>;
  CHECK(slant::linear_operator<typename asked::whole, typename asked::vector_type>);
  CHECK(slant::detail::usable_part<typename asked::part, typename asked::vector_type>);
  CHECK(slant::spd_operator<typename asked::promise, typename asked::vector_type>);
}

}  // namespace part_to_blame_test
