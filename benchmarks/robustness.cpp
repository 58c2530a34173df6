// SPDX-License-Identifier: MIT
//
// Contact with Tresca's friction without factors where multigrid has a hard time:
//
//     robustness [K] [MESH.msh...]     the steel brick of K cells, 12; K divisible by 4
//
// nearly incompressible, of long and of flat cells, of two materials in a chequerboard, with slip
// bounds from 0 to a million times the pressure, with contact of a few nodes; and bodies of meshes
// of tetrahedra by Gmsh (MSH 2.2, text), fixed where x is least, on a floor where z is least, under
// a body force (holed_brick.geo). Levels by aggregation, and by interpolation where meshes are
// nested; smoothed by sweeps, and once by polynomials.
//
// It prints comma-separated values: scene, load, levels, unknowns, Newton steps, cycles, processor
// seconds, status, the relative error in the energy norm as certified, and against the dual method
// with factors at 1e-12. Exit status 1 if a run says `converged` with an error above 1e-8, or above
// what is certified by more than a tenth.

#include <slant/contact/solve.hpp>

#include <fem/box_prolongations.hpp>
#include <fem/steel_brick.hpp>
#include <support/chequered_brick.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using vector = Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
namespace contact = slant::contact;

struct scene {
  std::string name, load;
  sparse K;
  contact::data<double> data;
  contact::node_layout<double> layout;
  std::vector<sparse> prolongations{};
  slant::index chebyshev = 0;  // degree of polynomials in place of sweeps
};

contact::solution<double> run(scene const& s, contact::solution_route route, double tolerance,
                              bool nested) {
  contact::solve_options<double> o{.tolerance = tolerance};
  o.layout = s.layout;
  o.route = route;
  if (nested) o.multigrid.prolongations = s.prolongations;
  o.multigrid.chebyshev = s.chebyshev;
  return contact::solve(s.K, s.data, o);
}

bool measure(scene const& s, bool nested, contact::solution<double> const& exact) {
  std::clock_t const start = std::clock();
  auto const r = run(s, contact::solution_route::iterate, 1e-8, nested);
  double const seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  auto const energy = [&](vector const& u) { return std::sqrt(u.dot(vector(s.K * u))); };
  double const error = energy(r.u - exact.u) / energy(exact.u), certified = r.error.relative();
  std::printf("%s,%s,%s,%td,%td,%td,%.3f,%s,%.1e,%.1e\n", s.name.c_str(), s.load.c_str(),
              nested ? "nested" : "aggregation", s.K.rows(), r.iterations, r.work.inner_iterations,
              seconds, std::string(to_string(r.status)).c_str(), certified, error);
  std::fflush(stdout);
  return !r.converged() || (error <= 1e-8 && error <= 1.1 * certified);
}

bool measure(scene const& s) {
  auto const exact = run(s, contact::solution_route::factor, 1e-12, false);
  bool const good = measure(s, false, exact);
  return (s.prolongations.empty() || measure(s, true, exact)) && good;
}

scene brick(std::string name, fem::steel_brick_options const& o) {
  auto s = fem::make_steel_brick(o);
  return {std::move(name),
          std::string(name_of(o.load)),
          std::move(s.K),
          {std::move(s.N), std::move(s.T), std::move(s.f), std::move(s.d), std::move(s.g)},
          contact::layout_of(s.mesh.nodes, s.unknowns.first),
          fem::box_prolongations(fem::make_brick_mesh(o.k, o.size), s.unknowns)};
}

[[noreturn]] void fail(std::string const& what) {
  std::fprintf(stderr, "robustness: %s\n", what.c_str());
  std::exit(2);
}

/// Nodes and tetrahedra of a file of Gmsh, numbered from 1 without a gap.
fem::simplex_mesh<3> read_tetrahedra(std::string const& file) {
  std::ifstream in(file);
  if (!in) fail("cannot read " + file);
  fem::simplex_mesh<3> mesh;
  std::vector<int> corners;
  std::string word;
  while (in >> word) {
    Eigen::Index count = 0;
    if (word == "$Nodes") {
      in >> count;
      mesh.nodes.resize(3, count);
      for (Eigen::Index i = 0, number = 0; i < count && in; ++i) {
        in >> number;
        if (number < 1 || number > count) fail(file + ": nodes are not numbered from 1");
        in >> mesh.nodes(0, number - 1) >> mesh.nodes(1, number - 1) >> mesh.nodes(2, number - 1);
      }
    } else if (word == "$Elements") {
      in >> count;
      for (Eigen::Index i = 0; i < count && in; ++i) {
        int number = 0, type = 0, tags = 0, tag = 0;
        in >> number >> type >> tags;
        for (int t = 0; t < tags; ++t) in >> tag;
        int const nodes = type == 15 ? 1 : type == 1 ? 2 : type == 2 ? 3 : type == 4 ? 4 : 0;
        if (nodes == 0) fail(file + ": an element that is no simplex of linear functions");
        for (int a = 0, node = 0; a < nodes; ++a) {
          in >> node;
          if (type == 4) corners.push_back(node - 1);
        }
      }
    }
  }
  if (corners.empty()) fail(file + ": no tetrahedra");
  mesh.cells = Eigen::Map<Eigen::Matrix4Xi const>(corners.data(), 4,
                                                  static_cast<Eigen::Index>(corners.size() / 4));
  return mesh;
}

