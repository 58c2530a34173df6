// SPDX-License-Identifier: MIT
//
// Time against error for contact with friction, beside one linear solve with the same K:
//
//     contact_precision SCENE SIZE [METHOD...] [options]
//
//     SCENE, SIZE       press, pull, lift (steel brick, k), plates (two bodies in 2D, k),
//                       bricks (two bodies in 3D, p)
//     METHOD            names of support/contact_methods.hpp; none: all; `none`: only the reference
//     --tolerances LIST 1e-2,1e-4,…: relative norms of the reduced gradient
//     --repeats N       runs of which the median counts
//     --limit S         processor seconds of a run
//     --export FOLDER   also writes the problem for other libraries, with its dense dual
//     --header 0        no line with the names of the columns
//     --factors WHAT    how much may be factored: all; linear: K once, for the linear solve; none
//
// prints rows of support/precision_table.hpp. The error is that of the displacements in the energy
// norm, relative to a reference: the symmetric Newton method as far as it gets, one step of
// iterative refinement, and, in the row `reference`, its distance from an interior point; where
// factors are too large for that, Newton's method for the displacements at 1e-13 on nested meshes
// and its distance from the same on aggregates. Exit status 1 if this distance exceeds 1e-5, or
// without factors 1e-9.

#include <slant/contact/preconditioners.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fem/write_folder.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/contact_methods.hpp"
#include "support/dense_form.hpp"
#include "support/linear_solve.hpp"
#include "support/peer_folder.hpp"

