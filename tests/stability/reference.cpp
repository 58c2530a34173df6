// SPDX-License-Identifier: MIT
#include <stability/reference.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace stability {

namespace {

/// The constraints in quadruple precision, of x or of scaled unknowns.
struct bounds {
  quad_vector lower{}, low{}, high{}, radius{};
  std::vector<bool> has_lower{}, has_radius{};

  explicit bounds(program const& p) {
    for (double l : p.lower) {
      has_lower.push_back(std::isfinite(l));
      lower.push_back(has_lower.back() ? static_cast<quad>(l) : quad(0));
    }
    for (double l : p.low) low.push_back(static_cast<quad>(l));
    for (double h : p.high) high.push_back(static_cast<quad>(h));
    for (double r : p.radius) {
      has_radius.push_back(std::isfinite(r));
      radius.push_back(has_radius.back() ? static_cast<quad>(r) : quad(0));
    }
  }
  [[nodiscard]] std::size_t first_interval() const { return lower.size(); }
  [[nodiscard]] std::size_t first_disc() const { return lower.size() + low.size(); }
};

/// min ½ yᵀA y − bᵀy in scaled unknowns.
struct scaled_program {
  quad_matrix A;
  quad_vector b;
  bounds set;

  [[nodiscard]] quad_vector gradient(quad_vector const& x) const {
    quad_vector g = A.times(x);
    for (std::size_t i = 0; i < g.size(); ++i) g[i] -= b[i];
    return g;
  }
};

/// One constraint h(x) ≥ 0 of the interior-point method: sign (x_at − value), or (r² − ‖x‖²)/2 of a
/// disc.
struct inequality {
  std::size_t at;
  bool disc;
  quad value;
  int sign;
  quad slack = 0, multiplier = 0, slack_step = 0, multiplier_step = 0;

  [[nodiscard]] quad evaluate(quad_vector const& x) const {
    if (!disc) return sign > 0 ? x[at] - value : value - x[at];
    return (value * value - x[at] * x[at] - x[at + 1] * x[at + 1]) / 2;
  }
};

/// A point between the bounds, all constraints that have an interior, and which unknowns have none.
struct interior {
  quad_vector x{};
  std::vector<inequality> list{};
  std::vector<bool> fixed{};

