// SPDX-License-Identifier: MIT
#include <slant/io/matrix_market.hpp>

#include <fem/steel_brick.hpp>
#include <fem/write_folder.hpp>
#include <io/io_support.hpp>
#include <support/testing.hpp>

namespace write_folder_test {

bool same(Eigen::SparseMatrix<double> const& a, Eigen::SparseMatrix<double> const& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a - b).norm() == 0;
}

TEST_CASE("a scene comes back from its folder bit for bit") {
  io_test::temporary_folder const temporary;
  auto const folder = temporary / "scenes/brick";  // neither exists yet
  auto const scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  fem::write_folder(scene, folder);
  CHECK(same(slant::read_matrix_market(folder / "K.mtx"), scene.K));
  CHECK(same(slant::read_matrix_market(folder / "N.mtx"), scene.N));
  CHECK(same(slant::read_matrix_market(folder / "T.mtx"), scene.T));
  CHECK((slant::read_text_vector(folder / "f.txt") == scene.f));
  CHECK((slant::read_text_vector(folder / "d.txt") == scene.d));
  CHECK((slant::read_text_vector(folder / "g.txt") == scene.g));
}

}  // namespace write_folder_test