namespace {

using namespace benchmarks;
using vector = Eigen::VectorXd;

/// u and λ of higher accuracy, and how far an interior point is from u.
struct reference_solution {
  vector u, λ;
  double distance;
};

template <int D>
vector solve_reference(contact_case<D> const& c) {
  contact_setup const setup(c);
  auto const& dual = setup.dual();
  auto const M = slant::contact::lumped_preconditioner(c.scene.K, dual.constraints());
  auto const newton = slant::solve(slant::symmetric_newton{dual.qp(), M}, dual.zero(),
                                   slant::reduced_gradient_below(1e-15) || slant::at_most(300));
  auto const refined = [&](vector const& λ) {
    vector u = dual.displacement(λ), correction(u.size());
    vector const load = c.scene.f - dual.constraints().transpose() * λ;
    slant::apply(slant::inverse(setup.factor()), vector(load - c.scene.K * u), correction);
    return vector(u + correction);
  };
  auto const interior = slant::solve(slant::interior_point{dual.qp(), M}, dual.zero(),
                                     slant::reduced_gradient_below(1e-9) || slant::at_most(100));
  vector const u = refined(newton.x());
  double const distance = c.energy_norm(u - refined(interior.x())) / c.energy_norm(u);
  vector all(u.size() + newton.x().size() + 1);
  all << u, newton.x(), distance;
  return all;
}

/// The same without factors, λ left out.
template <int D>
vector iterate_reference(contact_case<D> const& c) {
  request const asked{1e-13, 0};
  vector const u = multigrid_newton{.nested = true}(c, asked).x;
  vector const other = multigrid_newton{.nested = false}(c, asked).x;
  vector all(u.size() + 1);
  all << u, c.energy_norm(u - other) / c.energy_norm(u);
  return all;
}

template <int D>
void export_folder(std::filesystem::path const& folder, contact_case<D> const& c,
                   row_labels const& labels, reference_solution const& reference) {
  auto const result = in_child(1e4, [&] {
    fem::write_folder(c.scene, folder);
    slant::write_text_vector(folder / "reference_u.txt", reference.u);
    auto const start = cpu_seconds();
    contact_setup const setup(c);
    auto const A = dense_form(setup.dual().constraints(), setup.factor());
    auto const formed = cpu_seconds();
    double const memory = peak_memory_mib();
    auto const u = setup.dual().displacement(reference.λ);
    auto const recovered = cpu_seconds();
    peer_problem p{.labels = labels, .b = setup.dual().b(), .reference = reference.λ};
    p.set = separable_set(p.b.size());
    auto const m = c.scene.contact_count();
    p.set.lower.head(m).setZero();
    if constexpr (D == 3) {
      p.set.add_discs(m, c.scene.g);
    } else {
      p.set.lower.tail(m) = -c.scene.g;
      p.set.upper.tail(m) = c.scene.g;
    }
    p.energy_norm = c.energy_norm(u);
    p.formation_seconds = formed - start;
    p.recovery_seconds = recovered - formed;
    write_peer_folder(folder, p, A, std::nullopt);
    return std::vector<double>{formed - start, memory};
  });
  precision_row row{
      .library = linear_solver_name, .method = "formation", .formulation = "dense dual"};
  row.status = result.how == ending::finished ? "converged" : "failed";
  if (result.how == ending::finished) {
    row.seconds = result.numbers[0];
    row.memory_mib = result.numbers[1];
  }
  row.print(labels);
}

template <int D>
bool run_case(contact_case<D> const& c, arguments const& given) {
  measuring const how = given.how();
  std::string const factors = given.get("factors", "all");
  bool const has_dual = factors == "all";
  if (!has_dual && factors != "linear" && factors != "none")
    throw std::invalid_argument("--factors: got " + factors + ", expected all, linear or none");
  if (!has_dual && c.nested.empty())
    throw std::invalid_argument("--factors " + factors + ": " + c.name + " has no nested meshes");
  row_labels labels{c.name, std::to_string(c.size), c.scene.K.rows(), std::nan("")};
  if (factors != "none") {
    auto const linear = in_child(1e4, [&] {
      auto const r = linear_solve(c.scene.K, c.scene.f, how.repeats);
      return std::vector<double>{r.seconds, r.memory_mib};
    });
    if (linear.how != ending::finished) return false;
    labels.linear_solve_seconds = linear.numbers[0];
    precision_row row{
        .library = linear_solver_name, .method = "linear_solve", .formulation = "K u = f"};
    row.seconds = linear.numbers[0];
    row.memory_mib = linear.numbers[1];
    row.status = "converged";
    row.print(labels);
  }

  auto const solved = in_child(1e4, [&] {
    vector const all = has_dual ? solve_reference(c) : iterate_reference(c);
    return std::vector<double>(all.begin(), all.end());
  });
  if (solved.how != ending::finished) return false;
  auto const n = c.scene.K.rows(), duals = has_dual ? c.scene.N.rows() + c.scene.T.rows() : 0;
  Eigen::Map<vector const> const all(solved.numbers.data(), n + duals + 1);
  reference_solution const reference{all.head(n), all.segment(n, duals), all[n + duals]};
  bool const agrees = reference.distance <= (has_dual ? 1e-5 : 1e-9);
  precision_row check{.library = "slant",
                      .method = "reference",
                      .formulation = has_dual ? "interior point" : "aggregation"};
  check.error = reference.distance;
  check.status = agrees ? "converged" : "failed";
  check.print(labels);

  if (auto const folder = given.get("export", ""); has_dual && !folder.empty())
    export_folder(folder, c, labels, reference);

  double const size = c.energy_norm(reference.u);
  auto const error = [&](vector const& u) { return c.energy_norm(u - reference.u) / size; };
  std::apply(
      [&](auto const&... method) {
        auto const measure = [&](auto const& m) {
          if (!given.wants(m.name, 2)) return;
          if constexpr (requires { m.run.fits(c); }) {
            if (!m.run.fits(c)) return;
          } else if (!has_dual) {
            return;  // all others take factors
          }
          measure_method(
              {.library = "slant", .method = m.name, .formulation = m.formulation}, labels, how,
              [&](request const& r) { return m.run(c, r); }, error);
        };
        (measure(method), ...);
      },
      contact_methods());
  given.require_known(2);
  return agrees;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    arguments const given(argc, argv,
                          {"tolerances", "repeats", "limit", "export", "header", "factors"});
    if (given.words().size() < 2)
      throw std::invalid_argument("usage: contact_precision SCENE SIZE [METHOD...] [options]");
    if (given.get("header", "1") != "0") print_precision_header();
    bool good = false;
    with_contact_case(given.words()[0], std::stoi(given.words()[1]),
                      [&](auto const& c) { good = run_case(c, given); });
    return good ? 0 : 1;
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "contact_precision: %s\n", failure.what());
    return 2;
  }
}