  explicit interior(scaled_program const& p) : x(p.b.size(), quad(0)), fixed(p.b.size(), false) {
    auto const& s = p.set;
    for (std::size_t i = 0; i < s.lower.size(); ++i) {
      if (!s.has_lower[i]) continue;
      x[i] = s.lower[i] + 1;
      list.push_back({i, false, s.lower[i], 1});
    }
    for (std::size_t i = 0; i < s.low.size(); ++i) {
      std::size_t const at = s.first_interval() + i;
      x[at] = (s.low[i] + s.high[i]) / 2;
      fixed[at] = !(s.low[i] < x[at] && x[at] < s.high[i]);
      if (fixed[at]) continue;
      list.push_back({at, false, s.low[i], 1});
      list.push_back({at, false, s.high[i], -1});
    }
    for (std::size_t i = 0; i < s.radius.size(); ++i) {
      if (!s.has_radius[i]) continue;
      std::size_t const at = s.first_disc() + 2 * i;
      fixed[at] = fixed[at + 1] = !(s.radius[i] > 0);
      if (!fixed[at]) list.push_back({at, true, s.radius[i], 0});
    }
    for (auto& c : list) {
      c.slack = c.evaluate(x);
      c.multiplier = 1 / c.slack;
    }
  }
};

/// ∇ of the Lagrangian; 0 at fixed unknowns.
quad_vector stationarity(scaled_program const& p, interior const& in, quad_vector const& x,
                         std::vector<quad> const& multipliers) {
  quad_vector r = p.gradient(x);
  for (std::size_t k = 0; k < in.list.size(); ++k) {
    auto const& c = in.list[k];
    if (c.disc) {
      r[c.at] += multipliers[k] * x[c.at];
      r[c.at + 1] += multipliers[k] * x[c.at + 1];
    } else {
      r[c.at] -= c.sign > 0 ? multipliers[k] : -multipliers[k];
    }
  }
  for (std::size_t i = 0; i < r.size(); ++i)
    if (in.fixed[i]) r[i] = 0;
  return r;
}

/// ‖stationarity‖² + ‖h z − μ‖².
quad merit(scaled_program const& p, interior const& in, quad_vector const& x,
           std::vector<quad> const& z, quad μ) {
  quad_vector const r = stationarity(p, in, x, z);
  quad sum = dot(r, r);
  for (std::size_t k = 0; k < in.list.size(); ++k) {
    quad const t = in.list[k].evaluate(x) * z[k] - μ;
    sum += t * t;
  }
  return sum;
}

/// The central path until the gap is `accuracy` of where it began, or no step helps any more.
quad_vector follow_path(scaled_program const& p, quad accuracy) {
  interior in(p);
  if (in.list.empty()) {
    quad_matrix A = p.A;
    return quad_cholesky(A).solve(p.b);
  }
  std::size_t const n = p.b.size(), m = in.list.size();
  std::vector<quad> z(m);
  for (std::size_t k = 0; k < m; ++k) z[k] = in.list[k].multiplier;
  quad first_gap = 0;
  for (int iteration = 0; iteration < 250; ++iteration) {
    quad gap = 0;
    for (std::size_t k = 0; k < m; ++k) gap += in.list[k].evaluate(in.x) * z[k];
    if (iteration == 0) first_gap = gap;
    quad_vector const r = stationarity(p, in, in.x, z);
    if (gap <= accuracy * first_gap && dot(r, r) <= accuracy * accuracy * dot(p.b, p.b)) break;
    quad const μ = gap / static_cast<quad>(m) / 10;
    quad_matrix H = p.A;
    quad_vector rhs(n);
    for (std::size_t i = 0; i < n; ++i) rhs[i] = -r[i];
    for (std::size_t k = 0; k < m; ++k) {
      auto const& c = in.list[k];
      quad const h = c.evaluate(in.x), w = z[k] / h, t = (μ - h * z[k]) / h;
      if (c.disc) {
        quad const a = in.x[c.at], e = in.x[c.at + 1];
        H(c.at, c.at) += z[k] + w * a * a;
        H(c.at + 1, c.at + 1) += z[k] + w * e * e;
        H(c.at, c.at + 1) += w * a * e;
        H(c.at + 1, c.at) += w * a * e;
        rhs[c.at] -= t * a;
        rhs[c.at + 1] -= t * e;
      } else {
        H(c.at, c.at) += w;
        rhs[c.at] += c.sign > 0 ? t : -t;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!in.fixed[i]) continue;
      for (std::size_t j = 0; j < n; ++j) H(i, j) = H(j, i) = 0;
      H(i, i) = 1;
      rhs[i] = 0;
    }
    quad_cholesky const factor(std::move(H));
    if (!factor.ok()) break;
    quad_vector const dx = factor.solve(std::move(rhs));
    std::vector<quad> dz(m);
    quad step = 1;
    for (std::size_t k = 0; k < m; ++k) {
      auto const& c = in.list[k];
      quad const h = c.evaluate(in.x);
      quad const dh = c.disc ? -(in.x[c.at] * dx[c.at] + in.x[c.at + 1] * dx[c.at + 1])
                             : (c.sign > 0 ? dx[c.at] : -dx[c.at]);
      dz[k] = (μ - h * z[k] - z[k] * dh) / h;
      if (dz[k] < 0) step = std::min<quad>(step, -z[k] / dz[k] * 99 / 100);
    }
    quad const before = merit(p, in, in.x, z, μ);
    quad_vector trial(n);
    std::vector<quad> z_trial(m);
    bool accepted = false;
    for (int halving = 0; halving < 60 && !accepted; ++halving, step /= 2) {
      for (std::size_t i = 0; i < n; ++i) trial[i] = in.x[i] + step * dx[i];
      bool inside = true;
      for (std::size_t k = 0; k < m && inside; ++k) inside = in.list[k].evaluate(trial) > 0;
      if (!inside) continue;
      for (std::size_t k = 0; k < m; ++k) z_trial[k] = z[k] + step * dz[k];
      quad const shrink = 1 - step / 100;
      accepted = merit(p, in, trial, z_trial, μ) <= shrink * shrink * before;
    }
    if (!accepted) break;
    in.x = trial;
    z = z_trial;
  }
  return in.x;
}

/// P(z), and where on the boundary.
struct projected {
  quad_vector x;
  std::vector<int> state;  ///< 0: inside; 1: at a bound; 2: on a circle; of each unknown
};

projected project(bounds const& s, quad_vector z) {
  projected p{std::move(z), {}};
  p.state.assign(p.x.size(), 0);
  for (std::size_t i = 0; i < s.lower.size(); ++i) {
    if (!s.has_lower[i] || p.x[i] > s.lower[i]) continue;
    p.x[i] = s.lower[i];
    p.state[i] = 1;
  }
  for (std::size_t i = 0; i < s.low.size(); ++i) {
    std::size_t const at = s.first_interval() + i;
    if (p.x[at] > s.low[i] && p.x[at] < s.high[i]) continue;
    p.x[at] = p.x[at] <= s.low[i] ? s.low[i] : s.high[i];
    p.state[at] = 1;
  }
  for (std::size_t i = 0; i < s.radius.size(); ++i) {
    std::size_t const at = s.first_disc() + 2 * i;
    if (!s.has_radius[i]) continue;
    quad const size = root(p.x[at] * p.x[at] + p.x[at + 1] * p.x[at + 1]);
    if (size < s.radius[i]) continue;
    bool const point = !(s.radius[i] > 0) || !(size > 0);
    quad const factor = point ? quad(0) : s.radius[i] / size;
    p.x[at] *= factor;
    p.x[at + 1] *= factor;
    p.state[at] = p.state[at + 1] = point ? 1 : 2;
  }
  return p;
}

/// ‖g − s‖_{A⁻¹} at x on its face: the bound of the header.
quad error_bound(scaled_program const& p, quad_cholesky const& factor, projected const& at) {
  quad_vector r = p.gradient(at.x);
  auto const& s = p.set;
  for (std::size_t i = 0; i < s.first_disc(); ++i) {
    if (at.state[i] != 1) continue;
    bool const upper = i >= s.first_interval() && at.x[i] == s.high[i - s.first_interval()];
    bool const both = i >= s.first_interval() && s.low[i - s.first_interval()] == at.x[i] && upper;
    if (both || (upper ? r[i] < 0 : r[i] > 0)) r[i] = 0;
  }
  for (std::size_t i = 0; i < s.radius.size(); ++i) {
    std::size_t const k = s.first_disc() + 2 * i;
    if (at.state[k] == 1) r[k] = r[k + 1] = 0;
    if (at.state[k] != 2) continue;
    quad const a = at.x[k], e = at.x[k + 1];
    quad const along = (r[k] * a + r[k + 1] * e) / (a * a + e * e);
    if (along > 0) continue;
    r[k] -= along * a;
    r[k + 1] -= along * e;
  }
  return root(dot(r, factor.solve(r)));
}

/// Newton's method for x − P(x − g(x)), with δ ‖x − centre‖²/2 added to the energy.
projected newton(scaled_program const& p, quad_vector x, quad_vector const& centre, quad δ,
                 int steps) {
  std::size_t const n = x.size();
  auto const trial = [&](quad_vector const& y) {
    quad_vector z = p.gradient(y);
    for (std::size_t i = 0; i < n; ++i) z[i] = y[i] - z[i] - δ * (y[i] - centre[i]);
    return z;
  };
  projected best{x, {}};
  quad smallest = -1;
  for (int k = 0; k < steps; ++k) {
    quad_vector const z = trial(x);
    projected const at = project(p.set, z);
    quad_vector F(n);
    for (std::size_t i = 0; i < n; ++i) F[i] = at.x[i] - x[i];  // −(x − P(z))
    quad const size = dot(F, F);
    if (smallest < 0 || size < smallest) {
      smallest = size;
      best = at;
    }
    if (size == 0) break;
    quad_matrix J(n, n);
    for (std::size_t i = 0; i < n; ++i) {
      if (at.state[i] == 1) {
        J(i, i) = 1;
      } else if (at.state[i] == 0) {
        for (std::size_t j = 0; j < n; ++j) J(i, j) = p.A(i, j);
        J(i, i) += δ;
      } else {  // the first of a pair: rows I − G (I − A), G = τ (I − e eᵀ)
        quad const whole = root(z[i] * z[i] + z[i + 1] * z[i + 1]);
        quad const c = z[i] / whole, s = z[i + 1] / whole;
        quad const τ = root(at.x[i] * at.x[i] + at.x[i + 1] * at.x[i + 1]) / whole;
        quad const g00 = τ * s * s, g01 = -τ * s * c, g11 = τ * c * c;
        for (std::size_t j = 0; j < n; ++j) {
          quad const first = p.A(i, j) + (j == i ? δ : quad(0));
          quad const second = p.A(i + 1, j) + (j == i + 1 ? δ : quad(0));
          J(i, j) = g00 * first + g01 * second;
          J(i + 1, j) = g01 * first + g11 * second;
        }
        J(i, i) += 1 - g00;
        J(i, i + 1) -= g01;
        J(i + 1, i) -= g01;
        J(i + 1, i + 1) += 1 - g11;
        ++i;
      }
    }
    quad_vector const dx = eliminate(std::move(J), std::move(F));
    if (dx.empty()) break;
    for (std::size_t i = 0; i < n; ++i) x[i] += dx[i];
  }
  return best;
}

/// The solution and the bound of its error, ‖·‖_A.
std::pair<quad_vector, quad> minimise(scaled_program const& p) {
  std::size_t const n = p.b.size();
  // What is added to a semidefinite A for the bound alone: 1e-30 of its diagonal.
  quad_matrix shifted = p.A;
  for (std::size_t i = 0; i < n; ++i) shifted(i, i) += static_cast<quad>(1e-30);
  quad_cholesky const factor(shifted);
  bool const definite = quad_cholesky(p.A).ok();
  quad_vector best;
  quad bound = -1;
  for (double accuracy : {1e-16, 1e-24, 1e-10}) {
    quad_vector const start = follow_path(p, static_cast<quad>(accuracy));
    quad_vector x = start;
    for (int turn = 0; turn < (definite ? 2 : 6); ++turn) {
      // The first turn of a definite A needs no help; a semidefinite one gets proximal points.
      quad const δ = definite ? quad(0) : static_cast<quad>(1e-16);
      projected const at = newton(p, x, x, δ, 30);
      quad const now = error_bound(p, factor, at);
      if (bound < 0 || now < bound) {
        bound = now;
        best = at.x;
      }
      x = at.x;
    }
    quad const norm = root(dot(best, p.A.times(best)));
    if (bound <= static_cast<quad>(1e-24) * norm) break;
  }
  return {best, bound};
}

/// Largest and smallest eigenvalue of a definite matrix, to a digit or two.
std::pair<quad, quad> extreme_eigenvalues(quad_matrix const& A, quad_cholesky const& factor) {
  auto const iterate = [&](auto const& apply) {
    dice random(7);
    quad_vector v(A.rows);
    for (auto& vi : v) vi = static_cast<quad>(random.uniform(-1, 1));
    quad value = 0;
    for (int k = 0; k < 25; ++k) {
      quad const size = length(v);
      for (auto& vi : v) vi /= size;
      v = apply(v);
      value = length(v);
    }
    return value;
  };
  quad const largest = iterate([&](quad_vector const& v) { return A.times(v); });
  quad const inverse = iterate([&](quad_vector const& v) { return factor.solve(v); });
  return {largest, inverse > 0 ? 1 / inverse : quad(0)};
}

quad_matrix dense(Eigen::SparseMatrix<double> const& M) {
  quad_matrix d(static_cast<std::size_t>(M.rows()), static_cast<std::size_t>(M.cols()));
  for (int j = 0; j < M.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(M, j); it; ++it)
      d(static_cast<std::size_t>(it.row()), static_cast<std::size_t>(it.col())) =
          static_cast<quad>(it.value());
  return d;
}

template <class V>
quad_vector widened(V const& x) {
  quad_vector w;
  for (auto const xi : x) w.push_back(static_cast<quad>(xi));
  return w;
}

/// M x for a sparse M.
quad_vector times(Eigen::SparseMatrix<double> const& M, quad_vector const& x) {
  quad_vector y(static_cast<std::size_t>(M.rows()), quad(0));
  for (int j = 0; j < M.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(M, j); it; ++it)
      y[static_cast<std::size_t>(it.row())] +=
          static_cast<quad>(it.value()) * x[static_cast<std::size_t>(j)];
  return y;
}

/// D = diag(A)^(−1/2), 1 where the diagonal is 0.
quad_vector jacobi(quad_matrix const& A) {
  quad_vector d(A.rows);
  for (std::size_t i = 0; i < A.rows; ++i) d[i] = A(i, i) > 0 ? 1 / root(A(i, i)) : quad(1);
  return d;
}

quad_matrix scaled(quad_matrix A, quad_vector const& d) {
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t j = 0; j < A.cols; ++j) A(i, j) *= d[i] * d[j];
  return A;
}