scene body(std::string const& file) {
  auto const mesh = read_tetrahedra(file);
  Eigen::Vector3d const least = mesh.nodes.rowwise().minCoeff();
  double const near = 1e-9 * (mesh.nodes.rowwise().maxCoeff() - least).maxCoeff();
  auto const at = [&](Eigen::Index axis, Eigen::Index node) {
    return mesh.nodes(axis, node) <= least[axis] + near;
  };
  auto const unknowns = fem::number_unknowns(mesh, [&](Eigen::Index i) { return at(0, i); });
  scene s{file.substr(file.find_last_of('/') + 1),
          "drag",
          fem::stiffness<3>(mesh, unknowns, fem::lame(2.119e5, 0.277)),
          {},
          contact::layout_of(mesh.nodes, unknowns.first)};
  auto& c = s.data;
  c.f = vector::Zero(s.K.rows());
  for (Eigen::Index cell = 0; cell < mesh.cell_count(); ++cell) {
    double const share = fem::element_of<3>(mesh, cell).volume / 4;
    for (Eigen::Index a = 0; a < 4; ++a) {
      int const first = unknowns.first[mesh.cells(a, cell)];
      if (first >= 0) c.f.segment<3>(first) += share * Eigen::Vector3d(0.6, 0.2, -1);
    }
  }
  std::vector<int> floor;
  for (Eigen::Index i = 0; i < mesh.node_count(); ++i) {
    if (at(2, i) && !unknowns.is_fixed(i)) floor.push_back(unknowns.first[i]);
  }
  auto const m = static_cast<Eigen::Index>(floor.size());
  c.N.resize(m, s.K.rows());
  c.T.resize(2 * m, s.K.rows());
  for (Eigen::Index i = 0; i < m; ++i) {
    int const first = floor[static_cast<std::size_t>(i)];
    c.N.insert(i, first + 2) = -1;
    c.T.insert(2 * i, first) = 1;
    c.T.insert(2 * i + 1, first + 1) = 1;
  }
  c.d = vector::Zero(m);
  c.g = vector::Constant(m, 0.3 * c.f.cwiseAbs().sum() / 3 / double(m));
  return s;
}

}  // namespace

int main(int argc, char** argv) {
  int k = 12;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    std::string const argument = argv[i];
    if (argument.ends_with(".msh")) {
      files.push_back(argument);
    } else if (k = std::atoi(argv[i]); k < 4 || k % 4 != 0) {
      std::fprintf(stderr, "usage: robustness [K] [MESH.msh...]\n");
      return 2;
    }
  }
  std::printf("scene,load,levels,unknowns,steps,cycles,seconds,status,certified,error\n");
  bool good = true;
  for (auto const load : {fem::brick_load::press, fem::brick_load::lift}) {
    good = measure(brick("brick", {.k = k, .load = load})) && good;
    for (double const ν : {0.45, 0.49, 0.499}) {
      good =
          measure(brick("nu " + slant::detail::show(ν), {.k = k, .load = load, .nu = ν})) && good;
    }
    good = measure(brick("cells 10:1:1", {.k = k, .load = load, .size = {30, 1, 1}})) && good;
    good = measure(brick("cells 1:10:10", {.k = k, .load = load, .size = {0.3, 1, 1}})) && good;
    scene s = brick("brick by Chebyshev polynomials", {.k = k, .load = load});
    s.chebyshev = 2;
    good = measure(s) && good;
    s = brick("materials 1:1e-4", {.k = k, .load = load});
    s.K = test::chequered_stiffness(k, 1e-4);
    good = measure(s) && good;
    for (double const factor : {0.0, 1e-6, 1e6}) {
      s = brick("slip bounds x " + slant::detail::show(factor), {.k = k, .load = load});
      s.data.g *= factor;
      good = measure(s) && good;
    }
    s = brick("contact of few nodes", {.k = k, .load = load});
    for (Eigen::Index i = 0; i < s.data.d.size(); ++i) s.data.d[i] = i % 50 == 0 ? 0 : 1;
    good = measure(s) && good;
  }
  for (auto const& file : files) good = measure(body(file)) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
