// SPDX-License-Identifier: MIT
#include <stability/scenes.hpp>

#include <Eigen/SparseCore>
#include <cmath>
#include <fem/steel_brick.hpp>
#include <stdexcept>

namespace stability {

namespace {

// --- contact ------------------------------------------------------------------------------------

/// What is done to the brick of 6 × 2 × 2 cells.
struct brick_changes {
  Eigen::Vector3d size{3, 1, 1};
  double nu = 0.277;
  double grading = 1;   ///< last cell over the first one, along each axis
  double contrast = 0;  ///< decades of E to either side
  double spring = -1;   ///< ≥ 0: held by springs on the left side alone, relative to max K_ii
};

program make_brick(std::string const& load, brick_changes const& c) {
  auto mesh = fem::make_brick_mesh(2, c.size);
  if (c.grading != 1) {
    for (Eigen::Index node = 0; node < mesh.node_count(); ++node) {
      auto const at = mesh.lattice(node);
      for (int axis = 0; axis < 3; ++axis) {
        auto const i = static_cast<std::size_t>(axis);
        double const cells = mesh.cells_along[i];
        double const q = std::pow(c.grading, 1 / (cells - 1));
        mesh.nodes(axis, node) = c.size[axis] * (std::pow(q, at[i]) - 1) / (std::pow(q, cells) - 1);
      }
    }
  }
  auto const name = fem::brick_load_named(load);
  if (!name) throw std::invalid_argument("no load " + load);
  auto const loading = fem::loading_of(*name);
  fem::box_on_foundation<3> const box{.mesh = mesh,
                                      .material = fem::lame(2.119e5, c.nu),
                                      .fixed = fem::brick_side::left,
                                      .contact = fem::brick_side::bottom,
                                      .loads = loading.tractions,
                                      .slip_bound = loading.slip_bound};
  auto scene = fem::make_contact_scene<3>(box);
  if (c.contrast > 0 || c.spring >= 0) {
    // The same sum over cells as fem::stiffness, each with its E; all nodes free if there is a
    // spring.
    if (c.spring >= 0) {
      auto const all = fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
      scene.f = Eigen::VectorXd::Zero(all.count);
      fem::add_tractions(mesh, all, loading.tractions, scene.f);
      Eigen::Index const m = scene.contact_count();
      scene.N.resize(m, all.count);
      scene.T.resize(2 * m, all.count);
      for (Eigen::Index i = 0; i < m; ++i) {
        int const first = all.first[scene.contact_nodes[static_cast<std::size_t>(i)]];
        scene.N.insert(i, first + 2) = -1;
        scene.T.insert(2 * i, first) = 1;
        scene.T.insert(2 * i + 1, first + 1) = 1;
      }
      scene.N.makeCompressed();
      scene.T.makeCompressed();
      scene.unknowns = all;
    }
    dice random(41);
    Eigen::SparseMatrix<double> K(scene.unknowns.count, scene.unknowns.count);
    K.reserve(Eigen::VectorXi::Constant(scene.unknowns.count, 60));
    for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
      double const E = 2.119e5 * std::pow(10.0, random.uniform(-c.contrast, c.contrast));
      auto const Ke = fem::element_stiffness<3>(fem::element_of<3>(mesh, cell), fem::lame(E, c.nu));
      for (int b = 0; b < 4; ++b)
        for (int a = 0; a < 4; ++a) {
          int const row = scene.unknowns.first[mesh.cells(a, cell)];
          int const column = scene.unknowns.first[mesh.cells(b, cell)];
          if (row < 0 || column < 0) continue;
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) K.coeffRef(row + i, column + j) += Ke(3 * a + i, 3 * b + j);
        }
    }
    if (c.spring >= 0) {
      Eigen::VectorXd const diagonal = K.diagonal();
      double const stiffness = c.spring * diagonal.maxCoeff();
      for (int node : mesh.nodes_on(fem::brick_side::left))
        for (int i = 0; i < 3; ++i)
          K.coeffRef(scene.unknowns.first[node] + i, scene.unknowns.first[node] + i) += stiffness;
    }
    K.makeCompressed();
    scene.K = K;
  }
  program p;
  p.K = scene.K;
  p.N = scene.N;
  p.T = scene.T;
  p.f = scene.f;
  p.d = scene.d;
  p.nodes = scene.mesh.nodes;
  p.first = scene.unknowns.first;
  p.radius = scene.g;
  p.lower = Eigen::VectorXd::Zero(scene.d.size());
  return p;
}

