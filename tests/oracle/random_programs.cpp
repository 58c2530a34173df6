// SPDX-License-Identifier: MIT
#include <oracle/random_programs.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace oracle {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using extended = long double;
using extended_matrix = Eigen::Matrix<extended, Eigen::Dynamic, Eigen::Dynamic>;
using extended_vector = Eigen::Matrix<extended, Eigen::Dynamic, 1>;

quad magnitude(quad x) {
  return x < 0 ? -x : x;
}

quad root(quad x) {
  if (!(x > 0)) return 0;
  quad y = std::sqrt(static_cast<extended>(x));
  y = (y + x / y) / 2;
  return (y + x / y) / 2;
}

quad length(quad x, quad y) {
  return root(x * x + y * y);
}

/// The projection of one block and its derivative, where it has one.
struct projected_block {
  std::array<quad, 3> at{};
  std::array<std::array<extended, 3>, 3> derivative{};
};

projected_block onto_interval(quad x, double l, double u) {
  projected_block p;
  bool const outside = x < l || x > u || l == u;
  p.at[0] = x < l ? quad(l) : x > u ? quad(u) : x;
  p.derivative[0][0] = outside ? 0 : 1;
  return p;
}

projected_block onto_disc(quad x, quad y, double g) {
  projected_block p;
  quad const size = length(x, y);
  if (g == 0) return p;
  if (!(size > g)) {
    p.at = {x, y, 0};
    p.derivative[0][0] = p.derivative[1][1] = 1;
    return p;
  }
  quad const e[2] = {x / size, y / size};
  p.at = {g * e[0], g * e[1], 0};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j)
      p.derivative[i][j] = static_cast<extended>((quad(i == j ? 1 : 0) - e[i] * e[j]) * g / size);
  }
  return p;
}

projected_block onto_ellipse(quad x, quad y, double a, double b) {
  projected_block p;
  quad const A = quad(a) * a, B = quad(b) * b;
  if (!(x * x / A + y * y / B > 1)) {
    p.at = {x, y, 0};
    p.derivative[0][0] = p.derivative[1][1] = 1;
    return p;
  }
  // The multiplier t is the root of a falling convex function: Newton's steps from below, or
  // halves.
  quad lower = 0, upper = 2 * (a * magnitude(x) + b * magnitude(y));
  quad t = 0;
  for (int k = 0; k < 400; ++k) {
    quad const X = a * x / (A + t), Y = b * y / (B + t);
    quad const value = X * X + Y * Y - 1;
    quad const slope = -2 * (X * X / (A + t) + Y * Y / (B + t));
    (value > 0 ? lower : upper) = t;
    quad next = t - value / slope;
    if (!(next > lower && next < upper))
      next = (lower + upper) / 2;
    else if (k % 2 == 1 && k < 100 && value > quad(1e-3))
      next = (next + upper) / 2;
    if (next == t || magnitude(next - t) <= quad(1e-33) * t) break;
    t = next;
  }
  quad const px = A * x / (A + t), py = B * y / (B + t);
  p.at = {px, py, 0};
  // M⁻¹ − M⁻¹n nᵀM⁻¹/(nᵀM⁻¹n) with M = I + t diag(1/a², 1/b²) and n the normal.
  quad const m[2] = {A / (A + t), B / (B + t)}, n[2] = {px / A, py / B};
  quad const w = n[0] * n[0] * m[0] + n[1] * n[1] * m[1];
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      quad const entry = (i == j ? m[i] : quad(0)) - m[i] * n[i] * m[j] * n[j] / w;
      p.derivative[i][j] = static_cast<extended>(entry);
    }
  }
  return p;
}