/// κ, κ of D A D and the smallest eigenvalue of that.
quad judge_condition(quad_matrix const& A, quad_vector const& d, reference& r) {
  quad_matrix const equilibrated = scaled(A, d);
  quad_cholesky const factor(equilibrated);
  if (!factor.ok()) {
    r.condition = r.plain_condition = std::numeric_limits<double>::infinity();
    return 0;
  }
  auto const [largest, smallest] = extreme_eigenvalues(equilibrated, factor);
  if (!(smallest > largest * static_cast<quad>(1e-28))) {  // semidefinite but for rounding
    r.condition = r.plain_condition = std::numeric_limits<double>::infinity();
    return 0;
  }
  r.condition = static_cast<double>(largest / smallest);
  quad_cholesky const plain(A);
  auto const [most, least] = extreme_eigenvalues(A, plain);
  r.plain_condition = static_cast<double>(most / least);
  return smallest;
}

/// One factor for each block, one unit of length for all: A gets a diagonal of about 1, b a size of
/// about 1.
struct scaling {
  quad_vector d;
  quad unit;
};

scaling scale_blocks(quad_matrix const& A, quad_vector const& b, std::size_t first_disc) {
  scaling s{jacobi(A), 0};
  for (std::size_t i = first_disc; i + 1 < A.rows; i += 2) {
    quad const mean = (A(i, i) + A(i + 1, i + 1)) / 2;
    s.d[i] = s.d[i + 1] = mean > 0 ? 1 / root(mean) : quad(1);
  }
  for (std::size_t i = 0; i < b.size(); ++i)
    s.unit = std::max<quad>(s.unit, magnitude(s.d[i] * b[i]));
  if (!(s.unit > 0)) s.unit = 1;
  return s;
}

