// SPDX-License-Identifier: MIT
//
// Time against error for separable quadratic programs, beside one linear solve with their matrix:
//
//     separable_precision SCENE SIZE [METHOD...] [options]
//
//     SCENE, SIZE       wire (m: 4m unknowns), torsion, bearing, lower_obstacle, double_obstacle
//                       (n: n × n nodes), stokes (mesh 1 … 4)
//     METHOD            names in `methods` below; none: all; `none`: only the reference
//     --meshes FOLDER   of the flow, examples/stokes/meshes
//     and --tolerances, --repeats, --limit, --export, --header as in contact_precision.
//
// prints rows of support/precision_table.hpp. The error is ‖x − x*‖_A / ‖x*‖_A; x* is what the
// symmetric Newton method reaches, and the row `reference` its distance from an interior point.
// Exit status 1 if that exceeds 1e-5.

#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/symmetric_newton.hpp>

#include <cstdio>
#include <exception>
#include <stokes/channel_mesh.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "support/arguments.hpp"
#include "support/dense_form.hpp"
#include "support/linear_solve.hpp"
#include "support/separable_case.hpp"

namespace {

using namespace benchmarks;
using vector = Eigen::VectorXd;

template <class Setup>
auto newton_options(Setup const& setup, request const& asked) {
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = asked.tolerance;
  setup.adapt(o);
  return o;
}

template <class QP>
vector zero(QP const& qp) {
  return vector::Zero(qp.b().size());
}

/// solve(setup, request) → report.
template <class Solve>
struct method {
  char const* name;
  Solve solve;
};
template <class Solve>
method(char const*, Solve) -> method<Solve>;

auto methods() {
  return std::tuple{
      method{"symmetric_newton_preconditioned",
             [](auto const& s, request const& r) {
               auto const qp = s.qp();
               return slant::solve(
                   slant::symmetric_newton{qp, s.preconditioner(), newton_options(s, r)}, zero(qp),
                   r.stop());
             }},
      method{"symmetric_newton",
             [](auto const& s, request const& r) {
               auto const qp = s.qp();
               slant::symmetric_newton_options<double> o;
               o.forcing.goal = r.tolerance;
               return slant::solve(slant::symmetric_newton{qp, o}, zero(qp), r.stop());
             }},
      method{
          "interior_point_preconditioned",
          [](auto const& s, request const& r) {
            auto const qp = s.qp();
            return slant::solve(slant::interior_point{qp, s.preconditioner()}, zero(qp), r.stop());
          }},
      method{"kprgp",
             [](auto const& s, request const& r) {
               auto const qp = s.qp();
               return slant::solve(slant::kprgp{qp}, zero(qp), r.stop());
             }},
      method{"gimssn", [](auto const& s, request const& r) {
               auto const qp = s.qp();
               return slant::solve(slant::gimssn{qp}, zero(qp), r.stop());
             }}};
}

/// √(xᵀA x).
template <class QP>
double energy_norm(QP const& qp, vector const& x) {
  vector image(x.size());
  auto w = slant::workspace(qp.a(), x);
  slant::apply(qp.a(), x, image, w);
  return std::sqrt(x.dot(image));
}

/// x*, and how far an interior point is from it.
template <class Case>
std::vector<double> solve_reference(Case const& c) {
  typename Case::setup const s(c);
  auto const qp = s.qp();
  auto const M = s.preconditioner();
  auto const newton =
      slant::solve(slant::symmetric_newton{qp, M, newton_options(s, {0, 0})}, zero(qp),
                   slant::reduced_gradient_below(1e-15) || slant::at_most(300));
  auto const interior = slant::solve(slant::interior_point{qp, M}, zero(qp),
                                     slant::reduced_gradient_below(1e-9) || slant::at_most(100));
  vector const& x = newton.x();
  std::vector<double> all(x.begin(), x.end());
  all.push_back(energy_norm(qp, x - interior.x()) / energy_norm(qp, x));
  return all;
}

/// The problem for other libraries: A as a sparse matrix, or of a flow as a dense one.
template <class Case>
void export_folder(std::string const& folder, Case const& c, row_labels const& labels,
                   vector const& reference) {
  auto const result = in_child(1e4, [&] {
    auto const start = cpu_seconds();
    typename Case::setup const s(c);
    peer_problem p{.labels = labels, .b = s.qp().b(), .set = c.bounds(), .reference = reference};
    p.energy_norm = energy_norm(s.qp(), reference);
    if constexpr (requires { s.dual(); }) {
      Eigen::MatrixXd A = dense_form(s.dual().constraints(), s.factor());
      auto const n_p = c.scene.pressure_count();
      auto const S = s.dual().units().tail(n_p).asDiagonal();
      A.bottomRightCorner(n_p, n_p) += Eigen::MatrixXd(S * c.scene.E * S);
      p.formation_seconds = cpu_seconds() - start;
      write_peer_folder(folder, p, A, std::nullopt);
    } else {
      write_peer_folder(folder, p, std::nullopt, c.linear_matrix());
    }
    return std::vector<double>{p.formation_seconds};
  });
  if (result.how != ending::finished) throw std::runtime_error("cannot export to " + folder);
}

template <class Case>
bool run_case(Case const& c, arguments const& given) {
  measuring const how = given.how();
  row_labels labels{c.name, std::to_string(c.size), c.linear_matrix().rows()};
  auto const linear = in_child(1e4, [&] {
    auto const r = linear_solve(c.linear_matrix(), c.linear_load(), how.repeats);
    return std::vector<double>{r.seconds, r.memory_mib};
  });
  auto const solved = in_child(1e4, [&] { return solve_reference(c); });
  if (linear.how != ending::finished || solved.how != ending::finished) return false;
  labels.linear_solve_seconds = linear.numbers[0];
  precision_row row{
      .library = linear_solver_name, .method = "linear_solve", .formulation = "A x = b"};
  row.seconds = linear.numbers[0];
  row.memory_mib = linear.numbers[1];
  row.status = "converged";
  row.print(labels);

  vector const reference = Eigen::Map<vector const>(
      solved.numbers.data(), static_cast<Eigen::Index>(solved.numbers.size()) - 1);
  double const distance = solved.numbers.back();
  precision_row check{.library = "slant", .method = "reference", .formulation = "interior point"};
  check.error = distance;
  check.status = distance <= 1e-5 ? "converged" : "failed";
  check.print(labels);
  if (auto const folder = given.get("export", ""); !folder.empty())
    export_folder(folder, c, labels, reference);

  std::apply(
      [&](auto const&... each) {
        auto const measure = [&](auto const& m) {
          if (!given.wants(m.name, 2)) return;
          measure_method(
              {.library = "slant", .method = m.name, .formulation = "separable"}, labels, how,
              [&](request const& r) {
                typename Case::setup const s(c);
                auto const report = m.solve(s, r);
                if constexpr (requires { s.dual(); }) (void)s.dual().solution(report.x());
                return outcome{report.x(), all_products(report.state.work),
                               status_name(report.status)};
              },
              [&](vector const& x) {
                typename Case::setup const s(c);
                return energy_norm(s.qp(), x - reference) / energy_norm(s.qp(), reference);
              });
        };
        (measure(each), ...);
      },
      methods());
  given.require_known(2);
  return distance <= 1e-5;
}

bool run(arguments const& given) {
  auto const& name = given.words()[0];
  int const size = std::stoi(given.words()[1]);
  if (name == "wire") return run_case(wire_case{.size = size}, given);
  if (name == "stokes") {
    auto const meshes = given.get("meshes", SLANT_EXAMPLE_MESHES);
    return run_case(
        stokes_case{.size = size, .flow = fem::make_channel_flow(stokes::read_mesh(meshes, size))},
        given);
  }
  for (auto const known : membranes::problems)
    if (name == known) return run_case(membrane_case{.name = name, .size = size}, given);
  throw std::invalid_argument("scene: got " + name + ", expected wire, torsion, bearing, " +
                              "lower_obstacle, double_obstacle or stokes");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    arguments const given(argc, argv,
                          {"tolerances", "repeats", "limit", "export", "header", "meshes"});
    if (given.words().size() < 2)
      throw std::invalid_argument("usage: separable_precision SCENE SIZE [METHOD...] [options]");
    if (given.get("header", "1") != "0") print_precision_header();
    return run(given) ? 0 : 1;
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "separable_precision: %s\n", failure.what());
    return 2;
  }
}