program slender(double length, std::string const& load) {
  return make_brick(load, {.size = {length, 1, 1}});
}
program thin(double thickness, std::string const& load) {
  return make_brick(load, {.size = {3, 1, thickness}});
}
program incompressible(double distance, std::string const& load) {
  return make_brick(load, {.nu = 0.5 - distance});
}
program graded(double ratio, std::string const& load) {
  return make_brick(load, {.grading = ratio});
}
program contrasted(double decades, std::string const& load) {
  return make_brick(load, {.contrast = decades});
}
program sprung(double spring, std::string const& load) {
  return make_brick(load, {.spring = spring});
}

/// N u ≤ d row by row in other units, T u node by node: λ changes, u does not.
program rescaled_rows(double decades, std::string const& load) {
  program p = make_brick(load, {});
  dice random(17);
  auto const m = p.N.rows();
  Eigen::VectorXd n(m), t(2 * m);
  for (Eigen::Index i = 0; i < m; ++i) {
    n[i] = std::pow(10.0, random.uniform(-decades, decades));
    t[2 * i] = t[2 * i + 1] = std::pow(10.0, random.uniform(-decades, decades));
    p.radius[i] /= t[2 * i];
  }
  p.N = Eigen::SparseMatrix<double>(n.asDiagonal() * p.N);
  p.T = Eigen::SparseMatrix<double>(t.asDiagonal() * p.T);
  p.d = p.d.cwiseProduct(n);
  return p;
}

/// Forces in units of 10^exponent, lengths as they were.
program units_of_force(double exponent, std::string const& load) {
  program p = make_brick(load, {});
  double const s = std::pow(10.0, exponent);
  p.K *= s;
  p.f *= s;
  p.radius *= s;
  return p;
}
/// Lengths in units of 10^exponent, forces as they were.
program units_of_length(double exponent, std::string const& load) {
  program p = make_brick(load, {});
  double const s = std::pow(10.0, exponent);
  p.K /= s;
  p.d *= s;
  return p;
}

/// A gap that the body just closes at some nodes, slip bounds 0 at some.
program weak_contact(double gap, std::string const& load) {
  program p = make_brick(load, {});
  p.d.setConstant(gap);
  for (Eigen::Index i = 0; i < p.radius.size(); i += 3) p.radius[i] = 0;
  return p;
}

// --- dense --------------------------------------------------------------------------------------

Eigen::VectorXd random_vector(dice& random, Eigen::Index n, double from, double to) {
  Eigen::VectorXd x(n);
  for (double& xi : x) xi = random.uniform(from, to);
  return x;
}

/// Spectrum 1 … 1/κ, log-spaced, in a basis of three reflections; symmetric to the last bit.
Eigen::MatrixXd with_condition(dice& random, Eigen::Index n, double κ) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    A(i, i) = std::pow(
        κ, -static_cast<double>(i) / static_cast<double>(std::max<Eigen::Index>(n - 1, 1)));
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd const v = random_vector(random, n, -1, 1).normalized();
    Eigen::VectorXd const w = A * v;
    A -= 2 * v * w.transpose() + 2 * w * v.transpose() - 4 * v.dot(w) * v * v.transpose();
  }
  return ((A + A.transpose()) / 2).eval();
}

/// Half lines, intervals, discs, blocks of each, about half of them active at the solution.
program random_program(std::uint64_t seed, Eigen::Index blocks, double κ) {
  dice random(seed);
  program p;
  p.lower = random_vector(random, blocks, -1, 0.2);
  p.low = random_vector(random, blocks, -1, -0.1);
  p.high = random_vector(random, blocks, 0.1, 1);
  p.radius = random_vector(random, blocks, 0.1, 1.5);
  p.A = with_condition(random, p.size(), κ);
  p.b = p.A * random_vector(random, p.size(), -2, 2);
  // Multipliers that do not vanish with the small eigenvalues.
  p.b += 0.3 * random_vector(random, p.size(), -1, 1).cwiseProduct(p.A.diagonal());
  return p;
}

