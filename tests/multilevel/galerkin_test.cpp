// SPDX-License-Identifier: MIT
#include "block_vectors.hpp"
#include "grids.hpp"

#include <slant/multilevel/parts/galerkin.hpp>
#include <slant/multilevel/parts/node_face.hpp>
#include <slant/multilevel/parts/prolongation.hpp>

#include <fem/steel_brick.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <support/testing.hpp>

namespace galerkin_test {

using namespace test::evaluated;
using Eigen::Matrix3d;
using slant::block_matrix;
using slant::detail::prolongation;

/// Each node belongs to two neighbours of a line of coarse nodes, every fifth to none.
template <int N, int M>
prolongation<N, M, double> sample(int nodes, bool weights) {
  prolongation<N, M, double> P;
  P.coarse_nodes = nodes / 4 + 2;
  P.weights = weights;
  for (int i = 0; i < nodes; ++i) {
    for (int J = i / 4; J < i / 4 + 2 && i % 5 != 4; ++J) {
      P.column.push_back(J);
      for (int k = 0; k < (weights ? 1 : N * M); ++k)
        P.entries.push_back(std::sin(1.0 + i + 3.0 * J + 7.0 * k));
    }
    P.first.push_back(static_cast<int>(P.column.size()));
  }
  P.entries.resize(P.entries.size() + P.beyond, 0.0);
  return P;
}

template <int N, int M>
MatrixXd dense(prolongation<N, M, double> const& P) {
  MatrixXd m = MatrixXd::Zero(N * P.nodes(), M * P.coarse_nodes);
  for (int i = 0; i < P.nodes(); ++i) {
    for (int e = P.begin(i); e < P.end(i); ++e) {
      for (int q = 0; q < N; ++q) {
        for (int c = 0; c < M; ++c) {
          m(N * i + q, M * P.at(e) + c) =
              P.weights ? (q == c ? P.weight(e) : 0.0) : P.block(e)[M * q + c];
        }
      }
    }
  }
  return m;
}

template <int N, int M>
void check_product(sparse const& K, bool weights) {
  block_matrix<N, double> const A(K);
  auto const P = sample<N, M>(A.nodes(), weights);
  std::size_t longest = 0;
  auto C = slant::detail::galerkin_pattern(A, P, longest);
  slant::detail::galerkin_scratch<N, M, double> w(P, longest);
  slant::detail::galerkin(A, P, C, w);
  MatrixXd const p = dense(P), expected = p.transpose() * MatrixXd(K) * p;
  MatrixXd const found = test::dense(C);
  CHECK((found - expected).norm() <= 1e-13 * expected.norm());
  bool const symmetric = found == found.transpose();
  CHECK(symmetric);

  VectorXd const r = VectorXd::LinSpaced(K.rows(), -1, 2);
  VectorXd const z = VectorXd::LinSpaced(p.cols(), 3, -1);
  auto b = test::packed<M, double>(z);
  P.restrict_to(test::packed<N, double>(r).data(), b.data());
  CHECK((test::unpacked<M, double>(b) - p.transpose() * r).norm() <= 1e-13 * r.norm() * p.norm());
  auto x = test::packed<N, double>(r);
  P.add_to(test::packed<M, double>(z).data(), x.data());
  CHECK((test::unpacked<N, double>(x) - r - p * z).norm() <= 1e-13 * z.norm() * p.norm());
}

TEST_CASE("coarse matrices, restriction and prolongation by dense algebra") {
  sparse const K = fem::make_steel_brick({.k = 2}).K / 2e5;
  check_product<3, 6>(K, false);
  check_product<3, 3>(K, false);
  check_product<3, 3>(K, true);
  check_product<6, 6>(K, false);
  check_product<2, 3>(K, false);
  check_product<1, 1>(K, false);
}

/// Node i: every motion, none, those in the plane across n, those along n; a curvature on it.
struct surface {
  MatrixXd Π, C;