projected_block onto_cone(quad n, quad x, quad y, double μ) {
  projected_block p;
  quad const size = length(x, y);
  if (n >= 0 && size <= μ * n) {
    p.at = {n, x, y};
    for (std::size_t i = 0; i < 3; ++i) p.derivative[i][i] = 1;
    return p;
  }
  if (n + μ * size <= 0) return p;
  quad const m = μ, height = (n + m * size) / (1 + m * m);
  quad const e[2] = {x / size, y / size};
  p.at = {height, m * height * e[0], m * height * e[1]};
  quad const w[3] = {1, m * e[0], m * e[1]};
  quad const θ = m * height / size;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      quad entry = w[i] * w[j] / (1 + m * m);
      if (i > 0 && j > 0) entry += θ * (quad(i == j ? 1 : 0) - e[i - 1] * e[j - 1]);
      p.derivative[i][j] = static_cast<extended>(entry);
    }
  }
  return p;
}

/// f(first unknown, size, projection of that block) for each constrained block.
template <class F>
void visit_projections(random_program const& p, quad_vector const& z, F const& f) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (Index i = 0; i < p.lower.size(); ++i, ++at)
    f(at, std::size_t(1), onto_interval(z[at], p.lower(i), infinity));
  for (Index i = 0; i < p.left.size(); ++i, ++at)
    f(at, std::size_t(1), onto_interval(z[at], p.left(i), p.right(i)));
  for (Index i = 0; i < p.radius.size(); ++i, at += 2)
    f(at, std::size_t(2), onto_disc(z[at], z[at + 1], p.radius(i)));
  for (Index i = 0; i < p.first_axis.size(); ++i, at += 2)
    f(at, std::size_t(2), onto_ellipse(z[at], z[at + 1], p.first_axis(i), p.second_axis(i)));
  for (Index i = 0; i < p.mu.size(); ++i, at += 3)
    f(at, std::size_t(3), onto_cone(z[at], z[at + 1], z[at + 2], p.mu(i)));
}

quad_vector project(random_program const& p, quad_vector z) {
  quad_vector y = z;
  visit_projections(p, z, [&](std::size_t at, std::size_t size, projected_block const& block) {
    for (std::size_t i = 0; i < size; ++i) y[at + i] = block.at[i];
  });
  return y;
}

quad_vector gradient(random_program const& p, quad_vector const& x) {
  auto const n = static_cast<std::size_t>(p.size());
  quad_vector r(n);
  for (std::size_t i = 0; i < n; ++i) r[i] = -quad(p.b(Index(i)));
  for (std::size_t j = 0; j < n; ++j) {
    if (x[j] == 0) continue;
    double const* column = p.A.data() + Index(j) * p.size();
    for (std::size_t i = 0; i < n; ++i) r[i] += column[i] * x[j];
  }
  return r;
}

quad size_of(quad_vector const& x) {
  quad largest = 0, sum = 0;
  for (quad e : x) largest = std::max(largest, magnitude(e));
  if (!(largest > 0)) return 0;
  for (quad e : x) sum += (e / largest) * (e / largest);
  return largest * root(sum);
}

quad_vector widened(VectorXd const& x) {
  return {x.data(), x.data() + x.size()};
}

double row_sum_norm(random_program const& p) {
  return p.A.cwiseAbs().rowwise().sum().maxCoeff();
}

/// (x − P(x − α r)) / α.
quad_vector reduced_gradient(random_program const& p, quad_vector const& x, quad α) {
  quad_vector const r = gradient(p, x);
  quad_vector z = x;
  for (std::size_t i = 0; i < x.size(); ++i) z[i] -= α * r[i];
  quad_vector y = project(p, z);
  for (std::size_t i = 0; i < x.size(); ++i) y[i] = y[i] == z[i] ? r[i] : (x[i] - y[i]) / α;
  return y;
}

/// A number drawn the same way by every standard library.
class source {
 public:
  explicit source(std::uint64_t seed) : generator_(seed * 0x9e3779b97f4a7c15U + 77) {}
  double uniform() { return double(generator_() >> 11) * 0x1p-53; }
  double between(double a, double b) { return a + (b - a) * uniform(); }
  int below(int n) { return int(generator_() % std::uint64_t(n)); }
  bool chance(double p) { return uniform() < p; }
  /// 10^e, e between −digits and digits.
  double scale(double digits) { return std::pow(10.0, between(-digits, digits)); }
  double normal() {
    double const size = std::sqrt(-2 * std::log(1 - uniform()));
    return size * std::cos(6.283185307179586 * uniform());
  }