scaled_program make_scaled(program const& p, quad_matrix const& A, quad_vector const& b,
                           scaling const& s) {
  scaled_program q{scaled(A, s.d), b, bounds(p)};
  for (std::size_t i = 0; i < b.size(); ++i) q.b[i] = b[i] * s.d[i] / s.unit;
  auto const shrink = [&](quad& value, std::size_t at) { value /= s.d[at] * s.unit; };
  for (std::size_t i = 0; i < q.set.lower.size(); ++i) shrink(q.set.lower[i], i);
  for (std::size_t i = 0; i < q.set.low.size(); ++i) {
    shrink(q.set.low[i], q.set.first_interval() + i);
    shrink(q.set.high[i], q.set.first_interval() + i);
  }
  for (std::size_t i = 0; i < q.set.radius.size(); ++i)
    shrink(q.set.radius[i], q.set.first_disc() + 2 * i);
  return q;
}

double const ε = std::numeric_limits<double>::epsilon();

}  // namespace

reference solve_in_quad(program const& p) {
  reference r;
  quad_matrix A;
  quad_vector b;
  quad_matrix stiffness;
  Eigen::SparseMatrix<double> B, Bt;  // [N; T] and its transpose
  if (p.contact()) {
    stiffness = dense(p.K);
    quad_cholesky const K(stiffness);
    if (!K.ok()) return r;
    Eigen::MatrixXd rows(p.N.rows() + p.T.rows(), p.K.cols());
    rows << Eigen::MatrixXd(p.N), Eigen::MatrixXd(p.T);
    B = rows.sparseView();
    Bt = B.transpose();
    auto const n = static_cast<std::size_t>(rows.rows());
    A = quad_matrix(n, n);
    for (std::size_t j = 0; j < n; ++j) {
      quad_vector e(n, quad(0));
      e[j] = 1;
      quad_vector const column = times(B, K.solve(times(Bt, e)));
      for (std::size_t i = 0; i < n; ++i) A(i, j) = column[i];
    }
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < j; ++i) A(i, j) = A(j, i) = (A(i, j) + A(j, i)) / 2;
    b = times(B, K.solve(widened(p.f)));
    for (int i = 0; i < p.d.size(); ++i)
      b[static_cast<std::size_t>(i)] -= static_cast<quad>(p.d[i]);
  } else {
    A = quad_matrix(static_cast<std::size_t>(p.A.rows()), static_cast<std::size_t>(p.A.cols()));
    for (std::size_t i = 0; i < A.rows; ++i)
      for (std::size_t j = 0; j < A.cols; ++j)
        A(i, j) = static_cast<quad>(p.A(static_cast<int>(i), static_cast<int>(j)));
    b = widened(p.b);
  }
  auto const first_disc = static_cast<std::size_t>(p.lower.size() + p.low.size());
  scaling const s = scale_blocks(A, b, first_disc);
  auto [y, bound] = minimise(make_scaled(p, A, b, s));
  r.x = y;
  for (std::size_t i = 0; i < y.size(); ++i) r.x[i] *= s.d[i] * s.unit;
  if (p.contact()) {
    quad_vector load = widened(p.f);
    quad_vector const forces = times(Bt, r.x);
    for (std::size_t i = 0; i < load.size(); ++i) load[i] -= forces[i];
    r.u = quad_cholesky(stiffness).solve(load);
    r.norm = root(dot(r.u, load));
    quad_vector const d = jacobi(stiffness);
    quad const smallest = judge_condition(stiffness, d, r);
    quad sum = 0;
    for (std::size_t i = 0; i < d.size(); ++i) sum += r.u[i] / d[i] * (r.u[i] / d[i]);
    r.floor = ε * static_cast<double>(root(sum / smallest) / r.norm);
  } else {
    r.norm = root(dot(r.x, A.times(r.x)));
    quad_vector const d = jacobi(A);
    quad const smallest = judge_condition(A, d, r);
    quad sum = 0, loads = 0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      sum += r.x[i] / d[i] * (r.x[i] / d[i]);
      loads += d[i] * b[i] * (d[i] * b[i]);
    }
    // Of a semidefinite A only the part that the energy sees can be judged: errors of the gradient
    // in its null space cost nothing, those beside it as in a well-conditioned one.
    quad const least = smallest > 0 ? smallest : quad(1);
    r.floor = ε * static_cast<double>((root(sum) + root(loads)) / root(least) / r.norm);
  }
  r.bound = static_cast<double>(bound * s.unit / r.norm);
  return r;
}