  explicit surface(Eigen::Index n) : Π(MatrixXd::Identity(n, n)), C(MatrixXd::Zero(n, n)) {}
  void hold(int i) { Π.block<3, 3>(3 * i, 3 * i).setZero(); }
  void plane(int i, Vector3d const& n) {
    Π.block<3, 3>(3 * i, 3 * i) = Matrix3d::Identity() - n * n.transpose();
  }
  void line(int i, Vector3d const& n, double bend) {
    Π.block<3, 3>(3 * i, 3 * i) = n * n.transpose();
    C.block<3, 3>(3 * i, 3 * i) = bend * n * n.transpose();
  }
  void free(int i) {
    Π.block<3, 3>(3 * i, 3 * i).setIdentity();
    C.block<3, 3>(3 * i, 3 * i).setZero();
  }
  void block_entries(auto const& f) const {
    for (Eigen::Index i = 0; i < Π.rows(); ++i) {
      for (Eigen::Index j = 0; j < Π.rows(); ++j)
        if (i / 3 == j / 3 || Π(i, j) != 0) f(i, j, Π(i, j), C(i, j));
    }
  }
};

template <int M>
void check_face(bool weights) {
  sparse const K = fem::make_steel_brick({.k = 2}).K / 2e5;
  block_matrix<3, double> const A(K);
  auto const P = sample<3, M>(A.nodes(), weights);
  MatrixXd const p = dense(P);
  std::size_t longest = 0;
  auto C = slant::detail::galerkin_pattern(A, P, longest);
  slant::detail::galerkin_scratch<3, M, double> w(P, longest);
  slant::detail::galerkin(A, P, C, w);
  auto const untouched = C;
  auto D = C;

  auto const n = K.rows();
  std::vector<double> diagonal;
  MatrixXd inverse = MatrixXd::Zero(n, n);
  for (int i = 0; i < A.nodes(); ++i) {
    diagonal.insert(diagonal.end(), A.diagonal(i), A.diagonal(i) + 9);
    inverse.block<3, 3>(3 * i, 3 * i) = MatrixXd(K).block<3, 3>(3 * i, 3 * i).inverse();
  }
  slant::detail::node_face<3, double> face(A.nodes(), test::block_inverses<3, double>(inverse));
  surface s(n);
  std::vector<int> moved, parents;
  Vector3d const direction = Vector3d(1, -2, 2) / 3;

  auto const follow = [&](std::set<int> const& expected) {
    MatrixXd const before = test::dense(C);
    face.assign(s, 0.5, diagonal, moved);
    CHECK(std::set<int>(moved.begin(), moved.end()) == expected);
    slant::detail::galerkin_change(A, P, C, D, moved, parents, w, face.change_of_blocks());
    MatrixXd const H = s.Π * MatrixXd(K) * s.Π + 0.5 * s.C;
    MatrixXd const exact = p.transpose() * H * p, now = test::dense(C);
    CHECK((now - exact).norm() <= 1e-13 * exact.norm());
    CHECK(now == now.transpose());
    // Only rows of parents, and their mirror images, were touched, and the change is told.
    std::set<int> const formed(parents.begin(), parents.end());
    MatrixXd const change = test::dense(D);
    for (int I = 0; I < C.nodes(); ++I) {
      auto const rows = [&](MatrixXd const& m) { return m.middleRows(M * I, M); };
      if (formed.count(I) > 0)
        CHECK((rows(now) - rows(before) - rows(change)).norm() <= 1e-13 * exact.norm());
      for (int J = 0; J < C.nodes(); ++J) {
        if (formed.count(I) + formed.count(J) > 0) continue;
        CHECK(now.template block<M, M>(M * I, M * J) == before.template block<M, M>(M * I, M * J));
      }
    }
    std::set<int> all;
    for (int const i : moved)
      for (int e = P.begin(i); e < P.end(i); ++e) all.insert(P.at(e));
    CHECK(formed == all);
    CHECK(parents.size() == all.size());
    // The inverses of the diagonal blocks on range(Π).
    for (int const i : moved) {
      Matrix3d const found =
          Eigen::Map<Eigen::Matrix<double, 4, 3> const>(face.inverses() + 12 * i).topRows<3>();
      Matrix3d const q = s.Π.block<3, 3>(3 * i, 3 * i), h = H.block<3, 3>(3 * i, 3 * i);
      CHECK((found * h - q).norm() <= 1e-11);
      CHECK((found * q - found).norm() <= 1e-13 * found.norm());
    }
  };
  s.hold(0);
  s.plane(1, Vector3d::UnitZ());
  s.plane(7, direction);
  s.line(9, direction, 3);
  follow({0, 1, 7, 9});
  follow({});
  s.free(1);
  s.hold(7);
  s.line(30, Vector3d::UnitX(), 0.7);
  follow({1, 7, 30});
  s.line(30, Vector3d::UnitX(), 0.7 * (1 + 1e-3));  // less than coarse levels care for
  face.assign(s, 0.5, diagonal, moved);
  CHECK(moved.empty());
  s.hold(30);
  follow({30});
  // From the beginning.
  MatrixXd const followed = test::dense(C);
  C = untouched;
  face.forget_levels(moved);
  CHECK(std::set<int>(moved.begin(), moved.end()) == std::set<int>{0, 7, 9, 30});
  slant::detail::galerkin_change(A, P, C, D, moved, parents, w, face.change_of_blocks());
  CHECK((test::dense(C) - followed).norm() <= 1e-13 * followed.norm());
  for (int i = 0; i < A.nodes(); ++i) s.free(i);
  follow({0, 7, 9, 30});
  slant::testing::allocation_guard guard;
  s.hold(0);
  s.hold(30);
  face.assign(s, 0.5, diagonal, moved);
  slant::detail::galerkin_change(A, P, C, D, moved, parents, w, face.change_of_blocks());
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("changed rows are those of the projected operator, and no others are touched") {
  check_face<6>(false);
  check_face<3>(false);
  check_face<3>(true);
}

TEST_CASE("what has changed on a level is what the next one adds") {
  sparse const K = fem::make_steel_brick({.k = 2}).K / 2e5;
  block_matrix<6, double> A(K);
  auto const P = sample<6, 6>(A.nodes(), false);
  MatrixXd const p = dense(P);
  std::size_t longest = 0;
  auto C = slant::detail::galerkin_pattern(A, P, longest);
  slant::detail::galerkin_scratch<6, 6, double> w(P, longest);
  slant::detail::galerkin(A, P, C, w);
  auto D = C;
  // δ = A in rows and columns of some nodes; its other rows are told by nothing.
  std::vector<int> const moved{3, 4, 11};
  std::vector<int> parents;
  MatrixXd δ = MatrixXd::Zero(K.rows(), K.rows());
  for (int const i : moved) {
    δ.middleRows<6>(6 * i) = MatrixXd(K).middleRows<6>(6 * i);
    δ.middleCols<6>(6 * i) = MatrixXd(K).middleCols<6>(6 * i);
  }
  for (int i = 0; i < A.nodes(); ++i) {
    if (std::count(moved.begin(), moved.end(), i) > 0) continue;
    A.for_each_in_row(i, [](int, double* entries) {
      std::fill(entries, entries + 36, std::numeric_limits<double>::quiet_NaN());
    });
  }
  MatrixXd const expected = test::dense(C) + p.transpose() * δ * p;
  slant::detail::galerkin_change(A, P, C, D, moved, parents, w, slant::detail::whole_blocks{});
  CHECK((test::dense(C) - expected).norm() <= 1e-13 * expected.norm());
}

TEST_CASE("great curvature is left to the sweeps: coarse levels hold its direction") {
  sparse const K = fem::make_steel_brick({.k = 1}).K / 2e5;
  block_matrix<3, float> const A(K);
  std::vector<double> diagonal;
  for (int i = 0; i < A.nodes(); ++i)
    for (int k = 0; k < 9; ++k) diagonal.push_back(double(A.diagonal(i)[k]));
  auto const n = K.rows();
  slant::detail::node_face<3, float> face(A.nodes(),
                                          test::block_inverses<3, float>(MatrixXd::Identity(n, n)));
  Vector3d const v = Vector3d(2, 1, -2) / 3;
  std::vector<int> moved;
  for (double const bend : {1e6, 1e12, 1e200}) {
    surface s(n);
    s.C.block<3, 3>(6, 6) = bend * v * v.transpose();
    face.assign(s, 1, diagonal, moved);
    auto const& node = face.surface()[2];
    CHECK((node.level.projector - (Matrix3d::Identity() - v * v.transpose())).norm() <= 1e-12);
    CHECK(node.level.curvature.norm() <= 1e-6 * bend);
    Matrix3d const inverse = Eigen::Map<Eigen::Matrix<float, 4, 3> const>(face.inverses() + 24)
                                 .topRows<3>()
                                 .cast<double>();
    CHECK((inverse * v).norm() <= 1e-6 * inverse.norm());
    Matrix3d const a = MatrixXd(K).block<3, 3>(6, 6);
    Matrix3d const q = Matrix3d::Identity() - v * v.transpose();
    Matrix3d const plane = q * (q * a * q + v * v.transpose()).inverse() * q;
    CHECK((inverse - plane).norm() <= 1e-6 * plane.norm());
    // Across v the inverse of the curvature and of the block along it.
    VectorXd x = VectorXd::Zero(n), y = VectorXd::Zero(n);
    x.segment<3>(6) = v;
    face.complete(x.data(), y.data(), 1.0);
    CHECK((y.segment<3>(6) * (bend + v.dot(a * v)) - v).norm() <= 1e-6);
  }
}

TEST_CASE("what is no projector within nodes is named") {
  sparse const K = fem::make_steel_brick({.k = 1}).K;
  auto const n = K.rows();
  slant::detail::node_face<3, double> face(
      int(n / 3), test::block_inverses<3, double>(MatrixXd::Identity(n, n)));
  surface s(n);
  s.Π(0, 3) = s.Π(3, 0) = s.Π(0, 0) = s.Π(3, 3) = 0.5;  // two nodes move together
  std::vector<int> moved;
  std::vector<double> const diagonal(static_cast<std::size_t>(3 * n), 1.0);
  CHECK_THROWS_WITH_AS(face.assign(s, 0, diagonal, moved),
                       "face: got node 0 that moves with others, expected blocks of the set within "
                       "the nodes of 3 unknowns",
                       slant::bad_input);
  surface t(n);
  t.Π(4, 4) = 0.5;
  CHECK_THROWS_WITH_AS(face.assign(t, 0, diagonal, moved),
                       "face: got no projector on node 1, expected a face that projects onto the "
                       "motions that are left",
                       slant::bad_input);
}

TEST_CASE("prolongations of the user") {
  sparse P(4, 2);
  P.insert(0, 0) = 1;
  P.insert(1, 0) = P.insert(1, 1) = 0.5;
  P.insert(2, 1) = 1;
  P.makeCompressed();
  auto const of_nodes = slant::detail::prolongation_from<3, double>(P, 4, "P");
  CHECK(of_nodes.weights);
  sparse unknowns(12, 6);
  for (int j = 0; j < P.outerSize(); ++j) {
    for (sparse::InnerIterator e(P, j); e; ++e)
      for (int c = 0; c < 3; ++c) unknowns.coeffRef(3 * e.row() + c, 3 * e.col() + c) = e.value();
  }
  auto const the_same = slant::detail::prolongation_from<3, double>(unknowns, 4, "P");
  CHECK(the_same.weights);
  CHECK(the_same.column == of_nodes.column);
  CHECK(the_same.entries == of_nodes.entries);
  CHECK(dense(of_nodes) == MatrixXd(unknowns));
  unknowns.coeffRef(4, 5) = 0.25;
  auto const mixed = slant::detail::prolongation_from<3, double>(unknowns, 4, "P");
  CHECK(!mixed.weights);
  CHECK(dense(mixed) == MatrixXd(unknowns));
  auto const from = [](sparse const& given, int nodes) {
    static_cast<void>(slant::detail::prolongation_from<3, double>(given, nodes, "P"));
  };
  CHECK_THROWS_WITH_AS(from(P, 5), "rows of P: got 4, expected 5 nodes or 15 unknowns",
                       slant::bad_input);
  CHECK_THROWS_AS(from(sparse(12, 4), 4), slant::bad_input);
}

}  // namespace galerkin_test
