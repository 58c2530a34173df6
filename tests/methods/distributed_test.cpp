// SPDX-License-Identifier: MIT
//
// Two processes take the same steps and reach the solution of one.
#include <slant/slant.hpp>

#include <certificates/made_programs.hpp>
#include <support/testing.hpp>
#include <support/two_processes.hpp>
#include "mixture.hpp"

namespace distributed_test {

using test::shared_matrix;
using test::shared_vector;
using test::two_processes;

/// Runs run(A, b, x0, rank) with the first `split` unknowns on one process, the rest on the other;
/// x of both together, after the steps of a run alone.
template <class Run>
VectorXd together(MatrixXd const& M, VectorXd const& b, Eigen::Index split, Run const& run) {
  two_processes group;
  std::array<VectorXd, 2> parts;
  std::array<slant::index, 2> steps{};
  bool const finished = two_processes::run([&](int rank) {
    auto const first = rank == 0 ? 0 : split, count = rank == 0 ? split : b.size() - split;
    shared_matrix const A{M.middleRows(first, count)};
    shared_vector const part(group, rank, b.segment(first, count));
    auto x0 = part;
    x0.local().setZero();
    auto const r = run(A, part, x0, rank);
    parts[std::size_t(rank)] = r.x().local();
    steps[std::size_t(rank)] = r.converged() ? r.iterations() : -1;
  });
  REQUIRE(finished);
  CHECK(steps[0] == steps[1]);
  CHECK(steps[0] >= 0);
  VectorXd x(b.size());
  x << parts[0], parts[1];
  return x;
}

/// 40 unknowns ≥ 0 in uneven parts: what ends a step or leaves the set in either part counts for
/// both. make(program, seed) is the method; each process brings a seed of its own.
template <class Make>
void check_half_lines(std::initializer_list<Eigen::Index> splits, Make const& make) {
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(3000);
  for (Eigen::Index const split : splits) {
    CAPTURE(split);
    auto const M = test::with_spectrum(test::log_spaced(40, 200), unsigned(split));
    VectorXd const b = test::random_vector(40, 5);
    auto const set = slant::half_lines(40);
    slant::separable_qp const qp{test::spd(M), b, set};
    auto const alone = slant::solve(make(qp, 1U), test::zeros(40), stop);
    REQUIRE(alone.converged());
    auto const x =
        together(M, b, split, [&](auto const& A, auto const& f, auto const& x0, int rank) {
          auto const part = slant::half_lines(A.rows());
          return slant::solve(make(slant::separable_qp{A, f, part}, 1 + unsigned(rank)), x0, stop);
        });
    CHECK((x - alone.x()).norm() <= 1e-8 * alone.x().norm());
  }
}

TEST_CASE("kprgp, with a spectrum of other seeds in each process") {
  check_half_lines({20, 7, 33}, [](auto const& qp, unsigned seed) {
    slant::kprgp_options<double> options;
    options.spectrum.seed = seed;
    return slant::kprgp(qp, options);
  });
}

TEST_CASE("imssn, gimssn") {
  check_half_lines({20, 7},
                   [](auto const& qp, unsigned) { return slant::imssn(qp, {.step_length = 1.9}); });
  check_half_lines(
      {20, 7}, [](auto const& qp, unsigned) { return slant::gimssn(qp, {.step_length = 1.9}); });
}

/// 20 discs in uneven parts, `first` of them on one process, some of them sliding in each.
template <class Make>
void check_discs(Eigen::Index first, double tolerance, double error, Make const& make) {
  CAPTURE(first);
  auto const stop = slant::reduced_gradient_below(tolerance) || slant::at_most(100);
  VectorXd const radii = VectorXd::LinSpaced(20, 0.1, 1.5), b = 3 * test::random_vector(40, 5);
  auto const M = test::with_spectrum(test::log_spaced(40, 200), unsigned(first));
  auto const set = slant::discs(radii);
  slant::separable_qp const qp{test::spd(M), b, set};
  auto const alone = slant::solve(make(qp), test::zeros(40), stop);
  REQUIRE(alone.converged());
  auto const slides = [&](Eigen::Index i) {
    return alone.x().template segment<2>(2 * i).norm() > radii(i) * (1 - 1e-6);
  };
  int sliding[2] = {0, 0};
  for (Eigen::Index i = 0; i < 20; ++i) sliding[i < first ? 0 : 1] += slides(i) ? 1 : 0;
  REQUIRE((sliding[0] > 0 && sliding[1] > 0));
  auto const x =
      together(M, b, 2 * first, [&](auto const& A, auto const& f, auto const& x0, int rank) {
        auto const own =
            slant::discs(VectorXd(rank == 0 ? radii.head(first) : radii.tail(20 - first)));
        auto const r = slant::solve(make(slant::separable_qp{A, f, own}), x0, stop);
        if constexpr (requires { r.state.constraints; }) CHECK(r.state.constraints == 20);
        return r;
      });
  CHECK((x - alone.x()).norm() <= error * alone.x().norm());
}

TEST_CASE("symmetric_newton, interior_point") {
  for (Eigen::Index const first : {10, 3})
    check_discs(first, 1e-11, 1e-9, [](auto const& qp) { return slant::symmetric_newton(qp); });
  // The diagonal is estimated by other signs in each part: steps agree, their digits do not.
  check_discs(13, 1e-9, 1e-7, [](auto const& qp) { return slant::interior_point(qp); });
}

TEST_CASE("semismooth_newton: as many steps as alone") {
  auto const M = test::with_spectrum(test::log_spaced(21, 50));
  VectorXd const b = test::random_vector(21, 5);
  auto const stop = slant::residual_below(1e-11) || slant::at_most(40);
  auto const F = slant::natural_residual(test::spd(M), b, slant::half_lines(21), 1.0);
  auto const alone = slant::solve(slant::semismooth_newton{F}, test::zeros(21), stop);
  REQUIRE(alone.converged());
  auto const x = together(M, b, 8, [&](auto const& A, auto const& f, auto const& x0, int) {
    auto const G = slant::natural_residual(A, f, slant::half_lines(A.rows()), 1.0);
    auto const r = slant::solve(slant::semismooth_newton{G}, x0, stop);
    CHECK(r.iterations() == alone.iterations());
    return r;
  });
  CHECK((x - alone.x()).norm() <= 1e-10 * alone.x().norm());
}

TEST_CASE("energy_certificate: both parts count") {
  auto const M = test::with_spectrum(test::log_spaced(21, 50));
  VectorXd const b = test::random_vector(21, 5), x = b.cwiseMax(0.0);
  slant::separable_qp const qp{test::spd(M), b, slant::half_lines(21)};
  auto const exact = slant::solve(qp, 1e-12);
  two_processes group;
  CHECK(two_processes::run([&](int rank) {
    auto const first = rank * 8, count = rank == 0 ? 8 : 13;
    shared_vector const f(group, rank, b.segment(first, count));
    slant::separable_qp const part{shared_matrix{M.middleRows(first, count)}, f,
                                   slant::half_lines(count)};
    auto const e =
        slant::energy_certificate(part)(shared_vector(group, rank, x.segment(first, count)));
    CHECK(e.size == doctest::Approx(test::energy_norm(M, x)));
    double const error = test::energy_norm(M, x - exact.x());
    CHECK((e.bound >= error / 1.5 && e.bound <= 5 * error));
    auto const both = group.numbers(rank, e.bound);
    CHECK(both[0] == both[1]);
  }));
}

TEST_CASE("conjugate gradients") {
  auto const M = test::with_spectrum(test::log_spaced(30, 100));
  VectorXd const b = test::random_vector(30, 5);
  auto const x = together(M, b, 11, [](auto const& A, auto const& f, auto const& x0, int) {
    return slant::solve(slant::cg{A, f}, x0, slant::residual_below(1e-12) || slant::at_most(100));
  });
  CHECK((M * x - b).norm() <= 1e-11 * b.norm());
}

}  // namespace distributed_test
