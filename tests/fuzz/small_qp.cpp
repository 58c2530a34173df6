// SPDX-License-Identifier: MIT
//
// Any bytes as a quadratic program over half lines, intervals and discs with at most six unknowns:
// what the methods say of it is compared with the data, in long double and without the library.
//
//     A = s D (LᵀL + c I) D    L of small dyadic numbers, D of powers of two: exact, so that A is
//                              semidefinite indeed, and definite if c > 0
#include "bytes.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

namespace {

using vector = Eigen::VectorXd;
using matrix = Eigen::MatrixXd;
using wide = long double;
constexpr int most = 6;
constexpr wide ε = std::numeric_limits<double>::epsilon();
constexpr wide underflow = std::numeric_limits<double>::denorm_min();  // of one operation
using wide_vector = Eigen::Matrix<wide, most, 1>;

struct problem {
  int lines = 0, intervals = 0, discs = 0;
  matrix A;
  vector b, start, lower, low, high, radius;
  bool definite = false;  ///< and no worse conditioned than a few thousand
  double tolerance = 1e-8;

  [[nodiscard]] int size() const { return lines + intervals + 2 * discs; }
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines(lower), slant::intervals(low, high),
                            slant::discs(radius));
  }
};

problem read(fuzz::bytes& in) {
  problem p;
  p.lines = in.below(5);
  p.intervals = in.below(3);
  p.discs = std::min(in.below(3), (most - p.lines - p.intervals) / 2);
  p.intervals = std::min(p.intervals, most - p.lines - 2 * p.discs);
  if (p.size() == 0) p.lines = 1;
  int const n = p.size(), rank = in.below(n + 1);
  matrix L(rank, n);
  for (int i = 0; i < rank; ++i)
    for (int j = 0; j < n; ++j) L(i, j) = in.quarter();
  double const c = in.below(4) == 0 ? 0.0 : (1 + in.below(64)) / 16.0;
  p.A = L.transpose() * L;
  p.A.diagonal().array() += c;
  int const spread = in.below(4) == 0 ? 1 + in.below(20) : 0;
  vector D(n);
  for (double& entry : D) entry = std::ldexp(1.0, spread == 0 ? 0 : in.below(2 * spread) - spread);
  int const unit = in.below(4) == 0 ? in.below(256) - 128 : 0;
  p.A = std::ldexp(1.0, 7 * unit) * (D.asDiagonal() * p.A * D.asDiagonal());
  p.definite = c > 0 && spread == 0;
  auto const fill = [&](vector& x, int size) {
    x.resize(size);
    for (double& entry : x) entry = in.finite();
  };
  fill(p.b, n);
  fill(p.lower, p.lines);
  fill(p.low, p.intervals);
  fill(p.high, p.intervals);
  for (int i = 0; i < p.intervals; ++i)
    if (p.high[i] < p.low[i]) std::swap(p.high[i], p.low[i]);
  fill(p.radius, p.discs);
  p.radius = p.radius.cwiseAbs();
  static constexpr double tolerances[] = {1e-8, 1e-2, 1e-5, 1e-12};
  p.tolerance = tolerances[in.below(4)];
  p.start = vector::Zero(n);
  if (in.below(2) == 1) fill(p.start, n);
  return p;
}

wide_vector projection(problem const& p, wide_vector x) {
  int at = 0;
  for (int i = 0; i < p.lines; ++i, ++at) x[at] = std::max<wide>(x[at], p.lower[i]);
  for (int i = 0; i < p.intervals; ++i, ++at)
    x[at] = std::min<wide>(std::max<wide>(x[at], p.low[i]), p.high[i]);
  for (int i = 0; i < p.discs; ++i, at += 2) {
    wide const length = std::hypot(x[at], x[at + 1]), radius = p.radius[i];
    if (length > radius)
      for (int k = 0; k < 2; ++k) x[at + k] *= radius / length;
  }
  return x;
}

struct looked_at {
  wide residual = 0;  ///< ‖x − P(x − α g)‖ / α with α = 1 / ‖A‖
  wide gradient = 0;  ///< ‖g‖
  wide rounding = 0;  ///< what evaluating both in double may cost
  wide outside = 0;   ///< ‖x − P(x)‖
  wide band = 0;      ///< what rounding x may cost
};

