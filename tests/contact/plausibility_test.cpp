// SPDX-License-Identifier: MIT
//
// One defect at a time in sound scenes, and no warning for any of these.
#include <slant/contact/plausibility.hpp>

#include <fem/stacked_bricks.hpp>
#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <support/testing.hpp>

namespace plausibility_test {

using slant::contact::check_plausibility;

/// Contact data whose rows can be changed.
struct model {
  sparse K;
  MatrixXd N, T;
  VectorXd f, d, g;
  slant::contact::node_layout<double> layout{};

  [[nodiscard]] slant::contact::data<double> data() const {
    return {N.sparseView(), T.sparseView(), f, d, g};
  }
  /// All warnings as "kind at count", one after the other.
  [[nodiscard]] std::string warnings(bool places = false) const {
    return listed(places ? check_plausibility(K, data(), layout) : check_plausibility(K, data()));
  }
  [[nodiscard]] static std::string listed(
      std::vector<slant::contact::plausibility_warning> const& found) {
    std::string text;
    for (auto const& w : found) {
      text += std::string(to_string(w.kind)) + " " + std::to_string(w.at) + " " +
              std::to_string(w.count) + "; ";
      CHECK(w.text.size() > 40);
      CHECK(w.text.find('\n') == w.text.npos);
    }
    return text;
  }
  [[nodiscard]] Index m() const { return N.rows(); }
};

/// No warning, whether places are known or not.
void check_sound(model const& s) {
  CHECK(s.warnings() == "");
  CHECK(s.warnings(true) == "");
}

template <int D>
model model_of(fem::contact_scene<D> const& s) {
  return {s.K,
          MatrixXd(s.N),
          MatrixXd(s.T),
          s.f,
          s.d,
          s.g,
          slant::contact::layout_of(s.mesh.nodes, s.unknowns.first)};
}

model brick(int k = 2, fem::brick_load load = fem::brick_load::press) {
  return model_of(fem::make_steel_brick({.k = k, .load = load}));
}

model plate() {
  return model_of(
      fem::make_contact_scene<2>({.mesh = fem::make_box_mesh<2>({4, 2}, Vector2d(2, 1)),
                                  .material = fem::lame(10, 0.3),
                                  .fixed = {.axis = 0, .upper = false},
                                  .contact = {.axis = 1, .upper = false},
                                  .loads = {{{.axis = 1, .upper = true}, Vector2d(0, -1)}},
                                  .slip_bound = 0.3}));
}

/// The frames (N, T) of all nodes turned by one orthogonal matrix: an inclined obstacle.
model turned(model s, Eigen::Matrix3d const& Q) {
  for (Index i = 0; i < s.m(); ++i) {
    MatrixXd frame(3, s.N.cols());
    frame << s.N.row(i), s.T.middleRows(2 * i, 2);
    frame = Q * frame;
    s.N.row(i) = frame.row(0);
    s.T.middleRows(2 * i, 2) = frame.bottomRows(2);
  }
  return s;
}
/// A slope of 11 degrees.
Eigen::Matrix3d slope() {
  double const c = std::cos(0.2), t = std::sin(0.2);
  return Eigen::Matrix3d{{c, t, 0}, {-t, c, 0}, {0, 0, 1}};
}
Eigen::Matrix3d rotation() {
  Vector3d const v = Vector3d(1, 2, 2) / 3;
  return Eigen::Matrix3d::Identity() - 2 * v * v.transpose();
}

/// Each contact point lies between two contact nodes: rows with several entries.
model between(model s, double share) {
  Index const k = s.T.rows() / s.m();
  model r = s;
  for (Index i = 0; i < s.m(); ++i) {
    Index const j = (i + 1) % s.m();
    r.N.row(i) = (1 - share) * s.N.row(i) + share * s.N.row(j);
    r.T.middleRows(k * i, k) =
        (1 - share) * s.T.middleRows(k * i, k) + share * s.T.middleRows(k * j, k);
  }
  return r;
}

/// Without the unknowns of one direction at some nodes, as on a plane of symmetry.
model symmetric(model s, int axis, double at) {
  std::vector<Index> kept;
  slant::contact::node_layout<double> layout{s.layout.x, {}, {}};
  for (Index j = 0; j < s.K.rows(); ++j) {
    auto const u = static_cast<std::size_t>(j);
    if (s.layout.axis[u] == axis && s.layout.x(axis, s.layout.node[u]) == at) continue;
    kept.push_back(j);
    layout.node.push_back(s.layout.node[u]);
    layout.axis.push_back(s.layout.axis[u]);
  }
  auto const P = slant::detail::columns_of_identity<double>(s.K.rows(), kept);
  return {sparse(P.transpose() * s.K * P), s.N * P, s.T * P, P.transpose() * s.f, s.d, s.g, layout};
}

/// The unknowns direction by direction instead of node by node.
model by_directions(model const& s, int D) {
  Index const n = s.K.rows();
  Eigen::PermutationMatrix<Eigen::Dynamic> P(n);
  for (Index j = 0; j < n; ++j) P.indices()[j] = int(j % D * (n / D) + j / D);
  model r{sparse(P * s.K * P.transpose()),
          s.N * P.transpose(),
          s.T * P.transpose(),
          P * s.f,
          s.d,
          s.g,
          s.layout};
  for (Index j = 0; j < n; ++j) {
    auto const to = static_cast<std::size_t>(P.indices()[j]);
    r.layout.node[to] = s.layout.node[std::size_t(j)];
    r.layout.axis[to] = s.layout.axis[std::size_t(j)];
  }
  return r;
}

/// K without entries that are zero or nearly so, as programs store it that know no structure.
model without_zeros(model s) {
  s.K.prune(1.0, 1e-12 * s.K.norm());
  return s;
}

model frictionless(model s) {
  s.T.resize(0, s.N.cols());
  s.g.resize(0);
  return s;
}

/// Every way to write down a scene in space.
std::vector<model> variants(model const& s) {
  std::vector<model> all{s,
                         turned(s, rotation()),
                         between(s, 0.5),
                         between(s, 0.3),
                         by_directions(s, 3),
                         without_zeros(s),
                         turned(without_zeros(s), rotation()),
                         frictionless(s)};
  return all;
}

TEST_CASE("no warning about sound scenes in space") {
  for (int const k : {1, 2, 3}) {
    for (auto const load : fem::brick_loads)
      for (model const& s : variants(brick(k, load))) check_sound(s);
  }
  for (model const& s : variants(model_of(fem::make_two_bricks(3)))) check_sound(s);
  for (double const unit : {1e-150, 1e150}) {
    model s = brick();
    s.K *= unit;
    s.f *= unit;
    s.g *= unit;
    CHECK(s.warnings() == "");
    s.layout.x *= unit;
    CHECK(s.warnings(true) == "");
  }
  for (model s : {brick(), turned(brick(), rotation())}) {
    s.d[2] = infinity;
    s.g[1] = infinity;
    s.g[3] = 0;
    CHECK(s.warnings() == "");
    s.g.setZero();
    CHECK(s.warnings() == "");
    s.g.setConstant(infinity);
    CHECK(s.warnings() == "");
  }
  for (int const axis : {0, 1}) {
    check_sound(symmetric(brick(), axis, 1));
    CHECK(symmetric(turned(brick(), rotation()), axis, 1).warnings() == "");
  }
  CHECK(symmetric(model_of(fem::make_two_bricks(3)), 1, 0).warnings() == "");
}

TEST_CASE("no warning about sound scenes in the plane, nor about stacks and corners") {
  for (model const& s :
       {plate(), model_of(fem::make_two_plates(2)), model_of(fem::make_two_plates(4)),
        between(plate(), 0.5), without_zeros(plate()), by_directions(plate(), 2),
        frictionless(plate())}) {
    check_sound(s);
  }
  for (double const gap : {0.0, 1e-3}) {
    auto const stack = fem::make_stack({.bricks = 3, .gap = gap});
    auto const layout = slant::contact::layout_of(stack.mesh.nodes, stack.unknowns.first);
    model const s{stack.K, MatrixXd(stack.B), MatrixXd(0, stack.K.rows()), stack.f, stack.c, {},
                  layout};
    check_sound(s);
  }
  // A corner, where two walls share a tangent, and a string between two obstacles.
  model corner = brick();
  Index const n = corner.N.cols();
  corner.N.conservativeResize(corner.m() + 1, n);
  corner.N.row(corner.m() - 1) = -corner.T.row(1);
  corner.T.conservativeResize(2 * corner.m(), n);
  corner.T.row(2 * corner.m() - 2) = corner.T.row(0);
  corner.T.row(2 * corner.m() - 1) = corner.N.row(0);
  corner.d.setZero(corner.m());
  corner.g.setOnes(corner.m());
  CHECK(corner.warnings() == "");
  model both = frictionless(plate());
  both.N.conservativeResize(2 * both.m(), both.N.cols());
  both.N.bottomRows(both.m() / 2) = -both.N.topRows(both.m() / 2);
  both.d.setOnes(both.m());
  CHECK(both.warnings() == "");
}

TEST_CASE("rows of N in another order than those of T") {
  for (model s : variants(brick())) {
    if (s.T.rows() == 0) continue;
    MatrixXd const N = s.N;
    s.N << N.bottomRows(5), N.topRows(s.m() - 5);
    CHECK(s.warnings() == "different_nodes 0 18; ");
    CHECK(s.warnings(true) == "different_nodes 0 18; ");
    s.N = N;
    s.N.row(3).swap(s.N.row(11));
    CHECK(s.warnings() == "different_nodes 3 2; ");
    CHECK(check_plausibility(s.K, s.data())
              .front()
              .text.starts_with(
                  "row 3 of N touches other nodes of the body than rows 6 and 7 of "
                  "T, namely those of rows 22 "
                  "and 23 of T; the same holds for 1 more of the rows of N. Put the rows"));
  }
  for (model s : {plate(), model_of(fem::make_two_plates(3)), between(plate(), 0.5)}) {
    s.N = s.N.colwise().reverse().eval();
    CHECK(s.warnings().starts_with("different_nodes 0 "));
  }
}

TEST_CASE("T with all first and then all second tangents; T with half of its rows") {
  for (model s : variants(brick())) {
    if (s.T.rows() == 0) continue;
    MatrixXd const T = s.T;
    for (Index i = 0; i < s.m(); ++i) {
      s.T.row(i) = T.row(2 * i);
      s.T.row(s.m() + i) = T.row(2 * i + 1);
    }
    CHECK(s.warnings() == "grouped_tangents 0 1; ");
    s.T = T;
    for (Index i = 0; i < s.m(); ++i) s.T.row(i) = T.row(2 * i);
    s.T.conservativeResize(s.m(), s.T.cols());
    CHECK(s.warnings() == "missing_tangents 0 1; ");
    CHECK(s.warnings(true) == "missing_tangents 0 1; ");
    // The first half of the rows.
    s.T = T.topRows(s.m());
    CHECK(s.warnings().starts_with("missing_tangents 0 1; "));
  }
}

TEST_CASE("beams in the plane have three unknowns at a node and one tangent") {
  // Along, across and rotation: EA = 10, EI = 1, L = 1, clamped at its beginning.
  int const nodes = 5;
  MatrixXd K = MatrixXd::Zero(3 * nodes, 3 * nodes);
  MatrixXd const e{{10, 0, 0, -10, 0, 0}, {0, 12, 6, 0, -12, 6},   {0, 6, 4, 0, -6, 2},
                   {-10, 0, 0, 10, 0, 0}, {0, -12, -6, 0, 12, -6}, {0, 6, 2, 0, -6, 4}};
  for (int i = 0; i + 1 < nodes; ++i) K.block<6, 6>(3 * i, 3 * i) += e;
  sparse const held = K.bottomRightCorner(12, 12).sparseView(1.0, -1.0);
  model s{held,
          MatrixXd::Zero(4, 12),
          MatrixXd::Zero(4, 12),
          VectorXd::Ones(12),
          VectorXd::Zero(4),
          VectorXd::Ones(4)};
  for (int i = 0; i < 4; ++i) {
    s.N(i, 3 * i + 1) = -1;
    s.T(i, 3 * i) = 1;
  }
  CHECK(s.warnings() == "");
}

TEST_CASE("signs of N") {
  for (model s : {brick(), turned(brick(), slope()), by_directions(brick(), 3)}) {
    s.N.row(7) *= -1;
    CHECK(s.warnings() == "opposed_normal 7 1; ");
    CHECK(s.warnings(true) == "inward_normal 7 1; ");
    s.N.row(7) *= -1;
    s.N *= -1;
    CHECK(s.warnings(true) == "inward_normal 0 18; ");
  }
  for (model s : {plate(), model_of(fem::make_two_plates(3))}) {
    s.N.row(2) *= -1;
    CHECK(s.warnings() == "opposed_normal 2 1; ");
    CHECK(s.warnings(true) == "inward_normal 2 1; ");
  }
}

TEST_CASE("zero rows, repeated rows, oblique frames") {
  for (model const& sound : variants(brick())) {
    model s = sound;
    s.N.row(4).setZero();
    CHECK(s.warnings() == "zero_row 4 1; ");
    s.d[4] = infinity;  // is never looked at
    CHECK(s.warnings() == "");
    s = sound;
    s.N.row(12) = s.N.row(4);
    CHECK(s.warnings().find("duplicate_row 12 1; ") != std::string::npos);
    if (s.T.rows() == 0) continue;
    s = sound;
    s.T.row(9).setZero();
    CHECK(s.warnings() == "zero_row 9 1; ");
    s = sound;
    s.T.row(9) = s.T.row(3);
    CHECK(s.warnings() == "duplicate_row 9 1; ");
    s = sound;
    s.T.middleRows(24, 2) = s.T.middleRows(8, 2);
    s.N.row(12) = s.N.row(4);
    CHECK(s.warnings() == "duplicate_row 12 1; ");
    s = sound;
    s.T.row(9) = s.T.row(8);
    CHECK(s.warnings() == "oblique_frame 4 1; ");
    s.T.row(9) = s.T.row(8) + 0.1 * s.N.row(4);
    CHECK(s.warnings() == "oblique_frame 4 1; ");
    s = sound;
    s.T.row(9) += 0.5 * s.N.row(4);
    CHECK(s.warnings() == "oblique_frame 4 1; ");
  }
}

TEST_CASE("other units") {
  for (model const& sound : variants(brick())) {
    model s = sound;
    if (s.T.rows() == 0) {
      s.N.row(5) *= 1000;
      CHECK(s.warnings() == "other_units 5 1; ");
      continue;
    }
    for (double const unit : {1e-3, 10.0, 25.4, 1e150}) {
      s = sound;
      s.N *= unit;
      CHECK(s.warnings() == "other_units 0 1; ");
      s = sound;
      s.N.row(5) *= unit;
      CHECK(s.warnings() == "other_units 10 2; ");
      s = sound;
      s.T.row(5) *= unit;
      CHECK(s.warnings() == "other_units 5 1; ");
    }
  }
}

TEST_CASE("no contact, and displacements larger than the body") {
  model s = brick();
  s.d.setConstant(infinity);
  CHECK(s.warnings() == "no_contact 0 1; ");
  s = brick();
  MatrixXd const K = s.K;
  Eigen::LLT<MatrixXd> const factor(K);
  VectorXd const down = factor.solve(s.f), none = VectorXd::Zero(3 * s.m());
  auto const said = [&](VectorXd const& u, VectorXd const& λ) {
    auto const found = check_plausibility(s.K, s.data(), u, λ, s.layout);
    return model::listed(found);
  };
  CHECK(said(VectorXd(-down), none) == "no_contact 0 1; ");
  VectorXd pressed = none;
  pressed[3] = 0.1;
  CHECK(said(VectorXd(-down), pressed) == "");  // one node carries
  CHECK(said(down, none) == "");                // penetrates, but that is no solution
  pressed.head(s.m()).setOnes();
  VectorXd const large = down * (3.5 / down.cwiseAbs().maxCoeff());
  CHECK(said(large, pressed) == "large_displacement 0 1; ");
  CHECK(said(VectorXd(0.8 * large), pressed) == "");
}

}  // namespace plausibility_test
