// SPDX-License-Identifier: MIT
//
// The numbers copied from the documents, where they can be checked against each other.
#include <slant/sets/sets.hpp>

#include <fem/active_counts.hpp>
#include <fem/thesis_tables.hpp>
#include <fem/wire_counts.hpp>
#include <support/testing.hpp>

namespace printed_tables_test {

bool has_counts(double l, double g) {
  return std::any_of(fem::printed_wire_counts.begin(), fem::printed_wire_counts.end(),
                     [&](auto const& row) { return row.l == l && row.g == g; });
}

TEST_CASE("active sets are known for every wire of the tables") {
  for (auto const& row : fem::thesis_table_4_1) CHECK(has_counts(row.l, row.g));
  for (auto const& row : fem::thesis_table_4_2) CHECK(has_counts(row.l, row.g));
  for (auto const& row : fem::thesis_table_4_3) CHECK(has_counts(0, row.g));
  CHECK(has_counts(0, fem::thesis_table_4_4.g));
  for (std::size_t e = 0; e < fem::wire_sizes.size(); ++e)
    CHECK(fem::wire_counts::unknowns(e) == fem::wire_sizes[e]);
}

TEST_CASE("SSNM fails in 14 of the 42 cells of Table 4.2 and in none of Table 4.1") {
  auto const failures = [](auto const& table) {
    std::ptrdiff_t count = 0;
    for (auto const& row : table)
      count += std::count(row.iterations.begin(), row.iterations.end(), fem::failed);
    return count;
  };
  CHECK(failures(fem::thesis_table_4_2) == 14);
  CHECK(failures(fem::thesis_table_4_1) == 0);
}

TEST_CASE("what two tables print of the same run is the same") {
  // r_tol = 0.01, c_fact = 0.9, ρ = 1 for n = 256, 512, 1024 stands in 4.6, 4.7 and 4.8.
  auto const same = [](fem::printed_work a, fem::printed_work b) {
    return a.steps == b.steps && a.products == b.products;
  };
  auto const& last = fem::thesis_table_4_6.back();
  for (std::size_t i = 0; i < 3; ++i) CHECK(same(last.entries[i], fem::thesis_table_4_8[3 + i].a));
  CHECK(same(last.entries[1], fem::thesis_table_4_7[10].entries[0]));
  // r_tol = 0.9 and 0.8 with c_fact = 0.9 for n = 512 stand in 4.6 and 4.7.
  CHECK(same(fem::thesis_table_4_6[0].entries[1], fem::thesis_table_4_7[1].entries[0]));
  // The adaptive column of 4.5 at n = 512 is r_tol = 0.01, ρ = 0.5 of 4.7.
  CHECK(same(fem::thesis_table_4_5[4].adaptive, fem::thesis_table_4_7[10].entries[2]));
}

TEST_CASE("a block is active when x - r / A_ii lies strictly outside its set") {
  MatrixXd const A = Eigen::Vector4d(2, 4, 4, 1).asDiagonal();
  auto const set = slant::cartesian(slant::half_lines(1), slant::discs(VectorXd::Ones(1)),
                                    slant::free_components(1));
  auto const counts = [&](VectorXd const& b, VectorXd const& x) {
    return fem::count_active(set, A, b, x);
  };
  VectorXd const origin = VectorXd::Zero(4);
  // z = x − (A x − b)/A_ii = b/A_ii for a diagonal matrix.
  CHECK(counts(Eigen::Vector4d(2, 0, 0, 5), origin) == fem::active_counts{0, 0});
  CHECK(counts(Eigen::Vector4d(-2, 0, 0, 5), origin) == fem::active_counts{1, 0});
  CHECK(counts(Eigen::Vector4d(0, 4, 0, 5), origin) == fem::active_counts{0, 0});  // on the circle
  CHECK(counts(Eigen::Vector4d(0, 4, 0.5, 5), origin) == fem::active_counts{0, 1});
  // The step belongs to the block, not to the matrix: with 1/2 for all the disc would be active.
  CHECK(counts(Eigen::Vector4d(0, 3, 0, 5), origin) == fem::active_counts{0, 0});
  CHECK((fem::active_blocks(set, A, VectorXd(Eigen::Vector4d(-1, 9, 0, 5)), origin) ==
         std::vector<bool>{true, true, false}));
}

}  // namespace printed_tables_test