 private:
  std::mt19937_64 generator_;
};

/// Q diag(λ) Qᵀ, Q a product of random reflections, in extended precision.
Eigen::MatrixXd with_spectrum(VectorXd const& λ, source& random) {
  Index const n = λ.size();
  extended_matrix A = λ.cast<extended>().asDiagonal();
  for (Index k = 0; k < n; ++k) {
    extended_vector v(n);
    for (extended& e : v) e = random.normal();
    v /= v.norm();
    A -= 2 * v * (v.transpose() * A);
    A -= 2 * (A * v) * v.transpose();
  }
  return ((A + A.transpose()) / 2).cast<double>();
}

VectorXd spectrum(Index n, double κ, int kernel, source& random) {
  VectorXd λ(n);
  int const kind = random.below(4);
  for (Index i = 0; i < n; ++i) {
    double const t = n > 1 ? double(i) / double(n - 1) : 1;
    if (kind == 0) λ(i) = std::pow(κ, t - 1);                         // evenly
    if (kind == 1) λ(i) = i == 0 ? 1 / κ : random.between(0.1, 1);    // one soft direction
    if (kind == 2) λ(i) = i + 1 == n ? 1 : random.between(1, 9) / κ;  // one stiff direction
    if (kind == 3) λ(i) = 2 * i < n ? 1 / κ : 1;                      // two clusters
  }
  λ(0) = 1 / κ;
  λ(n - 1) = 1;
  if (n == 1) λ(0) = 1;
  for (Index i = 0; i < std::min<Index>(kernel, n - 1); ++i) λ(i) = 0;
  return λ;
}

/// Draws x* and the normal ν block by block.
struct planting {
  source& random;
  program_shape const& shape;
  double strength;  ///< of normals
  quad_vector x{}, ν{};

  double multiplier() {
    if (random.chance(shape.degenerate)) return 0;
    return strength * random.between(0.1, 2);
  }
  void add(quad at, quad normal) {
    x.push_back(at);
    ν.push_back(normal);
  }
  double gap() { return shape.gap > 1 ? random.scale(std::log10(shape.gap)) : 1; }

  void half_line(double& l) {
    l = random.chance(0.5) ? 0 : gap() * random.normal();
    if (random.chance(0.5)) {
      add(l, -multiplier());
    } else {
      add(l + std::abs(random.normal()), 0);
    }
  }
  void interval(double& l, double& u) {
    l = gap() * random.normal();
    u = random.chance(shape.pinned) ? l : l + gap() * random.between(0.1, 3);
    int const where = random.below(3);
    if (l == u) {
      add(l, strength * random.normal());
    } else if (where == 0) {
      add(l, -multiplier());
    } else if (where == 1) {
      add(u, multiplier());
    } else {
      add(l + (quad(u) - l) * random.between(0.1, 0.9), 0);
    }
  }
  void disc(double& g) {
    g = random.chance(shape.pinned) ? 0 : gap() * random.between(0.1, 3);
    double const angle = random.between(0, 6.283185307179586);
    quad const c = std::cos(angle), s = std::sin(angle), norm = length(c, s);
    double const inside = random.chance(0.6) ? 1 : random.between(0, 0.95);
    double const size = inside == 1 ? multiplier() : 0;
    add(g * inside * c / norm, size * c / norm);
    add(g * inside * s / norm, size * s / norm);
  }
  void ellipse(double& a, double& b) {
    a = gap() * random.between(0.1, 3);
    b = a * random.scale(std::log10(std::max(shape.aspect, 1.0)));
    double const angle = random.between(0, 6.283185307179586);
    quad const c = std::cos(angle), s = std::sin(angle), norm = length(c, s);
    double const inside = random.chance(0.6) ? 1 : random.between(0, 0.95);
    quad const size = inside == 1 ? multiplier() : 0;
    quad const normal[2] = {c / norm / a, s / norm / b};
    quad const unit = length(normal[0], normal[1]);
    add(a * inside * c / norm, size * normal[0] / unit);
    add(b * inside * s / norm, size * normal[1] / unit);
  }
  void cone(double& μ) {
    μ = shape.friction > 1 ? random.scale(std::log10(shape.friction)) : 1;
    double const angle = random.between(0, 6.283185307179586);
    quad const c = std::cos(angle), s = std::sin(angle), norm = length(c, s), m = μ;
    quad const e[2] = {c / norm, s / norm};
    int const where = random.below(3);
    quad const size = multiplier(), n = random.between(0.1, 2);
    quad const slant = root(1 + m * m);
    if (where == 0) {  // the apex: any element of the polar cone, on its boundary if degenerate
      quad const t = size * (random.chance(shape.degenerate) ? 1 : random.between(0, 0.9));
      add(0, -size * m / slant);
      add(0, t * e[0] / slant);
      add(0, t * e[1] / slant);
    } else if (where == 1) {  // the mantle
      add(n, -size * m / slant);
      add(m * n * e[0], size * e[0] / slant);
      add(m * n * e[1], size * e[1] / slant);
    } else {
      quad const t = m * n * random.between(0, 0.95);
      add(n, 0);
      add(t * e[0], 0);
      add(t * e[1], 0);
    }
  }
};

