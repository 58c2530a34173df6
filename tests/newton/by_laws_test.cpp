// SPDX-License-Identifier: MIT
//
// Which solver the compiler chooses, and that a client's own takes part.
#include <slant/slant.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>
#include "newton_scene.hpp"

namespace by_laws_test {

template <class G, class V = VectorXd>
using choice = slant::chosen_solver_t<slant::by_laws, G, V>;

template <class A>
using residual_slant = slant::slant_operator_t<decltype(slant::natural_residual(
                                                   std::declval<A const&>(), VectorXd(),
                                                   newton_scene::contact_set(1, 1.0), 1.0)),
                                               VectorXd>;

using dense = decltype(slant::matrix(MatrixXd()));
using spd = decltype(slant::matrix<slant::self_adjoint, slant::positive_definite>(MatrixXd()));
using sparse = decltype(slant::matrix(Eigen::SparseMatrix<double>()));

static_assert(std::is_same_v<choice<residual_slant<spd>>, slant::symmetrized_cg>);
static_assert(std::is_same_v<choice<residual_slant<dense>>, slant::bicgstab_solver>);
static_assert(std::is_same_v<choice<slant::identity_operator>, slant::direct_solver>);
static_assert(std::is_same_v<choice<spd>, slant::cg_solver>);
static_assert(std::is_same_v<choice<dense>, slant::direct_solver>);
static_assert(std::is_same_v<choice<sparse>, slant::direct_solver>);
static_assert(
    std::is_same_v<choice<decltype(slant::counted(dense(MatrixXd())))>, slant::bicgstab_solver>);

namespace archetype = slant::testing::archetype;
static_assert(
    std::is_same_v<choice<archetype::linear_operator, archetype::vector>, slant::bicgstab_solver>);
static_assert(std::is_same_v<choice<archetype::spd_operator, archetype::vector>, slant::cg_solver>);

// Who makes a choice himself is not overruled.
static_assert(std::is_same_v<slant::chosen_solver_t<slant::bicgstab_solver, spd, VectorXd>,
                             slant::bicgstab_solver>);

/// dy = −F: a fixed-point iteration as the least of all linear solvers.
struct picard {
  template <class G, class V>
  [[nodiscard]] int prepare(G const&, V const&) const {
    return 0;
  }
  template <class G, class V>
  slant::direction_report<slant::scalar_t<V>> solve(
      G const& g, V const& f, slant::direction_request<slant::scalar_t<V>> const&, V& dy,
      int&) const {
    slant::local(dy) = -slant::local(f);
    auto image = f;
    slant::apply(g, dy, image);
    slant::local(image) += slant::local(f);
    return {slant::status::converged, slant::norm(image), 1, 1, 0};
  }
};

TEST_CASE("a solver, a globalisation and a forcing rule of a client's own") {
  struct cautious {
    [[nodiscard]] double first_length() const { return 0.5; }
    [[nodiscard]] bool accepts(slant::search_point<double> const& p) const {
      return p.residual < p.residual_before;
    }
    [[nodiscard]] double next_length(slant::search_point<double> const& p) const {
      return p.trial < 5 ? p.length / 4 : 0;
    }
  };
  newton_scene::data const d(3);
  auto const F =
      slant::natural_residual(d.A, d.b, newton_scene::contact_set(3, 1.0), 1 / d.A.norm());
  auto const half = [](slant::forcing_history<double> const&) { return 0.5; };
  slant::semismooth_newton const method{F, picard{}, cautious{}, half};
  auto s = method.start(d.zero());
  while (s.status == slant::status::running && s.residual_norm > 1e-6 * s.residual_scale)
    method.step(s);
  CHECK(s.residual_norm <= 1e-6 * s.residual_scale);
  CHECK(s.work.inner_iterations == s.iteration);
}

}  // namespace by_laws_test