/// A variant is "seed", or "seed/blocks" for another size than the usual one.
std::uint64_t seed_of(std::string const& variant) {
  return std::strtoull(variant.c_str(), nullptr, 10);
}
Eigen::Index blocks_of(std::string const& variant, Eigen::Index usual) {
  auto const slash = variant.find('/');
  return slash == std::string::npos ? usual : std::strtol(variant.c_str() + slash + 1, nullptr, 10);
}

program conditioned(double κ, std::string const& seed) {
  return random_program(seed_of(seed), blocks_of(seed, 4), κ);
}
program tiny(double κ, std::string const& seed) {
  return random_program(1000 + seed_of(seed), 1, κ);
}

/// Each block in units of its own.
program rescaled_blocks(double decades, std::string const& seed) {
  program p = random_program(2000 + seed_of(seed), blocks_of(seed, 4), 100);
  dice random(seed_of(seed) + 99);
  Eigen::VectorXd s(p.size());
  Eigen::Index const first = p.lower.size(), second = first + p.low.size();
  for (Eigen::Index i = 0; i < p.size(); ++i)
    s[i] = std::pow(10.0, random.uniform(-decades, decades));
  for (Eigen::Index k = 0; k < p.radius.size(); ++k) s[second + 2 * k + 1] = s[second + 2 * k];
  p.A = (s.asDiagonal() * p.A * s.asDiagonal()).eval();
  p.b = p.b.cwiseProduct(s).eval();
  p.lower = p.lower.cwiseQuotient(s.head(first)).eval();
  p.low = p.low.cwiseQuotient(s.segment(first, p.low.size())).eval();
  p.high = p.high.cwiseQuotient(s.segment(first, p.high.size())).eval();
  for (Eigen::Index k = 0; k < p.radius.size(); ++k) p.radius[k] /= s[second + 2 * k];
  return p;
}

/// The whole program in other units of energy.
program units_of_energy(double exponent, std::string const& seed) {
  program p = random_program(3000 + seed_of(seed), blocks_of(seed, 3), 100);
  double const s = std::pow(10.0, exponent);
  p.A *= s;
  p.b *= s;
  return p;
}

/// Multipliers of size `parameter` on every active constraint: 0 is weak contact everywhere.
program weakly_active(double size, std::string const& seed) {
  program p = random_program(4000 + seed_of(seed), blocks_of(seed, 3), 1000);
  Eigen::VectorXd x(p.size()), z = Eigen::VectorXd::Zero(p.size());
  Eigen::Index const first = p.lower.size(), second = first + p.low.size();
  dice random(seed_of(seed) + 7);
  x.head(first) = p.lower;
  z.head(first).setConstant(size);
  x.segment(first, p.low.size()) = p.high;
  z.segment(first, p.low.size()).setConstant(-size);
  for (Eigen::Index k = 0; k < p.radius.size(); ++k) {
    double const φ = random.uniform(0, 6);
    p.radius[k] = 1;
    x[second + 2 * k] = std::cos(φ);
    x[second + 2 * k + 1] = std::sin(φ);
    z.segment(second + 2 * k, 2) = -size * x.segment(second + 2 * k, 2);
  }
  p.b = p.A * x - z;
  return p;
}

/// Intervals and discs that shrink to points.
program shrunk_sets(double size, std::string const& seed) {
  program p = random_program(5000 + seed_of(seed), blocks_of(seed, 3), 1000);
  p.low.setConstant(0.5);
  p.high.setConstant(0.5 + size);
  p.radius.head((p.radius.size() + 1) / 2).setConstant(size);
  return p;
}

/// A = [M M; M M + δ I] on half lines: the second half repeats the first one.
program redundant(double δ, std::string const& seed) {
  dice random(6000 + seed_of(seed));
  Eigen::Index const n = blocks_of(seed, 6);
  Eigen::MatrixXd M = with_condition(random, n, 100);
  program p;
  p.lower = Eigen::VectorXd::Zero(2 * n);
  p.A.resize(2 * n, 2 * n);
  p.A << M, M, M, M;
  p.A.bottomRightCorner(n, n).diagonal().array() += δ;
  Eigen::VectorXd const half = M * random_vector(random, n, -1, 2);
  p.b.resize(2 * n);
  p.b << half, half;
  return p;
}