VectorXd rounded(quad_vector const& x) {
  VectorXd y(Index(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) y(Index(i)) = static_cast<double>(x[i]);
  return y;
}

/// Derivative of (x − P(x − ρ r))/ρ, in extended precision.
extended_matrix jacobian(random_program const& p, quad_vector const& z, extended_vector const& ρ) {
  extended_matrix J = p.A.cast<extended>();
  visit_projections(p, z, [&](std::size_t at, std::size_t size, projected_block const& block) {
    auto const first = Index(at), k = Index(size);
    extended_matrix G(k, k);
    for (Index i = 0; i < k; ++i)
      for (Index j = 0; j < k; ++j) G(i, j) = block.derivative[std::size_t(i)][std::size_t(j)];
    extended_matrix const rows = G * J.middleRows(first, k);
    J.middleRows(first, k) = rows;
    J.block(first, first, k, k) += (extended_matrix::Identity(k, k) - G) / ρ(first);
  });
  return J;
}

/// One step length for each block.
extended_vector steps(random_program const& p) {
  extended_vector ρ = p.A.diagonal().cast<extended>().cwiseInverse();
  quad_vector const zero(static_cast<std::size_t>(p.size()), quad(0));
  visit_projections(p, zero, [&](std::size_t at, std::size_t size, projected_block const&) {
    auto block = ρ.segment(Index(at), Index(size));
    block.setConstant(extended(block.minCoeff()));
  });
  return ρ;
}

quad_vector natural_residual(random_program const& p, quad_vector const& x,
                             extended_vector const& ρ, quad_vector& z) {
  quad_vector const r = gradient(p, x);
  z = x;
  for (std::size_t i = 0; i < x.size(); ++i) z[i] -= ρ(Index(i)) * r[i];
  quad_vector F = project(p, z);
  for (std::size_t i = 0; i < x.size(); ++i) F[i] = (x[i] - F[i]) / ρ(Index(i));
  return F;
}

/// Newton steps with halvings from x; true if the residual comes down to that of rounding.
bool newton(random_program const& p, extended_vector const& ρ, quad_vector& x) {
  auto const n = static_cast<std::size_t>(p.size());
  quad_vector z;
  quad_vector F = natural_residual(p, x, ρ, z);
  for (int step = 0; step < 60; ++step) {
    quad const size = size_of(F);
    if (size == 0) return true;
    Eigen::PartialPivLU<extended_matrix> const lu(jacobian(p, z, ρ));
    extended_vector right(p.size());
    for (std::size_t i = 0; i < n; ++i) right(Index(i)) = static_cast<extended>(F[i] / size);
    extended_vector const d = lu.solve(right);
    if (!d.allFinite()) return false;
    bool better = false;
    quad_vector trial(n), z_trial;
    for (quad β = 1; β > quad(1e-4); β /= 2) {
      for (std::size_t i = 0; i < n; ++i) trial[i] = x[i] - β * size * d(Index(i));
      quad_vector F_trial = natural_residual(p, trial, ρ, z_trial);
      if (!(size_of(F_trial) < size)) continue;
      x = trial, F = F_trial, z = z_trial;
      better = true;
      break;
    }
    if (!better) break;
  }
  quad const data = size_of(widened(p.b)) + row_sum_norm(p) * size_of(x);
  return size_of(F) <= quad(1e-28) * data;
}

/// Accelerated projected gradients with restarts, in quadruple precision from x.
void gradient_steps(random_program const& p, quad_vector& x, int count) {
  quad const L = row_sum_norm(p);
  quad_vector y = x;
  double t = 1;
  for (int k = 0; k < count; ++k) {
    quad_vector const r = gradient(p, y);
    quad_vector next = y;
    for (std::size_t i = 0; i < x.size(); ++i) next[i] -= r[i] / L;
    next = project(p, next);
    quad wrong = 0;
    for (std::size_t i = 0; i < x.size(); ++i) wrong += (y[i] - next[i]) * (next[i] - x[i]);
    double const t_next = wrong > 0 ? 1 : (1 + std::sqrt(1 + 4 * t * t)) / 2;
    quad const momentum = wrong > 0 ? 0 : (t - 1) / t_next;
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = next[i] + momentum * (next[i] - x[i]);
    t = t_next;
    x = next;
  }
}

}  // namespace

