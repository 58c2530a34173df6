// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_problem.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "support/message.hpp"

namespace friction_problem_test {

using problem = slant::contact::friction_problem<double>;

problem identity(int n, int contacts) {
  problem p{.W = Eigen::SparseMatrix<double>(n, n),
            .q = Eigen::VectorXd::Ones(n),
            .mu = Eigen::VectorXd::Constant(contacts, 0.5)};
  p.W.setIdentity();
  return p;
}

std::string complaint(problem const& p) {
  return test::complaint([&] { p.validate(); });
}

TEST_CASE("sizes tell the dimension") {
  CHECK(identity(4, 2).dimension() == 2);
  CHECK(identity(6, 2).dimension() == 3);
  CHECK(identity(6, 2).contacts() == 2);
  CHECK(problem{}.dimension() == 3);
  CHECK(complaint(problem{}) == "nothing thrown");
  CHECK(complaint(identity(6, 2)) == "nothing thrown");
}

TEST_CASE("what is not valid is named") {
  auto const has = [](problem const& p, char const* part) {
    return complaint(p).find(part) != std::string::npos;
  };
  CHECK(has(identity(5, 2), "size of q"));
  problem p = identity(6, 2);
  p.W.resize(5, 6);
  CHECK(has(p, "rows of W"));
  p = identity(6, 2);
  p.W.resize(6, 7);
  CHECK(has(p, "columns of W"));
  p = identity(6, 2);
  p.q[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(has(p, "q[3]"));
  p = identity(6, 2);
  p.mu[1] = -0.1;
  CHECK(has(p, "mu[1]: got -0.1"));
  p.mu[1] = std::numeric_limits<double>::infinity();
  CHECK(has(p, "mu[1]"));
  p = identity(6, 2);
  p.W.coeffRef(2, 2) = std::numeric_limits<double>::infinity();
  CHECK(has(p, "W(2, 2)"));
}

}  // namespace friction_problem_test