/// Programs that have been told wrong before.
program known_case(double, std::string const& name) {
  program p;
  if (name == "pair") {
    p.A = Eigen::MatrixXd{{2, 1}, {1, 2}};
    p.b = Eigen::VectorXd{{1, 1}};
    p.lower = Eigen::VectorXd::Zero(2);
    return p;
  }
  // A disc on whose circle the solution is; the multiplier is a small part of b, or none.
  p.A = Eigen::MatrixXd{{1, 0}, {0, 1.06}};
  p.b = (name == "disc 1.5" ? 1.5 : 2.0) * Eigen::VectorXd{{0.6, 0.8}};
  p.radius = Eigen::VectorXd::Ones(1);
  return p;
}

std::vector<std::string> const loads{"press", "lift"};
std::vector<std::string> const seeds{"1", "2", "3", "4"};

}  // namespace

std::string program::name() const {
  char text[32];
  std::snprintf(text, sizeof text, "%g", parameter);
  return adversity + " " + text + " " + variant;
}

program program::rounded() const {
  program p = *this;
  auto const round = [](auto& data) {
    data = data.template cast<float>().template cast<double>().eval();
  };
  round(p.A);
  round(p.b);
  round(p.lower);
  round(p.low);
  round(p.high);
  round(p.radius);
  return p;
}

std::vector<family> const& families() {
  static std::vector<family> const all{
      {"slenderness", "length of a brick L × 1 × 1", {3, 30, 300, 3000, 30000}, loads, slender},
      {"thickness", "height of a brick 3 × 1 × t", {1, 0.1, 1e-2, 1e-3, 1e-4}, loads, thin},
      {"incompressibility", "½ − ν", {0.1, 1e-2, 1e-4, 1e-6, 1e-8}, loads, incompressible},
      {"grading", "last cell over the first one", {10, 100, 1e3, 1e4, 1e5}, loads, graded},
      {"contrast", "decades of E to either side", {1, 2, 3, 4, 6}, loads, contrasted},
      {"spring",
       "stiffness of the only support over max K_ii",
       {1, 1e-3, 1e-6, 1e-9, 1e-12},
       loads,
       sprung},
      {"rows", "decades of the units of N and T", {2, 4, 6, 8}, loads, rescaled_rows},
      {"force", "exponent of the unit of force", {8, -8, 150, -150}, loads, units_of_force},
      {"length", "exponent of the unit of length", {8, -8, 150, -150}, loads, units_of_length},
      {"gap",
       "gap, with slip bounds 0 at some nodes",
       {1e-7, 1e-6, 1e-5, 1e-4},
       loads,
       weak_contact},
      {"condition",
       "κ(A), 16 unknowns",
       {1, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12, 1e14},
       seeds,
       conditioned},
      {"tiny", "κ(A), 4 unknowns", {1, 10, 1e4, 1e8}, seeds, tiny},
      {"blocks", "decades of the units of blocks", {1, 2, 4, 8}, seeds, rescaled_blocks},
      {"energy",
       "exponent of the unit of energy",
       {8, -8, 150, -150, -300},
       seeds,
       units_of_energy},
      {"weak", "size of the multipliers", {1, 1e-4, 1e-8, 1e-12, 0}, seeds, weakly_active},
      {"points", "size of intervals and discs", {1, 1e-4, 1e-8, 1e-16, 0}, seeds, shrunk_sets},
      {"redundant", "what tells repeated rows apart", {1e-4, 1e-8, 1e-12, 0}, seeds, redundant},
      {"cases",
       "programs that have been told wrong before",
       {0},
       {"pair", "disc 2", "disc 1.5"},
       known_case},
  };
  return all;
}

program make_program(std::string_view name, double parameter, std::string const& variant) {
  for (auto const& f : families()) {
    if (f.name != name) continue;
    program p = f.make(parameter, variant);
    p.adversity = name;
    p.parameter = parameter;
    p.variant = variant;
    return p;
  }
  throw std::invalid_argument("no adversity " + std::string(name));
}

}  // namespace stability