namespace {

template <class V>
double error_of(program const& p, reference const& r, V const& x) {
  if (!x.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  quad_vector e = widened(x);
  quad_vector const& exact = p.contact() ? r.u : r.x;
  for (std::size_t i = 0; i < e.size(); ++i) e[i] -= exact[i];
  if (p.contact()) return static_cast<double>(root(dot(e, times(p.K, e))) / r.norm);
  quad sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i)
    for (std::size_t j = 0; j < e.size(); ++j)
      sum += e[i] * static_cast<quad>(p.A(static_cast<int>(i), static_cast<int>(j))) * e[j];
  return static_cast<double>(root(sum) / r.norm);
}

}  // namespace

double relative_error(program const& p, reference const& r, Eigen::VectorXd const& x) {
  return error_of(p, r, x);
}
double relative_error(program const& p, reference const& r,
                      Eigen::Matrix<long double, Eigen::Dynamic, 1> const& x) {
  return error_of(p, r, x);
}

double natural_residual(program const& p, Eigen::VectorXd const& x) {
  Eigen::VectorXd const diagonal = p.A.diagonal();
  Eigen::VectorXd const g = p.A * x - p.b;
  double sum = 0, size = 0;
  auto const step = [&](Eigen::Index i) { return diagonal[i] > 0 ? 1 / diagonal[i] : 1; };
  auto const add = [&](Eigen::Index i, double projection, double ρ) {
    sum += (x[i] - projection) * (x[i] - projection) / ρ;
    size += std::max(x[i] * x[i], ρ * p.b[i] * ρ * p.b[i]) / ρ;
  };
  Eigen::Index const first = p.lower.size(), second = first + p.low.size();
  for (Eigen::Index i = 0; i < first; ++i)
    add(i, std::max(p.lower[i], x[i] - step(i) * g[i]), step(i));
  for (Eigen::Index i = first; i < second; ++i)
    add(i, std::clamp(x[i] - step(i) * g[i], p.low[i - first], p.high[i - first]), step(i));
  for (Eigen::Index i = second, k = 0; k < p.radius.size(); i += 2, ++k) {
    double const ρ = 2 / (1 / step(i) + 1 / step(i + 1));
    double const a = x[i] - ρ * g[i], e = x[i + 1] - ρ * g[i + 1], length = std::hypot(a, e);
    double const factor = length > p.radius[k] ? p.radius[k] / length : 1;
    add(i, factor * a, ρ);
    add(i + 1, factor * e, ρ);
  }
  return std::sqrt(sum / size);
}

}  // namespace stability