int programs_in(program_suite s) {
  return s == program_suite::nasty ? 1500 : s == program_suite::degenerate ? 800 : 1000;
}

random_program make_program(program_shape const& shape, std::uint64_t seed) {
  source random(seed);
  random_program p;
  p.lower.resize(shape.half_lines);
  p.left.resize(shape.intervals);
  p.right.resize(shape.intervals);
  p.radius.resize(shape.discs);
  p.first_axis.resize(shape.ellipses);
  p.second_axis.resize(shape.ellipses);
  p.mu.resize(shape.cones);
  p.free_unknowns = shape.free_unknowns;
  p.condition = shape.condition;
  planting plant{random, shape, random.scale(1)};
  for (double& e : p.lower) plant.half_line(e);
  for (Index i = 0; i < p.left.size(); ++i) plant.interval(p.left(i), p.right(i));
  for (double& e : p.radius) plant.disc(e);
  for (Index i = 0; i < p.first_axis.size(); ++i) plant.ellipse(p.first_axis(i), p.second_axis(i));
  for (double& e : p.mu) plant.cone(e);
  for (Index i = 0; i < p.free_unknowns; ++i) plant.add(random.normal(), 0);

  auto const n = Index(plant.x.size());
  p.definite = shape.kernel == 0 || n == 1;
  p.A = with_spectrum(spectrum(n, shape.condition, shape.kernel, random), random);
  p.b = VectorXd::Zero(n);
  quad_vector b = gradient(p, plant.x);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += plant.ν[i];
  p.b = rounded(b);
  p.planted = rounded(plant.x);
  return p;
}

random_program make_program(program_suite s, std::uint64_t number) {
  std::uint64_t const seed = 10000 * (1 + std::uint64_t(s)) + number;
  source random(seed + 500000);
  program_shape shape;
  bool const small = s == program_suite::tiny;
  int const parts = small ? 1 + random.below(2) : 2 + random.below(12);
  int* const counts[] = {&shape.half_lines, &shape.intervals, &shape.discs,
                         &shape.ellipses,   &shape.cones,     &shape.free_unknowns};
  for (int i = 0; i < parts; ++i) ++*counts[random.below(6)];
  if (s == program_suite::nasty) {
    shape.condition = std::pow(10.0, random.between(0, 12));
    shape.aspect = 1e8;
    shape.friction = 1e8;
    shape.pinned = 0.3;
    shape.gap = 1e6;
    return make_program(shape, seed);
  }
  if (s == program_suite::degenerate) {
    shape.condition = std::pow(10.0, random.between(0, 4));
    shape.degenerate = 0.5;
    shape.pinned = 0.2;
    shape.aspect = shape.friction = shape.gap = 10;
    if (number % 4 == 3) shape.kernel = 1 + random.below(2);
    return make_program(shape, seed);
  }
  shape.condition = std::pow(10.0, random.between(0, 2));
  shape.aspect = shape.friction = 10;
  random_program p = make_program(shape, seed);
  double const size = random.scale(1);
  for (double& e : p.b) e = size * random.normal();
  p.planted.resize(0);
  return p;
}