template <class V>
looked_at look(problem const& p, V const& point) {
  int const n = p.size();
  wide_vector x = wide_vector::Zero(), g = x, trial = x;
  wide norm = 0, squares = 0, size = 0, length = 0;
  for (int i = 0; i < n; ++i) {
    x[i] = point[i];
    length = std::hypot(length, x[i]);
  }
  for (int i = 0; i < n; ++i) {
    wide sum = -static_cast<wide>(p.b[i]), row = 0, sizes = std::fabs(p.b[i]);
    for (int j = 0; j < n; ++j) {
      sum += static_cast<wide>(p.A(i, j)) * x[j];
      row += std::fabs(p.A(i, j));
      sizes += std::fabs(static_cast<wide>(p.A(i, j)) * x[j]);
    }
    g[i] = sum;
    norm = std::max(norm, row);
    squares = std::hypot(squares, sum);
    size = std::hypot(size, sizes);
  }
  looked_at found;
  found.gradient = squares;
  found.band = ε * length + n * underflow;
  wide const α = norm > 0 ? 1 / norm : 1;
  found.rounding = ε * (size + length / α) + n * underflow;
  for (int i = 0; i < n; ++i) trial[i] = x[i] - α * g[i];
  trial = projection(p, trial);
  wide_vector const inside = projection(p, x);
  for (int i = 0; i < n; ++i) {
    found.residual = std::hypot(found.residual, (x[i] - trial[i]) / α);
    found.outside = std::hypot(found.outside, x[i] - inside[i]);
  }
  return found;
}

void show(char const* name, vector const& x) {
  std::fprintf(stderr, "%s =", name);
  for (double const entry : x) std::fprintf(stderr, " %.17g", entry);
  std::fprintf(stderr, "\n");
}

void show(problem const& p) {
  for (int i = 0; i < p.size(); ++i) show("row of A", p.A.row(i));
  show("b", p.b);
  show("half lines from", p.lower);
  show("intervals from", p.low);
  show("intervals to", p.high);
  show("radii", p.radius);
  show("start", p.start);
  std::fprintf(stderr, "tolerance = %g\n", p.tolerance);
}

/// Where a verdict contradicts the data; null if it does not. (Later checks, such as a bound of the
/// error, have their place here.)
template <class Report>
char const* contradiction(problem const& p, Report const& r) {
  using slant::status;
  status const said = r.status;
  if (said == status::running || said == status::interrupted) return "a run ends with a verdict";
  if (said != status::breakdown && !r.x().allFinite()) return "only a breakdown gives NaN";
  if (said == status::unbounded && p.definite) return "a definite program is bounded";
  if (said == status::unbounded && p.lines == 0) return "over a bounded set nothing is unbounded";
  if (said != status::converged) return nullptr;
  looked_at const here = look(p, r.x());
  if (!(here.outside <= 64 * here.band)) return "converged: the point is in the set";
  wide const scale = look(p, projection(p, wide_vector::Zero())).gradient;
  if (!(here.residual <= 10 * p.tolerance * scale + 100 * here.rounding)) {
    std::fprintf(stderr, "residual %Lg, scale %Lg, rounding %Lg\n", here.residual, scale,
                 here.rounding);
    return "converged: the reduced gradient is small";
  }
  return nullptr;
}

template <class Report>
void demand_honest(char const* method, problem const& p, Report const& r) {
  char const* const complaint = contradiction(p, r);
  if (complaint == nullptr) return;
  std::fprintf(stderr, "%s: %s\n", method, r.reason.c_str());
  show("x", r.x());
  show(p);
  fuzz::demand(false, complaint);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  fuzz::bytes in(data, size);
  problem const p = read(in);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A);
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  auto const stop = slant::reduced_gradient_below(p.tolerance) || slant::at_most(200);
  try {
    demand_honest("kprgp", p, slant::solve(slant::kprgp{qp}, p.start, stop));
    demand_honest("symmetric_newton", p, slant::solve(slant::symmetric_newton{qp}, p.start, stop));
  } catch (slant::bad_input const& refusal) {  // the gradient at the start overflows
    fuzz::demand_message(refusal.what());
  }
  return 0;
}
