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

TEST_CASE("a scene that cannot be written leaves nothing behind") {
  io_test::temporary_folder const folder;
  auto scene = fem::make_steel_brick({.k = 1});
  scene.g[2] = std::nan("");
  CHECK_THROWS_AS(fem::write_folder(scene, folder.path()), slant::bad_input);
  CHECK(folder.entries() == 0);
  io_test::put(folder / "file", "not a folder");
  CHECK_THROWS_AS(fem::write_folder(scene, folder / "file"), std::filesystem::filesystem_error);
}

}  // namespace write_folder_test