random_program in_units(random_program p, int stiffness, int length) {
  auto const scale = [](auto& values, int exponent) {
    for (Index i = 0; i < values.size(); ++i)
      values.data()[i] = std::ldexp(values.data()[i], exponent);
  };
  scale(p.A, stiffness);
  scale(p.b, stiffness + length);
  for (VectorXd* lengths :
       {&p.lower, &p.left, &p.right, &p.radius, &p.first_axis, &p.second_axis, &p.planted})
    scale(*lengths, length);
  return p;
}

double floors_above(random_program const& p, VectorXd const& x, double epsilon) {
  if (!x.allFinite()) return std::numeric_limits<double>::infinity();
  quad_vector const at = widened(x);
  quad const σ = row_sum_norm(p);
  if (!(σ > 0)) return std::numeric_limits<double>::infinity();
  quad const size = size_of(reduced_gradient(p, at, 1 / σ));
  quad const floor = epsilon * (σ * size_of(at) + size_of(widened(p.b)));
  return size == 0 ? 0 : static_cast<double>(size / floor);
}

double relative_residual(random_program const& p, VectorXd const& x) {
  if (!x.allFinite()) return std::numeric_limits<double>::infinity();
  quad const σ = row_sum_norm(p);
  quad_vector const origin = project(p, quad_vector(static_cast<std::size_t>(p.size()), quad(0)));
  quad const first = size_of(reduced_gradient(p, origin, 1 / σ));
  quad const now = size_of(reduced_gradient(p, widened(x), 1 / σ));
  return now == 0 ? 0 : static_cast<double>(now / first);
}

std::optional<quad_vector> exact_solution(random_program const& p) {
  extended_vector const ρ = steps(p);
  if (!ρ.allFinite()) return {};
  auto const n = static_cast<std::size_t>(p.size());
  quad_vector start = p.planted.size() > 0 ? widened(p.planted) : quad_vector(n, quad(0));
  start = project(p, start);
  for (int gradients = 0; gradients <= 4096; gradients = gradients == 0 ? 64 : 4 * gradients) {
    gradient_steps(p, start, gradients);
    quad_vector x = start;
    if (newton(p, ρ, x)) return project(p, x);
  }
  return {};
}

double energy_error(random_program const& p, VectorXd const& x, quad_vector const& exact) {
  random_program homogeneous;
  homogeneous.A = p.A;
  homogeneous.b = VectorXd::Zero(p.size());
  auto const square = [&](quad_vector const& d) {
    quad_vector const Ad = gradient(homogeneous, d);
    quad sum = 0;
    for (std::size_t i = 0; i < d.size(); ++i) sum += d[i] * Ad[i];
    return sum;
  };
  quad_vector d = widened(x);
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= exact[i];
  // d may lie in the null space of a singular A, which is one up to the rounding of A only.
  quad off = square(d);
  for (std::size_t i = 0; i < d.size() && !p.definite; ++i) {
    for (std::size_t j = 0; j < d.size(); ++j)
      off -= quad(0x1p-53) * magnitude(d[i] * quad(p.A(Eigen::Index(i), Eigen::Index(j))) * d[j]);
  }
  quad const whole = root(square(exact)), error = off > 0 ? root(off) : quad(0);
  return static_cast<double>(whole > 0 ? error / whole : error);
}

}  // namespace oracle
