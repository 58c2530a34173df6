// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/tail.hpp>

#include <support/testing.hpp>
#include "factorizations/tail_factor.hpp"

namespace tail_test {

using slant::index;
namespace detail = slant::detail;

TEST_CASE("what the shape counts") {
  test::tail_factor const f;
  CHECK(f.shape->size() == 44);
  CHECK(f.shape->panels() == 1 + 1 + 3 + 2);
  CHECK(f.shape->height() == 33);
  CHECK(f.shape->entries() == 6 + 15 + 36 + 16 + 231 + 252 + 78);
  CHECK(f.columns().bytes() == 8 * f.shape->entries());
}

TEST_CASE("solves as by the dense factor, one or several right-hand sides, without allocations") {
  test::tail_factor const f;
  auto const columns = f.columns();
  detail::tail_panels<float> const floats(columns);
  for (index const k : {1, 3, 4, 6}) {
    MatrixXd const b = MatrixXd::Random(f.shape->size(), k);
    MatrixXd const x = f.solved(b);
    detail::tail_vectors<double> v(*f.shape, k);
    detail::tail_vectors<float> single(*f.shape, k);
    v.x = b;
    single.x = b.cast<float>();
    slant::testing::allocation_guard guard;
    detail::solve_in_place(columns, v);
    detail::solve_in_place(floats, single);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK((v.x - x).norm() < 1e-13 * x.norm());
    CHECK((single.x.cast<double>() - x).norm() < 1e-5 * x.norm());
  }
}

TEST_CASE("where right-hand sides begin with zeros, the rest of the solution is computed alone") {
  test::tail_factor const f;
  auto const columns = f.columns();
  for (index first = 0; first < f.shape->size(); ++first) {
    MatrixXd b = MatrixXd::Random(f.shape->size(), 5);
    b.topRows(first).setZero();
    MatrixXd const x = f.solved(b);
    detail::tail_vectors<double> v(*f.shape, 5);
    v.x = b;
    detail::solve_in_place(columns, v, first);
    index const rest = f.shape->size() - first;
    CHECK((v.x - x).bottomRows(rest).norm() < 1e-13 * x.norm());
  }
}

TEST_CASE("entries that floats cannot hold become their largest number or zero") {
  auto shape = std::make_shared<detail::tail_shape>();
  shape->add(1, std::vector<int>{1, 2, 3});
  shape->add(3, std::vector<int>{});
  auto block = std::make_shared<std::vector<MatrixXd>>();
  block->push_back((MatrixXd(4, 1) << 1, 1e300, 1e-43, -1e-20).finished());
  block->push_back(MatrixXd::Identity(3, 3));
  std::vector<detail::tail_columns::matrix> const places{{(*block)[0].data(), 4},
                                                         {(*block)[1].data(), 3}};
  detail::tail_panels<float> const floats(detail::tail_columns(shape, places, block));
  auto const panel = floats.panel(shape->supernodes()[0], 0);
  CHECK(panel.below.column[0][0] == std::numeric_limits<float>::max());
  CHECK(panel.below.column[0][1] == 0);
  CHECK(panel.below.column[0][2] == -1e-20f);
}

TEST_CASE("rows and columns of the dense inverse, whichever unknowns are asked for") {
  test::tail_factor const f;
  MatrixXd const inverse = f.solved(MatrixXd::Identity(44, 44));
  std::vector<int> all(44);
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> const choices{all, {0}, {43}, {5, 6, 7, 20}, {0, 9, 13, 31, 32, 43},
                                              {}};
  for (auto const& unknowns : choices) {
    auto const part = slant::detail::tail_inverse(f.columns(), unknowns);
    REQUIRE(part->size() == index(unknowns.size()));
    for (index j = 0; j < part->size(); ++j) {
      for (index i = j; i < part->size(); ++i) {
        double const exact = inverse(unknowns[std::size_t(i)], unknowns[std::size_t(j)]);
        CHECK((*part)(i, j) == doctest::Approx(exact).epsilon(1e-13).scale(inverse.norm()));
      }
    }
  }
}

TEST_CASE("rounded to floats, definite matrices that are well-conditioned but for units stay so") {
  // S⁻¹ with ones on the diagonal and c beside it, in the unit scale^i: 1/(1 − c) is its condition.
  auto const verdict = [](double c, double scale) {
    slant::detail::packed_symmetric<double> inverse(6);
    std::vector<double> stiffness;
    for (int j = 0; j < 6; ++j) {
      double const unit = std::pow(scale, j);
      stiffness.push_back(1 / ((1 - c) * unit * unit));  // (S)_ii is less
      for (int i = j; i < 6; ++i) inverse.set(i, j, (i == j ? 1 : c) * unit * std::pow(scale, i));
    }
    return slant::detail::stays_definite<float>(inverse, stiffness);
  };
  for (double const scale : {1.0, 1e-3, 1e3}) {
    CHECK(verdict(0, scale));
    CHECK(verdict(0.9, scale));
    CHECK(verdict(1 - 1e-5, scale));
    CHECK(!verdict(1 - 1e-8, scale));
    CHECK(!verdict(1 - 1e-12, scale));
  }
  CHECK(!verdict(0, 1e6));  // up to 1e60, which floats do not hold
}

}  // namespace tail_test
